// Dotted paths to keys of the case format, as `--set`, `sweep` and the inspector use them: "material.ior"; of a list
// one place, counted from 0: "scene.size.0", "scene.primitives.1.radius".
#pragma once

#include "harness/case/schema.h"

#include <string>
#include <string_view>
#include <vector>

namespace crossray {

std::vector<std::string> splitPath(std::string_view path, char separator = '.');
// A place in a list: digits alone.
bool isIndex(std::string_view part);
// A path without its indices; tables that are one format wherever they stand by the name that the schema gives them.
std::string schemaPath(const std::vector<std::string>& parts);

// Numbers in a list of fixed length: size, vector, extents, Euler angles.
bool isNumberList(const KeySpec& spec);

// The key that a path leads to; of a list of numbers the whole list, or one number of it. Null when there is no such
// key.
struct PathTarget {
    const KeySpec* spec = nullptr;
    bool isComponent = false; // the path ends with the index of one number
};
PathTarget findPathTarget(std::string_view path);

// The value at a path; null when nothing is there.
const Node* findByPath(const Node& root, std::string_view path);

} // namespace crossray
