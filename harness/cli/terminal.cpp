#include "harness/cli/terminal.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
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

// Of UTF-8: the other bytes of a character go on with it.
bool startsCharacter(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;
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

std::string wrap(std::string_view text, int width, int indent)
{
    std::string wrapped;
    int column = 0;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(' ', begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        const auto columns = static_cast<int>(std::count_if(word.begin(), word.end(), startsCharacter));
        if (begin > 0) {
            const bool breaks = column + 1 + columns > width;
            wrapped += breaks ? '\n' : ' ';
            if (breaks) wrapped.append(static_cast<size_t>(indent), ' ');
            column = breaks ? 0 : column + 1;
        }
        wrapped += word;
        column += columns;
        begin = end + 1;
    }
    return wrapped;
}

std::string clip(std::string_view text, int width)
{
    int columns = 0;
    size_t keep = 0; // bytes that leave room for the dots
    for (size_t i = 0; i < text.size(); ++i) {
        if (!startsCharacter(text[i])) continue;
        if (columns == width - 3) keep = i;
        if (++columns > width) return std::string(text.substr(0, keep)) + "...";
    }
    return std::string(text);
}

} // namespace crossray
