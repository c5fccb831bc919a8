// The linear march over a surface that faces the camera (domain, section 3). Its depth is one number there, so a sample
// is behind it exactly where it lies beyond the true hit on the ray's way over the screen: which sample is the first is
// a division, and no depth is compared.
#include "harness/expect/analytic.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

// Along the longer axis, pixels from `from` to where the way towards `to` leaves the image.
double wayToBorder(const glm::dvec2& from, const glm::dvec2& direction, const glm::dvec2& size)
{
    double way = 1e300;
    for (int axis = 0; axis < 2; ++axis) {
        if (direction[axis] == 0.0) continue;
        const double border = direction[axis] > 0.0 ? size[axis] : 0.0;
        way = std::min(way, (border - from[axis]) / direction[axis]);
    }
    return way;
}

} // namespace

LinearMarch marchOnFacingSurface(const Camera& camera, const LinearSettings& settings, const glm::dvec2& startSS,
                                 double startDepth, const glm::dvec2& hitSS, double hitDepth)
{
    const glm::dvec2 size(camera.width, camera.height);
    const glm::dvec2 way = hitSS - startSS;
    const double length = std::max(std::abs(way.x), std::abs(way.y));
    const glm::dvec2 direction = way / length; // a pixel along the longer axis
    const double border = wayToBorder(startSS, direction, size);
    const double stride = settings.steps > 0 ? border / settings.steps : settings.stride;
    const double before = std::floor(length / stride);
    // The last sample lies on the border.
    const double stretch = std::min((before + 1.0) * stride, border) - before * stride;
    const double part = std::ldexp(stretch, -settings.bisections);
    const double found = before * stride + (std::floor((length - before * stride) / part) + 1.0) * part;

    LinearMarch march;
    march.iterations = static_cast<int>(before) + 1 + settings.bisections;
    march.positionSS = startSS + direction * found;
    const double share = found / length;
    march.linearDepth = camera.projection == ProjectionKind::kPerspective
                            ? 1.0 / ((1.0 - share) / startDepth + share / hitDepth)
                            : (1.0 - share) * startDepth + share * hitDepth;
    return march;
}

} // namespace crossray
