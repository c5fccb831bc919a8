// Reflection probes and the hierarchy in closed form (domain, sections 1 and 6), in doubles, sharing no code with the
// shaders.
#pragma once

#include "harness/expect/analytic.h"
#include "harness/scene/cubemap.h"

#include <optional>
#include <vector>

namespace crossray {

// What a probe asks for at a surface, [0,1]; `reflectedWS` is the direction that a box's face fades go by.
double probeWeightAt(const Probe& probe, const SurfacePoint& surface, const glm::dvec3& reflectedWS);

// The places of the probes in the order in which HDRP asks them.
std::vector<size_t> hdrpOrder(const std::vector<Probe>& probes);

// What a case projects on at a surface: its own proxy or, for proxy_probe, that of the first probe which counts there,
// and the infinite one where none does.
struct ChosenProxy {
    ProjectionModel model = ProjectionModel::kProxyInfinite;
    ProxyVolume volume;
};
ChosenProxy chooseProxy(const Case& testCase, const SurfacePoint& surface, const glm::dvec3& dirWS);

// A reflection as the probe's capture saw it.
struct ProbeSight {
    glm::dvec3 dirWS{0.0};
    double distance = 0;            // metres along the ray
    double distanceFromCapture = 0; // metres
};
ProbeSight lookThroughProbe(const Probe& probe, const Ray& ray);

// Perceptual roughness in, perceptual roughness or mip level out.
double distanceBasedRoughness(double roughness, const ProbeSight& sight);
double probeMipLevel(double roughness, int levels);
glm::dvec3 dominantDirection(const SurfacePoint& surface, const glm::dvec3& reflectedWS, double roughness,
                             DominantDirection form);

// A cubemap at a mip level, linear between texels, across the edges of its faces, and between levels.
glm::dvec3 filterCubemap(const Cubemap& cubemap, const glm::dvec3& dirWS, double level);

// What each tier and probe got of a pixel, and what they show.
struct HierarchyShare {
    glm::dvec4 tiers{0.0};  // screen, standard probes, planar probes, sky
    glm::dvec4 probes{0.0}; // the first four of the case
    glm::dvec3 color{0.0};
    glm::dvec3 probeDirWS{0.0}; // of the first probe that got something
    double probeMipLevel = 0;
};
// The screen's part is given: what it asks for, and its colour.
HierarchyShare shareHierarchy(const CaseData& data, const SurfacePoint& surface, const EffectRay& ray,
                              double screenWeight, const glm::dvec3& screenColor);

} // namespace crossray
