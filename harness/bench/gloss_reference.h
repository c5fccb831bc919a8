// What a rough mirror shows, by numerical integration in doubles over whatever is around it: what the mappings from
// roughness to a mip level are held against. Shares no code with the shaders.
#pragma once

#include "harness/scene/cubemap.h"

#include <glm/glm.hpp>

#include <functional>

namespace crossray {

using RadianceByDirection = std::function<glm::dvec3(const glm::dvec3& dirWS)>;

// Lobes of the half vector h. GGX: D = 1 / (1 + (a^2 - 1) (n.h)^2)^2 up to a factor, with Smith's shadowing of both
// directions (Heitz 2014); a = r^2. Blinn-Phong: D = (n.h)^p, p = 2/a^2 - 2, shadowing n.l n.v.
enum class GlossLobe { kGgx, kBlinnPhong };

// Mean of the radiance, weighed by the lobe of perceptual roughness r in [0, 1] around the mirror direction of a
// surface that is seen from `toEye`; both unit, on one side of each other. Exact for a constant; by `samples`
// directions that are spread evenly over the lobe (Hammersley's points), the same on every machine. r = 0: the mirror
// direction alone.
glm::dvec3 integrateGloss(const RadianceByDirection& radiance, const glm::dvec3& normal, const glm::dvec3& toEye,
                          double roughness, GlossLobe lobe, int samples);

// Mean weighed by the power of the cosine to `dir`, over the half space around it; power 0: all of that evenly.
glm::dvec3 integratePhong(const RadianceByDirection& radiance, const glm::dvec3& dir, double power, int samples);

// A chain whose level l shows the Phong lobe that the Built-in pipeline's exact mapping reads there: of the roughness
// r = l/6 the power 2/r^4 - 2, evenly over the half space from level 6 on; level 0 shows the directions themselves.
// `samplesTaken` counts the radiances that all of it asked for.
struct FilteredChain {
    Cubemap cubemap;
    double samplesTaken = 0;
};
FilteredChain filterByLobes(const RadianceByDirection& radiance, int size);

} // namespace crossray
