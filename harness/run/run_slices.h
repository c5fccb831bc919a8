// Takes the text of a run.json apart at its cases, so that a run of any size is read and written one case at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct RunSlices {
    std::string head;                    // the text with an empty list in the place of the cases
    std::vector<std::string_view> cases; // of the text
};

// Nothing where the text has no list of cases at its top level, or more than one, or ends within it. What it returns is
// taken apart at brackets and strings alone: a parser that accepts the head and each of the cases accepts the whole.
std::optional<RunSlices> sliceRunJson(std::string_view text);

// A file's bytes as a view that costs no memory of the process's own.
class MappedFile {
  public:
    // Throws InputError when it cannot be read.
    explicit MappedFile(const std::filesystem::path& file);
    ~MappedFile();
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&&) = delete;
    std::string_view text() const { return {data_, size_}; }
    // The pages that were read so far may leave the memory.
    void release() const;

  private:
    char* data_ = nullptr;
    size_t size_ = 0;
};

} // namespace crossray
