// A picture in the terminal: by a protocol of the terminal's own where it has one, else as blocks of two pixels a
// character.
#pragma once

#include "harness/cli/picture.h"

#include <functional>
#include <string>

namespace crossray {

// kKitty: the kitty graphics protocol (kitty, WezTerm, Ghostty); kITerm: iTerm2's inline images; kTrueColor and k256:
// half blocks in 24-bit colours or in the 6x6x6 cube of 256. kNone: not a terminal, or one without colours.
enum class PictureProtocol { kNone, kKitty, kITerm, kTrueColor, k256 };

// What the terminal of this environment takes, where `isColored` says whether colours are wanted at all. `read` gives a
// variable's value, empty where it is not set. Inside tmux and screen, which pass no graphics on, blocks.
PictureProtocol choosePictureProtocol(bool isColored, const std::function<std::string(const char*)>& read);
PictureProtocol choosePictureProtocol(bool isColored); // of this process's environment

// Text to print, with a line break at its end, at most `columns` characters wide; empty for kNone. Blocks show the mean
// of the pixels below each half character, taken in linear light, and never enlarge.
std::string formatPicture(const Picture& picture, PictureProtocol protocol, int columns);

} // namespace crossray
