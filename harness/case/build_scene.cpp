// [camera], [scene] and [gbuffer].
#include "harness/case/build.h"

#include "harness/scene/scene_families.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <system_error>
#include <tuple>
#include <utility>

namespace crossray {

namespace {

constexpr double kShortest = 1e-12; // metres: below it a vector has no direction

glm::dmat3 rotationAbout(const glm::dvec3& axis, double degrees)
{
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

// The rotation that turns +z to `normal` the short way; half a turn about x for -z.
glm::dmat3 rotationToNormal(const glm::dvec3& normal)
{
    const glm::dvec3 z(0, 0, 1);
    const glm::dvec3 n = glm::normalize(normal);
    const glm::dvec3 axis = glm::cross(z, n);
    const double sine = glm::length(axis);
    if (sine < kShortest) return n.z > 0 ? glm::dmat3(1.0) : rotationAbout({1, 0, 0}, 180.0);
    return rotationAbout(axis / sine, glm::degrees(std::atan2(sine, glm::dot(z, n))));
}

void requireKey(const TableReader& table, std::string_view key, std::string_view shape)
{
    if (!table.has(key)) {
        throw InputError(table.position("shape"), fmt::format("\"{}\" is missing; a {} requires it", key, shape));
    }
}

void refuseKey(const TableReader& table, std::string_view key, std::string_view shape)
{
    if (table.has(key)) {
        throw InputError(table.position(key), fmt::format("\"{}\" is not allowed for a {}", key, shape));
    }
}

// What is round: a sphere, a lens, a torus.
void buildRound(const TableReader& table, Primitive& primitive)
{
    const std::string& shape = table.text("shape");
    requireKey(table, "radius", shape);
    refuseKey(table, "half_extents", shape);
    primitive.radius = table.number("radius");
    // Keys of one shape alone: a key, its shape, its largest value, and whether the shape requires it.
    const std::tuple<const char*, PrimitiveShape, double, bool, double*> own[] = {
        {"thickness", PrimitiveShape::kLens, 2 * primitive.radius, true, &primitive.thickness},
        {"tube_radius", PrimitiveShape::kTorus, primitive.radius, true, &primitive.tubeRadius},
        {"wall", PrimitiveShape::kSphere, primitive.radius, false, &primitive.wall}};
    for (const auto& [key, owner, most, isRequired, value] : own) {
        if (primitive.shape != owner) {
            refuseKey(table, key, shape);
            continue;
        }
        if (isRequired) requireKey(table, key, shape);
        if (!table.has(key)) continue;
        *value = table.number(key);
        if (*value < most || (owner == PrimitiveShape::kLens && *value == most)) continue;
        throw InputError(table.position(key), fmt::format("\"{}\" is {}; above 0 and below {}, by the radius of {}, is "
                                                          "allowed",
                                                          key, *value, most, primitive.radius));
    }
}

void buildExtents(const TableReader& table, Primitive& primitive)
{
    const bool isBox = primitive.shape == PrimitiveShape::kBox;
    if (!isBox && primitive.shape != PrimitiveShape::kPlane) return buildRound(table, primitive);
    const std::string& shape = table.text("shape");
    for (const std::string_view key : {"radius", "thickness", "tube_radius", "wall"})
        refuseKey(table, key, shape);
    if (isBox) requireKey(table, "half_extents", shape);
    const std::vector<double> extents = table.numbers("half_extents");
    const size_t allowed = isBox ? 3 : 2;
    if (!extents.empty() && extents.size() != allowed) {
        throw InputError(table.position("half_extents"),
                         fmt::format("\"half_extents\" has {} values; a {} has {}", extents.size(), shape, allowed));
    }
    for (size_t i = 0; i < extents.size(); ++i)
        primitive.halfExtents[static_cast<int>(i)] = extents[i];
}

Primitive buildPrimitive(const Node& node, double materialIor)
{
    const TableReader table(&node, "scene.primitives");
    Primitive primitive;
    primitive.shape = static_cast<PrimitiveShape>(table.choice("shape"));
    primitive.center = readVec3(table, "center");
    if (const Node* rotation = table.find("rotation")) primitive.worldFromLocal = buildRotation(*rotation);
    if (table.has("normal")) {
        if (primitive.shape != PrimitiveShape::kPlane) refuseKey(table, "normal", table.text("shape"));
        const glm::dvec3 normal = readVec3(table, "normal");
        if (table.has("rotation")) {
            throw InputError(table.position("normal"),
                             "\"normal\" and \"rotation\" are both given; one of them is allowed");
        }
        if (glm::length(normal) < kShortest) {
            throw InputError(table.position("normal"), "\"normal\" has length 0; any other length is allowed");
        }
        primitive.worldFromLocal = rotationToNormal(normal);
    }
    buildExtents(table, primitive);
    primitive.radiance.pattern = static_cast<RadiancePattern>(table.choice("pattern"));
    primitive.radiance.colorA = readVec3(table, "color");
    primitive.radiance.colorB = readVec3(table, "color_b");
    primitive.radiance.cellSize = table.number("cell_size");
    primitive.radiance.axis = table.choice("axis");
    primitive.material = table.text("material");
    primitive.ior = table.has("ior") ? table.number("ior") : materialIor;
    primitive.objectIndex = table.integer("object");
    return primitive;
}

void buildDepthConvention(const TableReader& camera, Case& testCase)
{
    testCase.camera.depthConvention = static_cast<DepthConvention>(camera.choice("depth"));
    testCase.camera.ndcDepthRange = static_cast<NdcDepthRange>(camera.choice("ndc_depth"));
}

bool isInside(const std::filesystem::path& path, const std::filesystem::path& folder)
{
    const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end();
}

} // namespace

glm::dvec3 readVec3(const TableReader& table, std::string_view key)
{
    const std::vector<double> values = table.numbers(key);
    return {values[0], values[1], values[2]};
}

glm::dmat3 buildRotation(const Node& value)
{
    if (value.kind == NodeKind::kList) {
        return rotationAbout({0, 0, 1}, value.items[2].number) * rotationAbout({0, 1, 0}, value.items[1].number) *
               rotationAbout({1, 0, 0}, value.items[0].number);
    }
    const TableReader table(&value, "rotation");
    const glm::dvec3 axis = readVec3(table, "axis");
    if (glm::length(axis) < kShortest) {
        throw InputError(table.position("axis"), "\"axis\" has length 0; any other length is allowed");
    }
    return rotationAbout(glm::normalize(axis), table.number("degrees"));
}

std::filesystem::path resolveInside(const Case& testCase, const Node& path, std::string_view key, bool mustExist)
{
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(testCase.file).parent_path(), error);
    const fs::path resolved = fs::weakly_canonical(folder / path.text, error);
    if (error || fs::path(path.text).is_absolute() || !isInside(resolved, folder) || resolved == folder) {
        throw InputError(
            path.place.position(),
            fmt::format("\"{}\" is \"{}\", which leaves the case's folder; a relative path inside {} is allowed", key,
                        path.text, folder.string()));
    }
    if (mustExist && !fs::is_regular_file(resolved, error)) {
        throw InputError(path.place.position(), fmt::format("\"{}\" is \"{}\", and there is no such file in {}", key,
                                                            path.text, folder.string()));
    }
    return resolved;
}

void buildScene(const TableReader& top, Case& testCase)
{
    const TableReader scene = top.table("scene");
    const std::vector<double> size = scene.numbers("size");
    testCase.camera.width = static_cast<int>(size[0]);
    testCase.camera.height = static_cast<int>(size[1]);
    testCase.scene.upWS = readVec3(scene, "up");
    if (glm::length(testCase.scene.upWS) < kShortest) {
        throw InputError(scene.position("up"), "\"up\" has length 0; any other length is allowed");
    }
    testCase.scene.upWS = glm::normalize(testCase.scene.upWS);
    testCase.screenLayer = static_cast<ScreenLayer>(scene.choice("screen"));
    if (testCase.screenLayer == ScreenLayer::kOpaque && testCase.projection.model == ProjectionModel::kLinear) {
        throw InputError(scene.position("screen"),
                         "\"screen\" is \"opaque\" and the model is \"linear\", which reads the "
                         "pixels' own depths; the other models are allowed");
    }
    testCase.poison = {static_cast<TexelPoison>(scene.choice("poison")),
                       static_cast<PoisonedChannel>(scene.choice("poison_channel")), scene.integer("poison_every")};
    const TableReader sky = scene.table("sky");
    testCase.scene.sky = {readVec3(sky, "zenith"), readVec3(sky, "horizon"), readVec3(sky, "nadir")};
    if (scene.has("generator")) {
        const auto family = static_cast<SceneFamily>(scene.choice("generator"));
        testCase.scene.primitives = makeRandomScene(family, static_cast<uint64_t>(scene.integer("seed"))).primitives;
    } else if (scene.has("seed")) {
        throw InputError(scene.position("seed"), "\"seed\" is given without \"generator\"; both together are allowed");
    }
    for (const std::string_view key : {"primitives", "primitive"}) {
        for (const Node& node : scene.find(key)->items) {
            testCase.scene.primitives.push_back(buildPrimitive(node, testCase.material.ior));
        }
    }
}

void buildCamera(const TableReader& top, Case& testCase)
{
    const TableReader table = top.table("camera");
    Camera& camera = testCase.camera;
    buildDepthConvention(table, testCase);
    camera.projection = static_cast<ProjectionKind>(table.choice("projection"));
    camera.depthFormat = static_cast<DepthFormat>(table.choice("depth_format"));
    if (camera.projection == ProjectionKind::kOrthographic &&
        camera.depthConvention == DepthConvention::kInfiniteReversed) {
        throw InputError(table.position("depth"),
                         "\"depth\" is \"infinite_reversed\" in an orthographic view, whose depth "
                         "cannot be infinite; reversed and standard are allowed");
    }
    camera.fovYDegrees = table.number("fov");
    camera.orthographicHeight = table.number("height");
    camera.nearDistance = table.number("near");
    camera.farDistance = table.number("far");
    if (camera.depthConvention != DepthConvention::kInfiniteReversed && camera.farDistance <= camera.nearDistance) {
        throw InputError(table.position(table.has("far") ? "far" : "near"),
                         fmt::format("\"far\" is {}; beyond \"near\", which is {}, is allowed", camera.farDistance,
                                     camera.nearDistance));
    }
    const TableReader scene = top.table("scene");
    const bool isPlaced = table.has("eye") || table.has("target") || table.has("up");
    if (scene.has("generator") && !isPlaced) {
        const auto family = static_cast<SceneFamily>(scene.choice("generator"));
        const auto seed = static_cast<uint64_t>(scene.integer("seed"));
        camera.worldFromView = makeRandomSceneCamera(family, seed, camera.width, camera.height).worldFromView;
        return;
    }
    const glm::dvec3 eye = readVec3(table, "eye"), target = readVec3(table, "target"), up = readVec3(table, "up");
    if (glm::length(target - eye) < kShortest) {
        throw InputError(table.position(table.has("target") ? "target" : "eye"),
                         "\"target\" is the eye; any other point is allowed");
    }
    if (glm::length(glm::cross(glm::normalize(target - eye), up)) < 1e-9 * glm::length(up) ||
        glm::length(up) < kShortest) {
        throw InputError(table.position("up"),
                         "\"up\" is along the view or has length 0; any other direction is allowed");
    }
    camera.worldFromView = makeLookAt(eye, target, up);
}

void buildRecorded(const TableReader& top, Case& testCase)
{
    const TableReader table = top.table("gbuffer");
    RecordedGBuffer recorded;
    recorded.file = resolveInside(testCase, *table.find("file"), "file", true);
    recorded.cameraFile = resolveInside(testCase, *table.find("camera"), "camera", true);
    if (const Node* truth = table.find("truth")) recorded.truthFile = resolveInside(testCase, *truth, "truth", true);
    recorded.tracedObject = table.integer("object");
    recorded.channels = blenderChannelMap();
    const TableReader channels = table.table("channels");
    constexpr std::array<std::pair<std::string_view, GBufferChannel>, 6> kChannels{{
        {"device_depth", GBufferChannel::kDeviceDepth},
        {"linear_depth", GBufferChannel::kLinearDepth},
        {"normal_ws", GBufferChannel::kNormalWS},
        {"position_ws", GBufferChannel::kPositionWS},
        {"color", GBufferChannel::kColor},
        {"object_index", GBufferChannel::kObjectIndex},
    }};
    for (const auto& [key, channel] : kChannels) {
        if (!channels.has(key)) continue;
        const std::vector<std::string> names = recorded.channels[channel] = channels.texts(key);
        const auto count = static_cast<size_t>(channelCount(channel));
        if (names.size() != count) {
            throw InputError(channels.position(key), fmt::format("\"{}\" has {} name{}; {} allowed", key, names.size(),
                                                                 names.size() == 1 ? "" : "s",
                                                                 count == 1 ? "1 is" : fmt::format("{} are", count)));
        }
    }
    testCase.camera = readCameraJson(recorded.cameraFile);
    const TableReader camera = top.table("camera");
    for (const std::string_view key : {"projection", "eye", "target", "up", "fov", "height", "near", "far"}) {
        if (camera.has(key)) {
            throw InputError(
                camera.position(key),
                fmt::format("\"{}\" is not allowed beside [gbuffer], whose JSON has it; depth and ndc_depth are", key));
        }
    }
    buildDepthConvention(camera, testCase);
    testCase.recorded = std::move(recorded);
}

void buildMaterial(const TableReader& top, Case& testCase)
{
    const TableReader table = top.table("material");
    Material& material = testCase.material;
    material.refractionModel = static_cast<RefractionModel>(table.choice("refraction_model"));
    material.ior = table.number("ior");
    material.thickness = table.number("thickness");
    material.thicknessMultiplier = table.number("thickness_multiplier");
    buildThicknessMap(table, testCase);
    material.roughness = table.number("roughness");
    material.transmittanceColor = readVec3(table, "transmittance_color");
    material.absorptionDistance = table.number("absorption_distance");
    material.fresnel = static_cast<FresnelModel>(table.choice("fresnel"));
    const bool refracts = material.refractionModel != RefractionModel::kNone;
    testCase.effect = refracts ? TraceEffect::kRefraction : TraceEffect::kReflection;
    if (!top.has("trace")) return;
    testCase.effect = top.choice("trace") == 0 ? TraceEffect::kReflection : TraceEffect::kRefraction;
    if (refracts && testCase.effect == TraceEffect::kReflection) {
        throw InputError(top.position("trace"),
                         fmt::format("\"trace\" is \"reflection\" and refraction_model is \"{}\"; "
                                     "\"refraction\" is allowed, or refraction_model = \"none\"",
                                     table.text("refraction_model")));
    }
}

// A tracer of the person's own, where the model asks for it and nowhere else.
void buildOwnTracer(const TableReader& table, Case& testCase)
{
    const bool isOwn = testCase.projection.model == ProjectionModel::kOwn;
    const Node* tracer = table.find("tracer");
    if (isOwn && tracer == nullptr) {
        throw InputError(table.position("model"), "\"tracer\" is missing in [projection]; own requires it");
    }
    if (!isOwn && tracer != nullptr) {
        throw InputError(table.position("tracer"),
                         "\"tracer\" is given without model = \"own\"; both together are allowed");
    }
    if (isOwn) testCase.projection.own.tracer = resolveInside(testCase, *tracer, "tracer", true);
}

void buildProjection(const TableReader& top, Case& testCase)
{
    const TableReader table = top.table("projection");
    Projection& projection = testCase.projection;
    projection.model = static_cast<ProjectionModel>(table.choice("model"));
    projection.hiz.minLevel = table.integer("min_level");
    projection.hiz.depthBias = table.number("depth_bias");
    projection.patches.caution = table.number("caution");
    projection.patches.depthError = table.number("depth_error");
    if (table.has("max_level")) projection.hiz.maxLevel = projection.patches.maxLevel = table.integer("max_level");
    if (table.has("max_iterations")) {
        projection.hiz.maxIterations = projection.patches.maxIterations = projection.own.maxIterations =
            table.integer("max_iterations");
    }
    buildOwnTracer(table, testCase);
    const bool isHiz = projection.model != ProjectionModel::kPatches && projection.model != ProjectionModel::kOwn;
    if (isHiz && projection.hiz.minLevel > projection.hiz.maxLevel) {
        throw InputError(table.position(table.has("min_level") ? "min_level" : "max_level"),
                         fmt::format("\"min_level\" is {}; at most \"max_level\", which is {}, is allowed",
                                     projection.hiz.minLevel, projection.hiz.maxLevel));
    }
    const TableReader linear = table.table("linear");
    projection.linear = {linear.number("stride"), linear.integer("steps"), linear.integer("max_iterations"),
                         linear.number("depth_bias"), linear.integer("bisections")};
    projection.screenWeightDistance = table.number("screen_weight_distance");
    projection.screenWeightForm = static_cast<ScreenWeightForm>(table.choice("screen_weight_form"));

    const TableReader proxy = table.table("proxy");
    const auto require = [&](std::string_view key) {
        if (!proxy.has(key)) {
            throw InputError(
                table.position("model"),
                fmt::format("\"{}\" is missing in [projection.proxy]; {} requires it", key, table.text("model")));
        }
    };
    if (projection.model == ProjectionModel::kProxyBox) require("half_extents");
    if (projection.model == ProjectionModel::kProxySphere) require("radius");
    projection.proxy.center = readVec3(proxy, "center");
    if (proxy.has("half_extents")) projection.proxy.halfExtents = readVec3(proxy, "half_extents");
    if (proxy.has("radius")) projection.proxy.radius = proxy.number("radius");
    if (const Node* rotation = proxy.find("rotation")) projection.proxy.worldFromProxy = buildRotation(*rotation);
}

} // namespace crossray
