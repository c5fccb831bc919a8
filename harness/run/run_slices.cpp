#include "harness/run/run_slices.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

namespace crossray {

namespace {

class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::optional<RunSlices> scan()
    {
        RunSlices slices;
        std::optional<std::pair<size_t, size_t>> list; // of cases, brackets included
        if (!take('{')) return std::nullopt;
        do {
            skipSpace();
            const size_t keyStart = at_;
            if (!skipString()) return std::nullopt;
            const std::string_view key = text_.substr(keyStart, at_ - keyStart);
            if (!take(':')) return std::nullopt;
            skipSpace();
            const size_t start = at_;
            if (key == "\"cases\"" && at_ < text_.size() && text_[at_] == '[') {
                if (list || !scanCases(slices.cases)) return std::nullopt;
                list = {start, at_};
            } else if (!skipValue()) {
                return std::nullopt;
            }
        } while (take(','));
        if (!list || !take('}')) return std::nullopt;
        slices.head = fmt::format("{}[]{}", text_.substr(0, list->first), text_.substr(list->second));
        return slices;
    }

  private:
    void skipSpace()
    {
        while (at_ < text_.size() &&
               (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t' || text_[at_] == '\r'))
            ++at_;
    }

    bool take(char character)
    {
        skipSpace();
        if (at_ >= text_.size() || text_[at_] != character) return false;
        ++at_;
        return true;
    }

    // A list with at least one element that ends in a bracket, or an empty one.
    bool scanCases(std::vector<std::string_view>& cases)
    {
        take('[');
        if (take(']')) return true;
        do {
            skipSpace();
            const size_t start = at_;
            if (!skipValue()) return false;
            cases.push_back(text_.substr(start, at_ - start));
        } while (take(','));
        return take(']');
    }

    bool skipString()
    {
        if (at_ >= text_.size() || text_[at_] != '"') return false;
        for (++at_; at_ < text_.size(); ++at_) {
            if (text_[at_] == '\\') {
                ++at_;
            } else if (text_[at_] == '"') {
                ++at_;
                return true;
            }
        }
        return false;
    }

    // To the end of a value: of its outermost bracket, or before the comma or bracket that ends a number or word.
    bool skipValue()
    {
        const size_t start = at_;
        int depth = 0;
        while (at_ < text_.size()) {
            const char character = text_[at_];
            if (character == '"') {
                if (!skipString()) return false;
                if (depth == 0) return true;
                continue;
            }
            if (depth == 0 && (character == ',' || character == '}' || character == ']')) break;
            ++at_;
            if (character == '{' || character == '[') ++depth;
            if ((character == '}' || character == ']') && --depth == 0) return true;
        }
        return depth == 0 && at_ > start;
    }

    std::string_view text_;
    size_t at_ = 0;
};

} // namespace

std::optional<RunSlices> sliceRunJson(std::string_view text)
{
    return Scanner(text).scan();
}

MappedFile::MappedFile(const std::filesystem::path& file)
{
    const auto fail = [&] { return InputError({file.string(), 0, 0}, "cannot be read"); };
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw fail();
    struct stat status {};
    if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) {
        size_ = static_cast<size_t>(status.st_size);
        void* const mapped = size_ == 0 ? nullptr : mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
        data_ = mapped == MAP_FAILED ? nullptr : static_cast<char*>(mapped);
    }
    close(descriptor);
    if (data_ == nullptr && size_ > 0) throw fail();
}

MappedFile::~MappedFile()
{
    if (data_ != nullptr) munmap(data_, size_);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0))
{
}

void MappedFile::release() const
{
    if (data_ != nullptr) madvise(data_, size_, MADV_DONTNEED);
}

} // namespace crossray
