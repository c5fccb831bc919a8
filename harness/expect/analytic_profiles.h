// What the Built-in and the URP profile make of a case's reflection probes (domain, section 6), in closed form.
#pragma once

#include "harness/expect/analytic.h"

#include <array>
#include <vector>

namespace crossray {

// A box along the world's axes. The object is all that traces in the case.
struct WorldBox {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};
WorldBox boundsOfObject(const Case& testCase);

// Shares of a surface point: one a probe of the case, and the sky's.
struct ProfileShares {
    std::vector<double> probes;
    double sky = 1.0;
};

// Rules of one profile. `manual`: what URP's manual says, which the Built-in pipeline shares; else what URP's code
// does.
struct UrpRules {
    bool manual = true;
    bool halfPrecision = false;
};

// Weight of a probe at a point, by its box and blend distance.
double weightInBox(const Probe& probe, const glm::dvec3& positionWS);
// Numbers of the given probes, the one that counts most first.
std::vector<int> orderByUrp(const Case& testCase, std::vector<int> probes, const UrpRules& rules);
// What two probes with these weights get, the first of the order before the second.
std::array<double, 2> shareByUrp(const Case& testCase, std::array<int, 2> probes, std::array<double, 2> weights,
                                 const UrpRules& rules);

ProfileShares weighByUrp(const Case& testCase, const glm::dvec3& positionWS);
ProfileShares weighByBuiltIn(const Case& testCase);

// Mip level of a roughness, before the chain's end cuts it.
double builtInMip(double roughness, bool exact);
// Direction in which the probe is read along a ray.
glm::dvec3 boxProjectedDirection(const Case& testCase, const Probe& probe, const Ray& ray);
// The same by the form that circulates as an optimisation, which takes the face behind the ray for the one ahead.
glm::dvec3 publishedBoxDirection(const Probe& probe, const Ray& ray);
// Radiance of an RGBM texel; `texel` itself where the probe has no such texels.
glm::dvec3 decodedTexel(const Case& testCase, const Probe& probe, const glm::dvec3& texel);

struct ProfileAnswer {
    ProfileShares shares;
    glm::dvec3 firstDirWS{0.0}; // of the first of the case's probes that got something
    double firstMip = 0;
    glm::dvec3 color{0.0};
};
// Why the case has no such answer in closed form, or empty.
std::string refuseProfile(const Case& testCase);
ProfileAnswer answerByProfile(const Case& testCase, const glm::dvec3& positionWS, const EffectRay& ray);

} // namespace crossray
