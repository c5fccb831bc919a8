#include "harness/bench/reference_path.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace crossray {

namespace {

constexpr int kBisections = 5;

bool isStart(const YardstickRay& ray, const glm::dvec2& positionSS)
{
    return static_cast<int>(positionSS.x) == ray.x && static_cast<int>(positionSS.y) == ray.y;
}

// Every pixel under the ray: hit where the ray is inside [depth, depth + thickness] somewhere in it.
TracerAnswer walkPixels(const DepthImage& image, const YardstickRay& ray, double thickness)
{
    const ScreenPath path = makeScreenPath(image, ray);
    if (!path.exists) return makeNoHit(0, 0);
    int x = ray.x, y = ray.y, fetches = 0;
    const int stepX = path.deltaSS.x > 0 ? 1 : -1, stepY = path.deltaSS.y > 0 ? 1 : -1;
    double enter = 0;
    while (enter < path.end && image.contains(x, y)) {
        const double overX = path.deltaSS.x == 0 ? kNoLimit : (x + (stepX > 0) - path.startSS.x) / path.deltaSS.x;
        const double overY = path.deltaSS.y == 0 ? kNoLimit : (y + (stepY > 0) - path.startSS.y) / path.deltaSS.y;
        const double leave = std::min({overX, overY, path.end});
        if (x != ray.x || y != ray.y) {
            ++fetches;
            const double surface = image.depth(x, y);
            const double atEnter = path.depth(enter), atLeave = path.depth(leave);
            if (std::max(atEnter, atLeave) >= surface && std::min(atEnter, atLeave) <= surface + thickness) {
                const double crossing = path.timeOfDepth(surface);
                const bool isInside = crossing >= enter && crossing <= leave;
                return makeHit(path, isInside ? crossing : enter, fetches, fetches);
            }
        }
        (overX <= overY ? x : y) += overX <= overY ? stepX : stepY;
        enter = leave;
    }
    return makeNoHit(fetches, fetches);
}

// Between a sample in front and one behind.
double bisect(const DepthImage& image, const ScreenPath& path, double front, double behind, int& fetches)
{
    for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (front + behind);
        ++fetches;
        const bool isBehind = path.depth(middle) > image.depthAt(path.positionSS(middle));
        (isBehind ? behind : front) = middle;
    }
    return behind;
}

// Even strides over the part of the ray on screen; a stride that sweeps through [depth, depth + thickness] at its end
// has hit.
TracerAnswer marchStrides(const DepthImage& image, const YardstickRay& ray, double thickness, int strides)
{
    const ScreenPath path = makeScreenPath(image, ray);
    if (!path.exists) return makeNoHit(0, 0);
    int fetches = 0;
    for (int i = 1; i <= strides; ++i) {
        const double t = path.end * i / strides, before = path.end * (i - 1) / strides;
        if (isStart(ray, path.positionSS(t))) continue;
        ++fetches;
        const double surface = image.depthAt(path.positionSS(t));
        const double here = path.depth(t), last = path.depth(before);
        if (std::max(here, last) < surface || std::min(here, last) > surface + thickness) continue;
        if (here < surface) continue; // it swept through coming nearer, and is in front again
        return makeHit(path, bisect(image, path, before, t, fetches), fetches, i);
    }
    return makeNoHit(fetches, strides);
}

// A pixel at a time along the longer axis, from a start 1 % of its depth along the ray, so that it does not meet
// itself.
TracerAnswer marchPixels(const DepthImage& image, const YardstickRay& ray, double thickness)
{
    const ScreenPath path = makeScreenPath(image, ray);
    if (!path.exists) return makeNoHit(0, 0);
    const glm::dvec3 originWS = image.frame().unproject(path.startSS, path.depth(0));
    const ScreenPoint biased = image.frame().project(originWS + 0.01 * path.depth(0) * ray.dirWS);
    const double start = glm::length(biased.positionSS - path.startSS) / glm::length(path.deltaSS);
    const double steps = path.pixels();
    int fetches = 0;
    for (int i = std::max(1, static_cast<int>(std::ceil(start / path.end * steps))); i <= steps; ++i) {
        const double t = path.end * i / steps;
        ++fetches;
        const double surface = image.depthAt(path.positionSS(t));
        const double here = path.depth(t), last = path.depth(std::max(start, path.end * (i - 1) / steps));
        if (std::max(here, last) >= surface && std::min(here, last) <= surface + thickness)
            return makeHit(path, t, fetches, fetches);
    }
    return makeNoHit(fetches, fetches);
}

