#include "harness/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

std::string withoutControlCharacters(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    return text;
}

} // namespace

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

InputError::InputError(const SourcePosition& position, const std::string& text)
    : Error(ExitCode::kUsage, position, withoutControlCharacters(text))
{
}

} // namespace crossray
