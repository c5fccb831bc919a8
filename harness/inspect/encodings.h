// The display encodings of the debug modes: the shader library's own functions (crossray/debug/debug_modes.glsl),
// compiled as C++ in float.
#pragma once

namespace crossray {

enum class Encoding {
    kColor,       // three channels, as they are
    kDirection,   // three
    kLinearDepth, // one
    kHitClass,    // one
    kIndex,       // one: a small whole number
    kPositionNDC, // two
    kRayDirNDC,   // three
    kCount,       // one, by its maximum
    kWeight,      // one
};

struct EncodedColor {
    double r = 0, g = 0, b = 0;
};

// `value` has as many numbers as the encoding asks for; `maximum` is read by kCount alone.
EncodedColor encodeForDisplay(Encoding encoding, const double* value, int maximum);

} // namespace crossray