// Ten strides; the first that ends behind is refined by bisection and a secant, and counts where the ray is then less
// than the thickness behind.
TracerAnswer marchBisectSecant(const DepthImage& image, const YardstickRay& ray, double thickness)
{
    constexpr int kStrides = 10;
    const ScreenPath path = makeScreenPath(image, ray);
    if (!path.exists) return makeNoHit(0, 0);
    int fetches = 0;
    for (int i = 1; i <= kStrides; ++i) {
        const double t = path.end * i / kStrides;
        ++fetches;
        if (isStart(ray, path.positionSS(t)) || path.depth(t) <= image.depthAt(path.positionSS(t))) continue;
        double front = path.end * (i - 1) / kStrides, behind = t;
        for (int j = 0; j < kBisections; ++j) {
            const double middle = 0.5 * (front + behind);
            ++fetches;
            (path.depth(middle) > image.depthAt(path.positionSS(middle)) ? behind : front) = middle;
        }
        fetches += 2;
        const double before = path.depth(front) - image.depthAt(path.positionSS(front));
        const double after = path.depth(behind) - image.depthAt(path.positionSS(behind));
        const double share = std::isfinite(before) && after != before ? -before / (after - before) : 1.0;
        if (after > thickness) return makeNoHit(fetches, i);
        return makeHit(path, front + std::clamp(share, 0.0, 1.0) * (behind - front), fetches, i);
    }
    return makeNoHit(fetches, kStrides);
}

// Where the ray leaves the box that the room's walls make, wherever that is on screen.
TracerAnswer leaveRoom(const DepthImage& image, const YardstickRay& ray)
{
    const glm::dvec3 low(-7, 0, -6), high(10, 6, 10);
    const double depth = image.depth(ray.x, ray.y);
    const glm::dvec3 origin = image.frame().unproject({ray.x + 0.5, ray.y + 0.5}, depth);
    double distance = kNoLimit;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.dirWS[axis] == 0) continue;
        const double wall = ray.dirWS[axis] > 0 ? high[axis] : low[axis];
        distance = std::min(distance, (wall - origin[axis]) / ray.dirWS[axis]);
    }
    const ScreenPoint point = image.frame().project(origin + std::max(distance, 0.0) * ray.dirWS);
    if (!image.frame().covers(point)) return makeNoHit(1, 1);
    TracerAnswer answer;
    answer.isHit = true;
    answer.positionSS = point.positionSS;
    answer.linearDepth = point.linearDepth;
    answer.fetches = 1;
    answer.iterations = 1;
    return answer;
}

// Depth that the plane through a pixel shows at a point of the screen; negative where the plane is not seen there.
double planeDepth(const DepthImage& image, int x, int y, const glm::dvec2& positionSS)
{
    const double depth = image.depth(x, y);
    if (!std::isfinite(depth)) return -1;
    const glm::dvec3 surface = image.frame().unproject({x + 0.5, y + 0.5}, depth);
    const Ray look = image.frame().primaryRay(positionSS);
    const glm::dvec3 normal = image.normalWS(x, y);
    const double facing = glm::dot(normal, look.dirWS);
    if (std::abs(facing) < 1e-9) return -1;
    const double distance = glm::dot(normal, surface - look.originWS) / facing;
    return image.frame().linearDepth(look.originWS + distance * look.dirWS);
}

// Knows where the ray ends. Claims a hit where that place is one of the planes of the four pixels around it, or lies
// between their depths where these belong together (so that normals that are bent or missing do not blind it): what the
// depth buffer alone could answer.
TracerAnswer askOracle(const DepthImage& image, const YardstickRay& ray)
{
    if (ray.truth != RayTruth::kAnswerable) return makeNoHit(1, 1);
    const int left = static_cast<int>(std::floor(ray.hitPositionSS.x - 0.5));
    const int top = static_cast<int>(std::floor(ray.hitPositionSS.y - 0.5));
    const double close = 1e-3 * ray.hitLinearDepth;
    double nearest = kNoLimit, farthest = 0;
    bool isShown = false;
    for (int i = 0; i < 4; ++i) {
        const int x = left + i % 2, y = top + i / 2;
        if (!image.contains(x, y)) continue;
        nearest = std::min(nearest, image.depth(x, y));
        farthest = std::max(farthest, image.depth(x, y));
        const double depth = planeDepth(image, x, y, ray.hitPositionSS);
        const double curvature = 0.25 * std::abs(depth - image.depth(x, y));
        isShown = isShown || std::abs(depth - ray.hitLinearDepth) <= close + curvature;
    }
    const bool belong = farthest - nearest <= 0.05 * nearest;
    const bool isBetween = ray.hitLinearDepth >= nearest - close && ray.hitLinearDepth <= farthest + close;
    if (!isShown && !(belong && isBetween)) return makeNoHit(1, 1);
    TracerAnswer answer;
    answer.isHit = true;
    answer.positionSS = ray.hitPositionSS;
    answer.linearDepth = ray.hitLinearDepth;
    answer.fetches = 1;
    answer.iterations = 1;
    return answer;
}

