// Colours and widths of what a person reads.
#pragma once

#include <string>
#include <string_view>

namespace crossray {

enum class ColorMode { kAuto, kAlways, kNever };
enum class Ink { kRed, kGreen, kYellow, kBlue, kDim, kBold };

class Style {
  public:
    // kAuto colours a terminal; NO_COLOR in the environment wins over kAuto and kAlways.
    static Style choose(ColorMode mode, int fileDescriptor);
    explicit Style(bool colored) : colored_(colored) {}
    std::string paint(Ink ink, std::string_view text) const;
    bool isColored() const { return colored_; }

  private:
    bool colored_ = false;
};

bool isTerminal(int fileDescriptor);
// Columns of the terminal; 80 where that is unknown.
int terminalWidth(int fileDescriptor);
// Breaks at spaces so that no line has more than `width` columns, but for single words that are longer; the lines after
// the first begin with `indent` spaces, which do not count.
std::string wrap(std::string_view text, int width, int indent);
// Shortens to `width` columns, with "..." at the end. Counts UTF-8 characters, not bytes.
std::string clip(std::string_view text, int width);

} // namespace crossray
