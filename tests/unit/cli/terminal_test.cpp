#include "harness/cli/terminal_picture.h"

#include "harness/cli/terminal.h"

#include <gtest/gtest.h>

#include <map>

using namespace crossray;

namespace {

PictureProtocol choose(const std::map<std::string, std::string>& variables)
{
    return choosePictureProtocol(true, [&](const char* name) {
        const auto found = variables.find(name);
        return found == variables.end() ? std::string() : found->second;
    });
}

// Left half red, right half blue.
Picture makeHalves(int width, int height)
{
    Picture picture;
    picture.width = width;
    picture.height = height;
    for (int i = 0; i < width * height; ++i) {
        const bool isLeft = i % width < width / 2;
        for (const int value : {isLeft ? 255 : 0, 0, isLeft ? 0 : 255})
            picture.rgb.push_back(static_cast<unsigned char>(value));
    }
    return picture;
}

size_t countOf(const std::string& text, const std::string& part)
{
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

} // namespace

TEST(Terminal, wrapBreaksAtSpacesAndCountsCharacters)
{
    EXPECT_EQ(wrap("one two three", 7, 2), "one two\n  three");
    EXPECT_EQ(wrap("one two three", 80, 2), "one two three");
    EXPECT_EQ(wrap("averylongword it", 5, 1), "averylongword\n it");
    EXPECT_EQ(wrap("\u00e9\u00e9\u00e9 \u00e9\u00e9", 6, 0),
              "\u00e9\u00e9\u00e9 \u00e9\u00e9"); // 6 characters, 11 bytes
    EXPECT_EQ(wrap("", 10, 0), "");
}

TEST(TerminalPicture, theProtocolIsWhatTheTerminalSays)
{
    EXPECT_EQ(choosePictureProtocol(false, [](const char*) { return std::string("xterm-kitty"); }),
              PictureProtocol::kNone);
    EXPECT_EQ(choose({{"TERM", "xterm-kitty"}}), PictureProtocol::kKitty);
    EXPECT_EQ(choose({{"TERM_PROGRAM", "WezTerm"}}), PictureProtocol::kKitty);
    EXPECT_EQ(choose({{"TERM_PROGRAM", "iTerm.app"}}), PictureProtocol::kITerm);
    EXPECT_EQ(choose({{"TERM", "xterm-256color"}, {"COLORTERM", "truecolor"}}), PictureProtocol::kTrueColor);
    EXPECT_EQ(choose({{"TERM", "xterm-256color"}}), PictureProtocol::k256);
    EXPECT_EQ(choose({{"TERM_PROGRAM", "iTerm.app"}, {"TMUX", "/tmp/tmux"}, {"COLORTERM", "24bit"}}),
              PictureProtocol::kTrueColor);
}

TEST(TerminalPicture, blocksHaveTwoPixelsACharacter)
{
    const std::string text = formatPicture(makeHalves(64, 32), PictureProtocol::kTrueColor, 8);
    EXPECT_EQ(countOf(text, "\n"), 2u); // 8 wide, 4 high
    EXPECT_EQ(countOf(text, "\u2580"), 16u);
    EXPECT_EQ(countOf(text, "\x1b[38;2;255;0;0m\x1b[48;2;255;0;0m\u2580\u2580\u2580\u2580"), 2u);
    EXPECT_EQ(countOf(text, "\x1b[38;2;0;0;255m\x1b[48;2;0;0;255m\u2580\u2580\u2580\u2580\x1b[0m\n"), 2u);
    EXPECT_NE(formatPicture(makeHalves(64, 32), PictureProtocol::k256, 8).find("\x1b[38;5;196m\x1b[48;5;196m"),
              std::string::npos);
    EXPECT_EQ(formatPicture(makeHalves(64, 32), PictureProtocol::kNone, 8), "");
}

TEST(TerminalPicture, aMeanIsTakenInLinearLight)
{
    // Black and white in turn: half the light is 188 in sRGB, not 128.
    Picture picture;
    picture.width = picture.height = 4;
    for (int i = 0; i < 16; ++i)
        picture.rgb.insert(picture.rgb.end(), 3, static_cast<unsigned char>(i % 2 == 0 ? 0 : 255));
    EXPECT_NE(formatPicture(picture, PictureProtocol::kTrueColor, 1).find("38;2;188;188;188m"), std::string::npos);
}

TEST(TerminalPicture, picturesOfOnePixelAndOfOddHeightAreWhole)
{
    EXPECT_EQ(countOf(formatPicture(makeHalves(1, 1), PictureProtocol::kTrueColor, 80), "\u2580"), 1u);
    EXPECT_EQ(countOf(formatPicture(makeHalves(2, 3), PictureProtocol::kTrueColor, 80), "\n"), 2u);
}

TEST(TerminalPicture, kittyGetsThePngInPieces)
{
    Picture noise;
    noise.width = noise.height = 64;
    unsigned state = 1;
    for (int i = 0; i < 64 * 64 * 3; ++i) {
        state = state * 1664525u + 1013904223u;
        noise.rgb.push_back(static_cast<unsigned char>(state >> 24));
    }
    const std::string text = formatPicture(noise, PictureProtocol::kKitty, 40);
    EXPECT_TRUE(text.starts_with("\x1b_Gf=100,a=T,c=40,m=1;iVBORw0KGgo")); // a PNG's first bytes
    EXPECT_EQ(countOf(text, "m=0;"), 1u);
    EXPECT_EQ(countOf(text, "\x1b\\"), countOf(text, "\x1b_G"));
    EXPECT_GT(countOf(text, "m=1;"), 2u);
}
