#include "harness/base/error.h"

#include <fmt/format.h>

namespace crossray {

std::string SourcePosition::format() const
{
    if (file.empty()) return {};
    if (line <= 0) return file;
    if (column <= 0) return fmt::format("{}:{}", file, line);
    return fmt::format("{}:{}:{}", file, line, column);
}

Error::Error(ExitCode code, const SourcePosition& position, const std::string& text)
    : std::runtime_error(position.file.empty() ? text : position.format() + ": " + text), code_(code),
      position_(position)
{
}

} // namespace crossray
