// The scenes of the yardstick: rays with their truth, and G-buffers with what is done to them.
#include "harness/bench/tracer_yardstick.h"

#include "harness/scene/camera_frame.h"

#include <array>
#include <atomic>
#include <cmath>

namespace crossray {

namespace {

constexpr double kSelfHit = 1e-6; // metres by which a ray leaves its own surface
constexpr double kNoiseShare = 1e-3;
constexpr std::array<std::string_view, 10> kDisturbances{"none",       "normal_map", "smooth_normals", "no_normals",
                                                         "depth24",    "depth16",    "noise",          "standard32",
                                                         "standard24", "standard16"};

uint64_t nextSerial()
{
    static std::atomic<uint64_t> last = 0;
    return ++last;
}

void fillTruth(const Scene& scene, const CameraFrame& frame, const glm::dvec3& originWS, YardstickRay& ray)
{
    const auto hit = castRay(scene, Ray{originWS, ray.dirWS}, kSelfHit);
    if (!hit) return;
    const ScreenPoint point = frame.project(hit->positionWS);
    if (!point.inFront || !frame.covers(point)) {
        ray.truth = RayTruth::kOffScreen;
        return;
    }
    ray.hitPositionSS = point.positionSS;
    ray.hitLinearDepth = point.linearDepth;
    const Ray look = frame.primaryRay(point.positionSS);
    const auto seen = castPrimaryRay(scene, frame, look);
    const bool isVisible = seen && frame.linearDepth(seen->positionWS) > point.linearDepth * (1 - 1e-6);
    const bool facesCamera = glm::dot(hit->normalWS, ray.dirWS) * glm::dot(hit->normalWS, look.dirWS) > 0;
    ray.truth = isVisible && facesCamera ? RayTruth::kAnswerable : RayTruth::kHidden;
}

// The normal that a mesh of eight shared vertices has there, each vertex's normal pointing away from the middle.
glm::dvec3 smoothNormal(const Primitive& box, const glm::dvec3& positionWS)
{
    const glm::dvec3 local = glm::transpose(box.worldFromLocal) * (positionWS - box.center) / box.halfExtents;
    return box.worldFromLocal * glm::normalize(local);
}

glm::dvec3 disturbNormal(Disturbance disturbance, const Scene& scene, const SurfaceHit& surface,
                         const glm::dvec3& normalWS)
{
    if (disturbance == Disturbance::kNoNormals) return glm::dvec3(0.0);
    if (disturbance == Disturbance::kNormalMap) {
        const glm::dvec3& p = surface.positionWS;
        return glm::normalize(normalWS + 0.3 * glm::dvec3(std::sin(31.0 * p.y + 17.0 * p.z),
                                                          std::sin(29.0 * p.z + 13.0 * p.x),
                                                          std::sin(37.0 * p.x + 11.0 * p.y)));
    }
    const Primitive& primitive = scene.primitives[static_cast<size_t>(surface.primitive)];
    if (primitive.shape != PrimitiveShape::kBox) return normalWS;
    const glm::dvec3 smooth = smoothNormal(primitive, surface.positionWS);
    return glm::dot(smooth, normalWS) < 0 ? -smooth : smooth;
}

void disturbNormals(Disturbance disturbance, const Scene& scene, const CameraFrame& frame, Plane& normals)
{
    for (int y = 0; y < frame.camera().height; ++y) {
        for (int x = 0; x < frame.camera().width; ++x) {
            const auto surface = castPrimaryRay(scene, frame, frame.primaryRay({x + 0.5, y + 0.5}));
            if (!surface) continue;
            double* const value =
                &normals.values[3 * (static_cast<size_t>(y) * static_cast<size_t>(frame.camera().width) +
                                     static_cast<size_t>(x))];
            const glm::dvec3 bent =
                disturbNormal(disturbance, scene, *surface, glm::dvec3(value[0], value[1], value[2]));
            for (int i = 0; i < 3; ++i)
                value[i] = bent[i];
        }
    }
}

bool isStandard(Disturbance disturbance)
{
    return disturbance == Disturbance::kStandard32 || disturbance == Disturbance::kStandard24 ||
           disturbance == Disturbance::kStandard16;
}

// The same depths in the standard convention.
void makeStandard(GBuffer& gbuffer)
{
    const Camera before = gbuffer.camera;
    gbuffer.camera.depthConvention = DepthConvention::kStandard;
    for (double& depth : gbuffer.planes.at(GBufferChannel::kDeviceDepth).values) {
        depth = depth == clearedDeviceDepth(before)
                    ? clearedDeviceDepth(gbuffer.camera)
                    : computeDeviceDepth(gbuffer.camera, computeLinearDepth(before, depth));
    }
}

DepthFormat formatOf(Disturbance disturbance)
{
    if (disturbance == Disturbance::kDepth16 || disturbance == Disturbance::kStandard16) return DepthFormat::kUnorm16;
    if (disturbance == Disturbance::kDepth24 || disturbance == Disturbance::kStandard24) return DepthFormat::kUnorm24;
    return DepthFormat::kFloat32;
}

void disturbDepths(Disturbance disturbance, YardstickScene& scene)
{
    if (isStandard(disturbance)) makeStandard(scene.gbuffer);
    Camera& camera = scene.gbuffer.camera;
    std::vector<double>& depths = scene.gbuffer.planes.at(GBufferChannel::kDeviceDepth).values;
    if (disturbance == Disturbance::kNoise) {
        RandomStream random(scene.seed ^ 0x6e6f697365ULL);
        const double cleared = clearedDeviceDepth(camera);
        for (double& depth : depths) {
            const double share = random.next(1 - kNoiseShare, 1 + kNoiseShare);
            if (depth != cleared) depth = computeDeviceDepth(camera, computeLinearDepth(camera, depth) * share);
        }
        double sum = 0, surfaces = 0; // the tracer takes one bound for the whole image: that of its mean affine depth
        for (const double depth : depths) {
            if (depth == cleared) continue;
            sum += 1 / computeLinearDepth(camera, depth);
            surfaces += 1;
        }
        scene.depthError = surfaces > 0 ? kNoiseShare * sum / surfaces : 0;
        return;
    }
    camera.depthFormat = formatOf(disturbance);
    for (double& depth : depths)
        depth = roundDeviceDepth(camera, depth);
    scene.depthError = computeAffineDepthError(camera);
}

RayTruth truthOf(ScreenKnowledge knowledge)
{
    switch (knowledge) {
    case ScreenKnowledge::kVisible:
        return RayTruth::kAnswerable;
    case ScreenKnowledge::kHidden:
        return RayTruth::kHidden;
    case ScreenKnowledge::kOffScreen:
        return RayTruth::kOffScreen;
    case ScreenKnowledge::kNoRay:
    case ScreenKnowledge::kSky:
        break;
    }
    return RayTruth::kNothing;
}

} // namespace

std::span<const Disturbance> allDisturbances()
{
    static constexpr std::array kAll{Disturbance::kNone,      Disturbance::kNormalMap,  Disturbance::kSmoothNormals,
                                     Disturbance::kNoNormals, Disturbance::kDepth24,    Disturbance::kDepth16,
                                     Disturbance::kNoise,     Disturbance::kStandard32, Disturbance::kStandard24,
                                     Disturbance::kStandard16};
    return kAll;
}

std::string_view nameOf(Disturbance disturbance)
{
    return kDisturbances[static_cast<size_t>(disturbance)];
}

std::optional<Disturbance> findDisturbance(std::string_view name)
{
    for (const Disturbance disturbance : allDisturbances()) {
        if (nameOf(disturbance) == name) return disturbance;
    }
    return std::nullopt;
}

YardstickScene makeYardstickScene(SceneFamily family, uint64_t seed, int width, int height, int stride,
                                  Disturbance disturbance)
{
    const Scene scene = makeRandomScene(family, seed);
    const Camera camera = makeRandomSceneCamera(family, seed, width, height);
    const CameraFrame frame(camera);
    const std::array channels{GBufferChannel::kDeviceDepth, GBufferChannel::kNormalWS};
    YardstickScene made;
    made.seed = seed;
    made.gbuffer = renderGBuffer(scene, camera, channels);
    made.serial = nextSerial();
    for (int y = 0; y < height; y += stride) {
        for (int x = 0; x < width; x += stride) {
            const Ray primary = frame.primaryRay({x + 0.5, y + 0.5});
            const auto surface = castPrimaryRay(scene, frame, primary);
            if (!surface) continue;
            YardstickRay ray{.x = x, .y = y, .dirWS = glm::normalize(glm::reflect(primary.dirWS, surface->normalWS))};
            fillTruth(scene, frame, surface->positionWS, ray);
            made.rays.push_back(ray);
        }
    }
    const bool isOfNormals = disturbance == Disturbance::kNormalMap || disturbance == Disturbance::kSmoothNormals ||
                             disturbance == Disturbance::kNoNormals;
    if (isOfNormals) disturbNormals(disturbance, scene, frame, made.gbuffer.planes.at(GBufferChannel::kNormalWS));
    if (!isOfNormals && disturbance != Disturbance::kNone) disturbDepths(disturbance, made);
    return made;
}

YardstickScene makeYardstickRoom(uint64_t seed, int width, int height, int stride)
{
    return makeYardstickScene(SceneFamily::kRandomRoom, seed, width, height, stride);
}

YardstickScene makeYardstickScene(const CaseData& data)
{
    YardstickScene made;
    made.gbuffer = data.screen();
    const bool isRefraction = data.testCase().effect == TraceEffect::kRefraction;
    made.serial = nextSerial();
    const Truth& truth = data.truth();
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            made.rays.push_back(
                {x, y, pixel.rayDirWS, truthOf(pixel.screen), pixel.hitPositionSS, pixel.hitLinearDepth});
            if (isRefraction) made.rays.back().originWS = pixel.rayOriginWS;
        }
    }
    return made;
}

} // namespace crossray
