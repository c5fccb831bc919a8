// The screen weight (domain, section 2): how much a hit counts near the border of the image.
#include "harness/expect/analytic.h"

#include <algorithm>

namespace crossray {

namespace {

// The cubic with S(0) = 0, S(1) = 1 and flat ends, from its point symmetry about (1/2, 1/2).
double smoothStep(double x)
{
    const double fromMiddle = x - 0.5;
    return 0.5 + fromMiddle * (1.5 - 2.0 * fromMiddle * fromMiddle);
}

// One axis. Linear in the distance to the nearer border: 0 on it, 1 from `width` on.
double rampAt(double coordinate, double width, bool smooth)
{
    if (!(coordinate >= 0.0 && coordinate <= 1.0)) return 0.0;
    if (!(width > 0.0)) return 1.0;
    const double toBorder = coordinate < 0.5 ? coordinate : 1.0 - coordinate;
    if (toBorder >= width) return 1.0;
    const double share = toBorder / width;
    return smooth ? smoothStep(share) : share;
}

} // namespace

glm::dvec3 rayDirectionNDC(const Camera& camera, const glm::dvec3& originWS, const glm::dvec3& dirWS)
{
    const glm::dmat4 clipFromWorld = computeClipFromView(camera) * computeViewFromWorld(camera);
    const glm::dvec4 start = clipFromWorld * glm::dvec4(originWS, 1.0);
    const glm::dvec4 change = clipFromWorld * glm::dvec4(dirWS, 0.0);
    const glm::dvec3 forwardWS = -glm::dvec3(camera.worldFromView[2]);
    const double depth = glm::dot(originWS - glm::dvec3(camera.worldFromView[3]), forwardWS);
    if (!(depth > 0.0)) return glm::dvec3(0.0);
    const glm::dvec2 rate = (glm::dvec2(change) * start.w - glm::dvec2(start) * change.w) / (start.w * start.w);
    const double way = glm::length(rate);
    if (!(way > 1e-6 / depth)) return glm::dvec3(0.0);
    const double inverseDepthRate = -glm::dot(dirWS, forwardWS) / (depth * depth);
    return {rate / way, inverseDepthRate / way};
}

double screenWeightAt(const glm::dvec2& uv, double distance, ScreenWeightForm form)
{
    // Today's form measures 1 - |2x - 1|, twice the distance to the border, against the same number.
    const double width = form == ScreenWeightForm::kSmoothToday ? 0.5 * distance : distance;
    const bool smooth = form != ScreenWeightForm::kLinear;
    return rampAt(uv.x, width, smooth) * rampAt(uv.y, width, smooth);
}

} // namespace crossray