template <class Trace>
TracerMethod makeMethod(std::string name, Trace trace)
{
    return {std::move(name), [trace](const YardstickScene& scene) -> Tracer {
                const auto image = std::make_shared<DepthImage>(scene); // std::function copies its tracer
                return [image, trace](const YardstickRay& ray) { return trace(*image, ray); };
            }};
}

} // namespace

ScreenPath makeScreenPath(const DepthImage& image, const YardstickRay& ray)
{
    ScreenPath path;
    const CameraFrame& frame = image.frame();
    const Camera& camera = frame.camera();
    const double depth = image.depth(ray.x, ray.y);
    const double rate = glm::dot(ray.dirWS, frame.forwardWS());
    if (!std::isfinite(depth) || depth <= camera.nearDistance) return path;
    const double farDistance =
        camera.depthConvention == DepthConvention::kInfiniteReversed ? 65504.0 : camera.farDistance;
    double range = 65504.0;
    if (rate < 0) range = std::min(range, (camera.nearDistance - depth) / rate);
    if (rate > 0) range = std::min(range, (farDistance - depth) / rate);
    if (!(range > 0)) return path;
    path.isOrthographic = camera.projection == ProjectionKind::kOrthographic;
    path.startSS = {ray.x + 0.5, ray.y + 0.5};
    const double endDepth = depth + rate * range;
    const glm::dvec3 origin = frame.unproject(path.startSS, depth);
    path.deltaSS = frame.project(origin + range * ray.dirWS).positionSS - path.startSS;
    path.startAffine = path.isOrthographic ? -depth : 1 / depth;
    path.deltaAffine = (path.isOrthographic ? -endDepth : 1 / endDepth) - path.startAffine;
    path.end = 1;
    const glm::dvec2 size(image.width(), image.height());
    for (int axis = 0; axis < 2; ++axis) {
        const double delta = path.deltaSS[axis];
        if (delta == 0) continue;
        path.end = std::min(path.end, ((delta > 0 ? size[axis] : 0.0) - path.startSS[axis]) / delta);
    }
    path.exists = path.end > 0;
    return path;
}

TracerAnswer makeHit(const ScreenPath& path, double t, int fetches, int iterations)
{
    TracerAnswer answer;
    answer.isHit = true;
    answer.positionSS = path.positionSS(t);
    answer.linearDepth = path.depth(t);
    answer.fetches = fetches;
    answer.iterations = iterations;
    return answer;
}

TracerAnswer makeNoHit(int fetches, int iterations, bool isCapped)
{
    TracerAnswer answer;
    answer.fetches = fetches;
    answer.iterations = iterations;
    answer.isCapped = isCapped;
    return answer;
}

std::vector<TracerMethod> referenceTracers(double thickness)
{
    using Image = const DepthImage&;
    using Asked = const YardstickRay&;
    std::vector<TracerMethod> methods;
    methods.push_back(closestDepthTracer(thickness, 256));
    methods.push_back(makeMethod("10 strides, bisections, secant", [thickness](Image image, Asked ray) {
        return marchBisectSecant(image, ray, thickness);
    }));
    for (const int strides : {64, 256}) {
        methods.push_back(
            makeMethod(fmt::format("{} strides, 5 bisections", strides), [thickness, strides](Image image, Asked ray) {
                return marchStrides(image, ray, thickness, strides);
            }));
    }
    methods.push_back(makeMethod("a pixel a step, 1 % ahead",
                                 [thickness](Image image, Asked ray) { return marchPixels(image, ray, thickness); }));
    methods.push_back(makeMethod("every pixel, nearest depth",
                                 [thickness](Image image, Asked ray) { return walkPixels(image, ray, thickness); }));
    methods.push_back(makeMethod("proxy, the room's box", leaveRoom));
    methods.push_back(depthOracle());
    return methods;
}

TracerMethod depthOracle()
{
    return makeMethod("oracle: what the depth buffer shows", askOracle);
}

} // namespace crossray
