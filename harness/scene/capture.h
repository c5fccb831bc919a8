// Captures: what an analytic scene looks like from a probe's position, all around as a cubemap. Unlit radiance and sky
// by the double-precision ray caster, one ray through the centre of each texel. Glass is left out: a capture shows what is
// opaque, so that a refracting object can stand around its own probe. Shares no code with the shaders.
#pragma once

#include "harness/scene/cubemap.h"
#include "harness/scene/scene.h"

#include <optional>

namespace crossray {

inline constexpr int kMaxBounces = 16;

struct CaptureSettings {
    glm::dvec3 positionWS{0.0};
    int size = 64;           // texels a side, a power of two
    std::optional<int> face; // that face alone; the others stay black. Nothing: all six
    // How many reflections mirrors show. Nothing: none, they show their own radiance, as in a G-buffer. 0: they are
    // black, as in the first capture of an engine, which has no environment yet. k: captured k times more, each time
    // with the last capture as the mirrors' environment.
    std::optional<int> bounces;
    // The volume on which mirrors look up the last capture (a box or a sphere; its material means nothing). Nothing: by
    // direction alone, as if everything were far away.
    std::optional<Primitive> proxy;
};

// All mip levels. A mirror's colour is its reflectance where mirrors reflect. Throws InputError on a size, a face, a
// bounce count or a proxy that is not allowed, and on an invalid scene.
Cubemap captureCubemap(const Scene& scene, const CaptureSettings& settings);

} // namespace crossray
