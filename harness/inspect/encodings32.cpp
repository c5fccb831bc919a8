#include "harness/inspect/encodings.h"

#include <array>

#define CROSSRAY_GLSL_PRECISION 32
#include "harness/backend/cpu/glsl.h"

#include "crossray/debug/debug_modes.glsl"

vec3 encodeValue(crossray::Encoding encoding, const std::array<float, 3>& v, int maximum)
{
    using enum crossray::Encoding;
    const vec3 triple(v[0], v[1], v[2]);
    switch (encoding) {
    case kColor:
        return encodeColor(triple);
    case kDirection:
        return encodeDirection(triple);
    case kLinearDepth:
        return encodeLinearDepth(v[0]);
    case kHitClass:
        return encodeHitClass(static_cast<int>(v[0]));
    case kIndex:
        return encodeIndex(static_cast<int>(v[0]));
    case kPositionNDC:
        return encodePositionNDC(triple);
    case kRayDirNDC:
        return encodeRayDirNDC(triple);
    case kCount:
        return encodeCount(static_cast<int>(v[0]), maximum);
    case kWeight:
        return encodeWeight(v[0]);
    }
    return kDebugNotANumber;
}

#include "harness/backend/cpu/glsl_end.h"

namespace crossray {

EncodedColor encodeForDisplay(Encoding encoding, const double* value, int maximum)
{
    const bool isTriple =
        encoding == Encoding::kColor || encoding == Encoding::kDirection || encoding == Encoding::kRayDirNDC;
    const int count = isTriple ? 3 : encoding == Encoding::kPositionNDC ? 2 : 1;
    std::array<float, 3> numbers{};
    for (int i = 0; i < count; ++i)
        numbers[static_cast<size_t>(i)] = static_cast<float>(value[i]);
    const auto color = cpu32::encodeValue(encoding, numbers, maximum);
    return {color.x, color.y, color.z};
}

} // namespace crossray
