#include "harness/cli/terminal_picture.h"

#include "harness/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace crossray {

namespace {

constexpr int kMostColumns = 160; // a picture beyond that is no longer a small one

using Rgb = std::array<unsigned char, 3>;

double toLinear(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

unsigned char toByte(double linear)
{
    return static_cast<unsigned char>(std::lround(encodeSrgb(linear) * 255));
}

// The picture at `width` x `height`, both at most its own: means over the pixels that a new one touches.
std::vector<Rgb> shrink(const Picture& picture, int width, int height)
{
    std::array<double, 256> linear{};
    for (size_t i = 0; i < linear.size(); ++i)
        linear[i] = toLinear(static_cast<double>(i) / 255.0);
    std::vector<Rgb> small;
    small.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
    for (int y = 0; y < height; ++y) {
        const int top = y * picture.height / height, bottom = std::max(top + 1, (y + 1) * picture.height / height);
        for (int x = 0; x < width; ++x) {
            const int left = x * picture.width / width, right = std::max(left + 1, (x + 1) * picture.width / width);
            std::array<double, 3> sum{};
            for (int row = top; row < bottom; ++row) {
                for (int column = left; column < right; ++column) {
                    const size_t pixel =
                        (static_cast<size_t>(row) * static_cast<size_t>(picture.width) + static_cast<size_t>(column)) *
                        3;
                    for (size_t channel = 0; channel < 3; ++channel)
                        sum[channel] += linear[picture.rgb[pixel + channel]];
                }
            }
            const double count = static_cast<double>(bottom - top) * (right - left);
            small.push_back({toByte(sum[0] / count), toByte(sum[1] / count), toByte(sum[2] / count)});
        }
    }
    return small;
}

std::string colorCode(const Rgb& color, bool isForeground, bool isTrueColor)
{
    const int place = isForeground ? 38 : 48;
    if (isTrueColor) return fmt::format("\x1b[{};2;{};{};{}m", place, color[0], color[1], color[2]);
    // The cube's steps are 0, 95, 135, 175, 215, 255.
    const auto step = [](unsigned char value) { return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40; };
    return fmt::format("\x1b[{};5;{}m", place, 16 + 36 * step(color[0]) + 6 * step(color[1]) + step(color[2]));
}

std::string formatBlocks(const Picture& picture, int columns, bool isTrueColor)
{
    const int width = std::clamp(columns, 1, std::min(kMostColumns, picture.width));
    // A character is about twice as high as wide: an upper and a lower half make two square pixels.
    const int rows = std::max(1, (picture.height * width / picture.width + 1) / 2);
    const int height = std::min(rows * 2, picture.height);
    const std::vector<Rgb> small = shrink(picture, width, height);
    std::string text;
    for (int y = 0; y < height; y += 2) {
        std::string lastUpper, lastLower;
        for (int x = 0; x < width; ++x) {
            const auto at = [&](int row) {
                return small[static_cast<size_t>(std::min(row, height - 1)) * static_cast<size_t>(width) +
                             static_cast<size_t>(x)];
            };
            const std::string upper = colorCode(at(y), true, isTrueColor);
            const std::string lower = colorCode(at(y + 1), false, isTrueColor);
            if (upper != lastUpper) text += upper;
            if (lower != lastLower) text += lower;
            lastUpper = upper;
            lastLower = lower;
            text += "\u2580"; // upper half block
        }
        text += "\x1b[0m\n";
    }
    return text;
}

// In pieces of at most 4096 characters, as the protocol asks (sw.kovidgoyal.net/kitty/graphics-protocol).
std::string formatKitty(const Picture& picture, int columns)
{
    constexpr size_t kPiece = 4096;
    const std::string data = encodeBase64(encodePng(picture));
    std::string text;
    for (size_t begin = 0; begin < data.size(); begin += kPiece) {
        const bool isLast = begin + kPiece >= data.size();
        const std::string head = begin == 0 ? fmt::format("f=100,a=T,c={},", std::min(columns, kMostColumns)) : "";
        text += fmt::format("\x1b_G{}m={};{}\x1b\\", head, isLast ? 0 : 1, data.substr(begin, kPiece));
    }
    return text + "\n";
}

// iterm2.com/documentation-images.html
std::string formatITerm(const Picture& picture, int columns)
{
    const std::string png = encodePng(picture);
    return fmt::format("\x1b]1337;File=inline=1;size={};width={};preserveAspectRatio=1:{}\x07\n", png.size(),
                       std::min(columns, kMostColumns), encodeBase64(png));
}

} // namespace

PictureProtocol choosePictureProtocol(bool isColored, const std::function<std::string(const char*)>& read)
{
    if (!isColored) return PictureProtocol::kNone;
    const std::string program = read("TERM_PROGRAM"), term = read("TERM");
    const bool isMultiplexed = !read("TMUX").empty() || term.starts_with("screen") || term.starts_with("tmux");
    if (!isMultiplexed) {
        if (term == "xterm-kitty" || term == "xterm-ghostty" || program == "WezTerm" || program == "ghostty") {
            return PictureProtocol::kKitty;
        }
        if (program == "iTerm.app") return PictureProtocol::kITerm;
    }
    const std::string colors = read("COLORTERM");
    return colors == "truecolor" || colors == "24bit" ? PictureProtocol::kTrueColor : PictureProtocol::k256;
}

PictureProtocol choosePictureProtocol(bool isColored)
{
    return choosePictureProtocol(isColored, [](const char* name) {
        const char* const value = std::getenv(name);
        return std::string(value == nullptr ? "" : value);
    });
}

std::string formatPicture(const Picture& picture, PictureProtocol protocol, int columns)
{
    switch (protocol) {
    case PictureProtocol::kKitty:
        return formatKitty(picture, columns);
    case PictureProtocol::kITerm:
        return formatITerm(picture, columns);
    case PictureProtocol::kTrueColor:
    case PictureProtocol::k256:
        return formatBlocks(picture, columns, protocol == PictureProtocol::kTrueColor);
    case PictureProtocol::kNone:
        break;
    }
    return {};
}

} // namespace crossray
