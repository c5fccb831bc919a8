// Proxies: where a ray leaves a box or a sphere (domain, section 3). Seen from inside: the far face, the far root.
#include "harness/expect/analytic.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

// An origin this close to the proxy's surface, relative to its size, is on it: rounding does not push it outside.
constexpr double kOnSurface = 1e-9;

} // namespace

// All six planes are solved, and those meetings kept that lie on the box: within the other two pairs of faces. The last
// of them is the exit. No interval is cut, and no face is chosen by a sign.
std::optional<double> distanceToBoxExit(const ProxyVolume& proxy, const Ray& ray)
{
    const glm::dmat3 proxyFromWorld = glm::transpose(proxy.worldFromProxy);
    const glm::dvec3 origin = proxyFromWorld * (ray.originWS - proxy.center);
    const glm::dvec3 dir = proxyFromWorld * ray.dirWS;
    const double size = std::max({proxy.halfExtents.x, proxy.halfExtents.y, proxy.halfExtents.z});
    const double slack = kOnSurface * size;
    std::optional<double> exit;
    for (int axis = 0; axis < 3; ++axis) {
        if (dir[axis] == 0.0) continue;
        for (const double sign : {-1.0, 1.0}) {
            const double distance = (sign * proxy.halfExtents[axis] - origin[axis]) / dir[axis];
            const glm::dvec3 meeting = origin + distance * dir;
            bool onBox = true;
            for (int other = 0; other < 3; ++other) {
                if (other != axis && !(std::abs(meeting[other]) <= proxy.halfExtents[other] + slack)) onBox = false;
            }
            if (onBox && (!exit || distance > *exit)) exit = distance;
        }
    }
    if (!exit || *exit < -slack) return std::nullopt;
    return std::max(*exit, 0.0);
}

// From the point of the ray's line that is nearest to the centre, half a chord on (Pythagoras).
std::optional<double> distanceToSphereExit(const ProxyVolume& proxy, const Ray& ray)
{
    const glm::dvec3 toCenter = proxy.center - ray.originWS;
    const double toNearest = glm::dot(toCenter, ray.dirWS);
    const double offAxis = glm::length(toCenter - toNearest * ray.dirWS);
    const double slack = kOnSurface * proxy.radius;
    if (offAxis > proxy.radius + slack) return std::nullopt;
    const double halfChord =
        offAxis < proxy.radius ? std::sqrt((proxy.radius - offAxis) * (proxy.radius + offAxis)) : 0.0;
    const double exit = toNearest + halfChord;
    if (exit < -slack) return std::nullopt;
    return std::max(exit, 0.0);
}

RayEnd projectOnProxy(const CameraFrame& frame, ProjectionModel model, const ProxyVolume& proxy, const EffectRay& ray)
{
    if (ray.status != HitReason::kNone) return {HitClass::kNoRaycast, ray.status, {}};
    const Ray cast{ray.originWS, ray.dirWS};
    std::optional<double> distance = kInfiniteProxyDistance;
    if (model == ProjectionModel::kProxyBox) distance = distanceToBoxExit(proxy, cast);
    if (model == ProjectionModel::kProxySphere) distance = distanceToSphereExit(proxy, cast);
    if (!distance) return {HitClass::kMiss, HitReason::kNoProxyHit, {}};
    const ScreenPoint screen = frame.project(ray.originWS + *distance * ray.dirWS);
    if (!screen.inFront) return {HitClass::kMiss, HitReason::kBehindCamera, {}};
    return {HitClass::kHit, HitReason::kNone, screen};
}

} // namespace crossray
