#include "harness/cli/terminal.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

namespace crossray {

namespace {

int codeOf(Ink ink)
{
    switch (ink) {
    case Ink::kRed:
        return 31;
    case Ink::kGreen:
        return 32;
    case Ink::kYellow:
        return 33;
    case Ink::kBlue:
        return 34;
    case Ink::kDim:
        return 2;
    case Ink::kBold:
        return 1;
    }
    return 0;
}

} // namespace

bool isTerminal(int fileDescriptor)
{
    return isatty(fileDescriptor) == 1;
}

Style Style::choose(ColorMode mode, int fileDescriptor)
{
    const char* const noColor = std::getenv("NO_COLOR");
    if (mode == ColorMode::kNever || (noColor != nullptr && *noColor != '\0')) return Style(false);
    if (mode == ColorMode::kAlways) return Style(true);
    const char* const term = std::getenv("TERM");
    const bool isDumb = term != nullptr && std::string_view(term) == "dumb";
    return Style(isTerminal(fileDescriptor) && !isDumb);
}

std::string Style::paint(Ink ink, std::string_view text) const
{
    if (!colored_) return std::string(text);
    return fmt::format("\x1b[{}m{}\x1b[0m", codeOf(ink), text);
}

int terminalWidth(int fileDescriptor)
{
    winsize size{};
    if (ioctl(fileDescriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    return 80;
}

std::string clip(std::string_view text, int width)
{
    const auto isStart = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0) != 0x80; };
    int columns = 0;
    size_t keep = 0; // bytes that leave room for the dots
    for (size_t i = 0; i < text.size(); ++i) {
        if (!isStart(text[i])) continue;
        if (columns == width - 3) keep = i;
        if (++columns > width) return std::string(text.substr(0, keep)) + "...";
    }
    return std::string(text);
}

} // namespace crossray
