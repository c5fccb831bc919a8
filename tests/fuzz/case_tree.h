// A case as a tree of TOML values that can be made, repaired and cut down: what the fuzzer works on.
#pragma once

#include "harness/case/case.h"
#include "harness/case/node.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

Node makeString(std::string_view text);
Node makeInteger(int64_t value);
Node makeNumber(double value);
Node makeList(std::vector<Node> items);
void setKey(Node& table, std::string_view key, Node value); // at the end, or in the place of the one that is there

// The table of the schema that holds the keys of `key` in `table`, a key of tables.
std::string subTableName(std::string_view table, std::string_view key);

// As a file: what a person would write, tables under their headings, what lies in lists inline.
std::string formatCase(const Node& root);

// Writes the tree to the file and reads it as any case file is read. Throws InputError.
Case readTree(const Node& root, const std::filesystem::path& file);

} // namespace crossray
