// The parameter blocks of the passes in both precisions: the same struct text as the shaders', so a layout cannot
// drift.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstring>
#include <vector>

namespace crossray {

namespace layout32 {
using vec4 = glm::vec4;
using ivec4 = glm::ivec4;
using mat4 = glm::mat4;
#include "shaders/crossray/shared/pass_params.glsl"
#include "shaders/crossray/shared/probe_params.glsl"
#include "shaders/crossray/shared/planar_params.glsl"
static_assert(sizeof(PyramidParams) == 4 * 16, "std140 pads nothing");
static_assert(sizeof(PassParams) == 5 * 64 + (13 + CROSSRAY_MAX_PYRAMID_LEVELS) * 16, "std140 pads nothing");
static_assert(sizeof(ProbeItem) == 2 * 64 + 16 * 16, "std140 pads nothing");
static_assert(sizeof(ProbeParams) == (7 + CROSSRAY_MAX_PROBES + 1) * 16 + CROSSRAY_MAX_PROBES * sizeof(ProbeItem),
              "std140 pads nothing");
static_assert(sizeof(PlanarParams) == (1 + CROSSRAY_MAX_PLANAR_PROBES * 4) * 16, "std140 pads nothing");
} // namespace layout32

#undef CROSSRAY_SHARED_PASS_PARAMS_GLSL
#undef CROSSRAY_MAX_PYRAMID_LEVELS
#undef CROSSRAY_SHARED_PROBE_PARAMS_GLSL
#undef CROSSRAY_MAX_PROBES
#undef CROSSRAY_SHARED_PLANAR_PARAMS_GLSL
#undef CROSSRAY_MAX_PLANAR_PROBES

namespace layout64 {
using vec4 = glm::dvec4;
using ivec4 = glm::ivec4;
using mat4 = glm::dmat4;
#include "shaders/crossray/shared/pass_params.glsl"
#include "shaders/crossray/shared/probe_params.glsl"
#include "shaders/crossray/shared/planar_params.glsl"
} // namespace layout64

inline constexpr int kMaxPyramidLevels = CROSSRAY_MAX_PYRAMID_LEVELS;
inline constexpr int kMaxProbes = CROSSRAY_MAX_PROBES;

template <class Params>
std::vector<std::byte> bytesOf(const Params& params)
{
    std::vector<std::byte> bytes(sizeof(Params));
    std::memcpy(bytes.data(), &params, sizeof(Params));
    return bytes;
}

} // namespace crossray
