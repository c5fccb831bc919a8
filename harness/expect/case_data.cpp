#include "harness/expect/expect.h"

#include "harness/base/error.h"
#include "harness/expect/environment.h"
#include "harness/expect/analytic.h"
#include "harness/scene/camera_frame.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <string_view>

namespace crossray {

struct CaseData::Lazy {
    std::mutex mutex;
    std::shared_ptr<const std::vector<SurfacePoint>>
        surfaces; // both shared with the data of a case that is alike there
    std::shared_ptr<const Truth> truth;
    std::optional<std::vector<Cubemap>> environments;
    std::optional<std::vector<Plane>> colorLevels;
};

namespace {

double poisonValue(TexelPoison texel)
{
    switch (texel) {
    case TexelPoison::kNan:
        return std::numeric_limits<double>::quiet_NaN();
    case TexelPoison::kInfinity:
        return std::numeric_limits<double>::infinity();
    case TexelPoison::kMinusInfinity:
        return -std::numeric_limits<double>::infinity();
    case TexelPoison::kNegative:
        return -1.0;
    case TexelPoison::kHuge:
        return 3e38;
    case TexelPoison::kNone:
    case TexelPoison::kZero:
        break;
    }
    return 0.0;
}

void poisonPlane(const GBufferPoison& poison, Plane& plane)
{
    for (int y = poison.every / 2; y < plane.height; y += poison.every)
        for (int x = poison.every / 2; x < plane.width; x += poison.every)
            for (int channel = 0; channel < plane.channels; ++channel)
                plane.at(x, y, channel) = poisonValue(poison.texel);
}

// What shaders read. Which pixels trace, the truth and the closed forms know the scene.
GBuffer renderPoisoned(const Case& testCase, const Scene& scene)
{
    using enum GBufferChannel;
    GBuffer gbuffer = renderGBuffer(scene, testCase.camera, channelsFor(testCase));
    const GBufferPoison& poison = testCase.poison;
    if (poison.texel == TexelPoison::kNone) return gbuffer;
    if (poison.channel != PoisonedChannel::kNormal) poisonPlane(poison, gbuffer.planes.at(kDeviceDepth));
    if (poison.channel != PoisonedChannel::kDepth) poisonPlane(poison, gbuffer.planes.at(kNormalWS));
    return gbuffer;
}

GBuffer makeGBuffer(const Case& testCase)
{
    if (!testCase.recorded) return renderPoisoned(testCase, testCase.scene);
    return readGBuffer(testCase.recorded->file, testCase.camera, testCase.recorded->channels, channelsFor(testCase));
}

std::string_view tracedMaterial(TraceEffect effect)
{
    return effect == TraceEffect::kReflection ? "mirror" : "glass";
}

std::optional<SurfaceHit> castPixel(const Scene& scene, const CameraFrame& frame, size_t pixel)
{
    const auto width = static_cast<size_t>(frame.camera().width);
    const glm::dvec2 center(static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5);
    return castPrimaryRay(scene, frame, frame.primaryRay(center));
}

// By the object index, which the G-buffer has already; only where primitives of different materials share an index by
// casting once more.
std::vector<bool> findTracedPixels(const Scene& scene, const GBuffer& gbuffer, TraceEffect effect)
{
    const std::string_view material = tracedMaterial(effect);
    std::map<int, bool> tracedByIndex{{0, false}};
    bool ambiguous = false;
    for (size_t i = 0; i < scene.primitives.size(); ++i) {
        const bool traces = scene.primitives[i].material == material;
        const auto [entry, isNew] = tracedByIndex.emplace(objectIndexOf(scene, static_cast<int>(i)), traces);
        ambiguous = ambiguous || (!isNew && entry->second != traces);
    }
    const Plane& indices = gbuffer.plane(GBufferChannel::kObjectIndex);
    const CameraFrame frame(gbuffer.camera);
    std::vector<bool> traced(indices.pixelCount());
    for (size_t pixel = 0; pixel < traced.size(); ++pixel) {
        if (ambiguous) {
            const auto hit = castPixel(scene, frame, pixel);
            traced[pixel] = hit && scene.primitives[static_cast<size_t>(hit->primitive)].material == material;
        } else {
            traced[pixel] = tracedByIndex.at(static_cast<int>(indices.values[pixel]));
        }
    }
    return traced;
}

std::vector<bool> findRecordedPixels(const GBuffer& gbuffer, int object)
{
    const Plane& indices = gbuffer.plane(GBufferChannel::kObjectIndex);
    std::vector<bool> traced(indices.pixelCount());
    for (size_t pixel = 0; pixel < traced.size(); ++pixel) {
        const double index = indices.values[pixel];
        traced[pixel] = object != 0 ? index == static_cast<double>(object) : index != 0.0;
    }
    return traced;
}

std::vector<SurfacePoint> castSurfaces(const Scene& scene, const Camera& camera, const std::vector<bool>& traced)
{
    const CameraFrame frame(camera);
    std::vector<SurfacePoint> surfaces(traced.size());
    const auto width = static_cast<size_t>(camera.width);
    for (size_t pixel = 0; pixel < traced.size(); ++pixel) {
        if (!traced[pixel]) continue;
        const Ray ray =
            frame.primaryRay({static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5});
        const auto hit = castPrimaryRay(scene, frame, ray);
        surfaces[pixel] = {hit->positionWS, hit->backFace ? -hit->normalWS : hit->normalWS, -ray.dirWS, hit->primitive,
                           std::nullopt};
    }
    return surfaces;
}

std::vector<SurfacePoint> readSurfaces(const GBuffer& gbuffer, const std::vector<bool>& traced)
{
    const Plane& positions = gbuffer.plane(GBufferChannel::kPositionWS);
    const Plane& normals = gbuffer.plane(GBufferChannel::kNormalWS);
    const glm::dmat4& worldFromView = gbuffer.camera.worldFromView;
    std::vector<SurfacePoint> surfaces(traced.size());
    for (size_t pixel = 0; pixel < traced.size(); ++pixel) {
        if (!traced[pixel]) continue;
        const double* p = &positions.values[pixel * 3];
        const double* n = &normals.values[pixel * 3];
        SurfacePoint& surface = surfaces[pixel];
        surface.positionWS = {p[0], p[1], p[2]};
        const glm::dvec3 normal(n[0], n[1], n[2]);
        if (normal != glm::dvec3(0.0)) surface.normalWS = glm::normalize(normal);
        surface.toEyeWS = gbuffer.camera.projection == ProjectionKind::kPerspective
                              ? glm::normalize(glm::dvec3(worldFromView[3]) - surface.positionWS)
                              : glm::dvec3(worldFromView[2]);
    }
    return surfaces;
}

Truth makeTruth(const Case& testCase, const GBuffer& gbuffer)
{
    if (!testCase.recorded) return computeTruth(testCase.scene, testCase.camera, testCase.effect, testCase.screenLayer);
    const RecordedGBuffer& recorded = *testCase.recorded;
    if (recorded.truthFile.empty()) {
        throw InputError(testCase.position,
                         "the recorded G-buffer comes without a truth file; an expectation of this case may be "
                         "analytic, constant, golden or agree, or [gbuffer] names a truth");
    }
    return readTruth(recorded.truthFile, gbuffer, readSceneJson(recorded.cameraFile), testCase.effect,
                     recorded.tracedObject);
}

} // namespace

std::vector<GBufferChannel> channelsFor(const Case& testCase)
{
    using enum GBufferChannel;
    // A recorded truth is told by what the G-buffer shows: it needs everything.
    if (testCase.recorded) return {kDeviceDepth, kLinearDepth, kNormalWS, kPositionWS, kColor, kObjectIndex};
    std::vector<GBufferChannel> channels{kDeviceDepth, kNormalWS, kObjectIndex};
    const bool color = std::any_of(testCase.outputs.begin(), testCase.outputs.end(), [](const OutputInfo& output) {
        return output.name == "Color" || output.name == "SampledColor";
    });
    if (color) channels.push_back(kColor);
    return channels;
}

namespace {

bool isSameFile(const std::optional<RecordedGBuffer>& a, const std::optional<RecordedGBuffer>& b)
{
    if (!a || !b) return a.has_value() == b.has_value();
    return a->file == b->file && a->cameraFile == b->cameraFile && a->truthFile == b->truthFile &&
           a->channels == b->channels && a->tracedObject == b->tracedObject;
}

// No picture shows what glass does to light.
Scene asSeen(Scene scene)
{
    for (Primitive& primitive : scene.primitives)
        primitive.ior = 1;
    return scene;
}

bool showsTheSame(const Case& a, const Case& b)
{
    return a.camera == b.camera && a.poison == b.poison && isSameFile(a.recorded, b.recorded) &&
           asSeen(a.scene) == asSeen(b.scene);
}

bool hasChannels(const GBuffer& gbuffer, const std::vector<GBufferChannel>& channels)
{
    return std::all_of(channels.begin(), channels.end(),
                       [&](GBufferChannel channel) { return gbuffer.planes.contains(channel); });
}

} // namespace

CaseData::CaseData(const Case& testCase) : CaseData(testCase, nullptr) {}
CaseData::CaseData(const Case& testCase, const CaseData& earlier) : CaseData(testCase, &earlier) {}

CaseData::CaseData(const Case& testCase, const CaseData* earlier) : testCase_(testCase), lazy_(std::make_unique<Lazy>())
{
    const bool showsSame = earlier != nullptr && showsTheSame(testCase, earlier->testCase_);
    const std::vector<GBufferChannel> channels = channelsFor(testCase);
    if (showsSame && hasChannels(*earlier->gbuffer_, channels))
        gbuffer_ = earlier->gbuffer_;
    else
        gbuffer_ = std::make_shared<const GBuffer>(makeGBuffer(testCase));
    traced_ = testCase.recorded ? findRecordedPixels(*gbuffer_, testCase.recorded->tracedObject)
                                : findTracedPixels(testCase.scene, *gbuffer_, testCase.effect);
    if (testCase.screenLayer == ScreenLayer::kOpaque) {
        if (showsSame && earlier->opaque_ && hasChannels(*earlier->opaque_, channels))
            opaque_ = earlier->opaque_;
        else
            opaque_ = std::make_shared<const GBuffer>(renderPoisoned(testCase, makeOpaqueScene(testCase.scene)));
    }
    if (testCase.history) history_ = makeFrameHistory(testCase);
    if (testCase.material.thicknessMap) thicknessMap_ = makeThicknessMap(testCase);
    if (!showsSame || testCase.effect != earlier->testCase_.effect) return;
    const std::lock_guard lock(earlier->lazy_->mutex);
    if (!thicknessMap_ && !earlier->thicknessMap_) lazy_->surfaces = earlier->lazy_->surfaces;
    if (testCase.screenLayer == earlier->testCase_.screenLayer && testCase.scene == earlier->testCase_.scene)
        lazy_->truth = earlier->lazy_->truth;
}

CaseData::~CaseData() = default;
CaseData::CaseData(CaseData&&) noexcept = default;
CaseData& CaseData::operator=(CaseData&&) noexcept = default;

const std::vector<SurfacePoint>& CaseData::surfaces() const
{
    const std::lock_guard lock(lazy_->mutex);
    if (!lazy_->surfaces) {
        std::vector<SurfacePoint> surfaces = testCase_.recorded
                                                 ? readSurfaces(*gbuffer_, traced_)
                                                 : castSurfaces(testCase_.scene, testCase_.camera, traced_);
        for (size_t pixel = 0; thicknessMap_ && pixel < traced_.size(); ++pixel) {
            surfaces[pixel].thickness = thicknessMap_->values[pixel] * testCase_.material.thicknessMultiplier;
        }
        lazy_->surfaces = std::make_shared<const std::vector<SurfacePoint>>(std::move(surfaces));
    }
    return *lazy_->surfaces;
}

const std::vector<Cubemap>& CaseData::environments() const
{
    const std::lock_guard lock(lazy_->mutex);
    if (!lazy_->environments) {
        lazy_->environments.emplace();
        for (const Probe& probe : testCase_.probes)
            lazy_->environments->push_back(makeEnvironment(testCase_, probe.environment, &probe));
        if (testCase_.sky.environment) {
            lazy_->environments->push_back(makeEnvironment(testCase_, *testCase_.sky.environment, nullptr));
        }
    }
    return *lazy_->environments;
}

const std::vector<Plane>& CaseData::colorLevels() const
{
    const std::lock_guard lock(lazy_->mutex);
    if (!lazy_->colorLevels) lazy_->colorLevels = averageLevels(history_->color);
    return *lazy_->colorLevels;
}

const Truth& CaseData::truth() const
{
    const std::lock_guard lock(lazy_->mutex);
    if (!lazy_->truth) lazy_->truth = std::make_shared<const Truth>(makeTruth(testCase_, *gbuffer_));
    return *lazy_->truth;
}

std::vector<HitTruth> CaseData::hitTruth() const
{
    const Truth& known = truth();
    std::vector<HitTruth> hits(traced_.size());
    for (size_t pixel = 0; pixel < traced_.size(); ++pixel) {
        const TruthPixel& here = known.pixels[pixel];
        hits[pixel] = {traced_[pixel], traced_[pixel] && here.screen == ScreenKnowledge::kVisible, here.hitPositionSS.x,
                       here.hitPositionSS.y};
    }
    return hits;
}

} // namespace crossray
