// The files of one shader: the entry and all that it includes, each read once, with bounds on what is read.
#pragma once

#include "harness/base/hash.h"

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace crossray {

inline constexpr size_t kMaxSourceBytes = 1 << 20;  // of one file
inline constexpr size_t kMaxClosureBytes = 8 << 20; // of all that is included, each inclusion counted
inline constexpr size_t kMaxIncludeDepth = 32;
inline constexpr int kMaxOperators = 16384; // of one statement, commas counted: compilers recurse over them

struct SourceFile {
    std::string name; // below the include root: the name that an include directive has; elsewhere: the path
    std::filesystem::path path;
    std::string text;
    Hash128 hash;
};

// Files by name; references stay valid while files are added.
class SourceSet {
  public:
    // Reads the file when it is not here yet. Throws InputError when it is missing, unreadable, too large or no text.
    const SourceFile& open(const std::string& name, const std::filesystem::path& path);
    const SourceFile* find(std::string_view name) const;
    // A file as it is to be, whatever the disk has.
    void add(SourceFile file) { files_.push_back(std::move(file)); }
    const std::deque<SourceFile>& files() const { return files_; }

  private:
    std::deque<SourceFile> files_;
};

// Name and path of the shader that a person asked for: below the include root, or anywhere else.
struct ShaderLocation {
    std::string name;
    std::filesystem::path path;
};
ShaderLocation locateShader(const std::filesystem::path& shader, const std::filesystem::path& includeRoot);

// Content of a file; nothing when it cannot be read or has more than `maxBytes` bytes.
std::optional<std::string> readFile(const std::filesystem::path& path, size_t maxBytes);

// The path as a person would type it: relative when it lies below the current folder.
std::string displayPath(const std::filesystem::path& path);

// The line (from 1) of the first statement that has more than kMaxOperators operators, or 0.
int findOverlongStatement(std::string_view text);

// Line `line` (from 1) of a text, without its end; empty beyond the last one.
std::string_view lineOf(std::string_view text, int line);

} // namespace crossray
