#include "harness/compile/source.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace crossray {

namespace fs = std::filesystem;

namespace {

class FileDescriptor {
  public:
    explicit FileDescriptor(int fd) : fd_(fd) {}
    ~FileDescriptor()
    {
        if (fd_ >= 0) ::close(fd_);
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    int get() const { return fd_; }

  private:
    int fd_;
};

} // namespace

std::optional<std::string> readFile(const fs::path& path, size_t maxBytes)
{
    // O_NONBLOCK: a pipe or a device that never answers must not hang the caller; only regular files are read.
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0) return std::nullopt;
    if (!S_ISREG(status.st_mode)) {
        errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
        return std::nullopt;
    }
    const auto size = static_cast<size_t>(status.st_size);
    if (size > maxBytes) {
        errno = EFBIG;
        return std::nullopt;
    }
    std::string text(size, '\0');
    size_t done = 0;
    while (done < size) {
        const ssize_t count = ::read(file.get(), text.data() + done, size - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return std::nullopt;
        if (count == 0) break;
        done += static_cast<size_t>(count);
    }
    text.resize(done);
    return text;
}

const SourceFile* SourceSet::find(std::string_view name) const
{
    for (const SourceFile& file : files_) {
        if (file.name == name) return &file;
    }
    return nullptr;
}

const SourceFile& SourceSet::open(const std::string& name, const fs::path& path)
{
    if (const SourceFile* known = find(name)) return *known;
    std::optional<std::string> text = readFile(path, kMaxSourceBytes);
    if (!text) {
        const int reason = errno;
        if (reason == EFBIG) {
            throw InputError({displayPath(path)},
                             fmt::format("a shader source may have at most {} bytes", kMaxSourceBytes));
        }
        throw InputError({displayPath(path)}, fmt::format("cannot read the shader source: {}", std::strerror(reason)));
    }
    // glslang ends at a zero byte, and what follows would silently be missing.
    if (const size_t zero = text->find('\0'); zero != std::string::npos) {
        throw InputError({displayPath(path)}, fmt::format("byte {} is zero: a shader source is text", zero));
    }
    if (const int line = findOverlongStatement(*text); line > 0) {
        throw InputError({displayPath(path), line},
                         fmt::format("a statement may have at most {} operators and commas", kMaxOperators));
    }
    const Hash128 hash = hashBytes(*text);
    return files_.emplace_back(SourceFile{name, path, std::move(*text), hash});
}

ShaderLocation locateShader(const fs::path& shader, const fs::path& includeRoot)
{
    const fs::path root = fs::absolute(includeRoot).lexically_normal();
    std::error_code ignored;
    fs::path path = shader;
    if (!shader.is_absolute() && fs::exists(root / shader, ignored)) path = root / shader;
    path = fs::absolute(path).lexically_normal();
    const fs::path relative = path.lexically_relative(root);
    const bool below = !relative.empty() && *relative.begin() != "..";
    return {below ? relative.generic_string() : path.generic_string(), path};
}

std::string displayPath(const fs::path& path)
{
    std::error_code failed;
    const fs::path here = fs::current_path(failed);
    if (failed) return path.string();
    const fs::path relative = path.lexically_normal().lexically_relative(here);
    if (relative.empty() || *relative.begin() == "..") return path.string();
    return relative.string();
}

int findOverlongStatement(std::string_view text)
{
    int line = 1, count = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string_view rest = text.substr(i);
        if (rest.starts_with("//")) {
            i += std::min(rest.find('\n'), rest.size()) - 1;
        } else if (rest.starts_with("/*")) {
            const std::string_view comment = rest.substr(0, std::min(rest.find("*/", 2), rest.size() - 2) + 2);
            line += static_cast<int>(std::count(comment.begin(), comment.end(), '\n'));
            i += comment.size() - 1;
        } else if (rest[0] == '\n') {
            ++line;
        } else if (rest[0] == ';' || rest[0] == '{' || rest[0] == '}' || rest[0] == '#') {
            count = 0;
        } else if (std::string_view("+-*/%,&|^<>=?.[(!~").find(rest[0]) != std::string_view::npos) {
            if (++count > kMaxOperators) return line;
        }
    }
    return 0;
}

std::string_view lineOf(std::string_view text, int line)
{
    for (int i = 1; i < line; ++i) {
        const size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    std::string_view result = text.substr(0, text.find('\n'));
    if (!result.empty() && result.back() == '\r') result.remove_suffix(1);
    return result;
}

} // namespace crossray
