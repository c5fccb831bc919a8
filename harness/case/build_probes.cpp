// [[probe]], [sky] and the hierarchy that asks them.
#include "harness/case/build.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace crossray {

namespace {

VolumeShape shapeOf(const TableReader& table)
{
    const std::string& name = table.text("shape");
    return name == "box" ? VolumeShape::kBox : name == "sphere" ? VolumeShape::kSphere : VolumeShape::kInfinite;
}

void requireSize(const TableReader& table, std::string_view key)
{
    if (table.has(key)) return;
    throw InputError(table.position("shape"),
                     fmt::format("\"{}\" is missing; a {} requires it", key, table.text("shape")));
}

// Keys that the shape has no use for would be read as if they counted.
void refuseKeys(const TableReader& table, std::initializer_list<std::string_view> keys)
{
    for (const std::string_view key : keys) {
        if (!table.has(key)) continue;
        throw InputError(table.position(key),
                         fmt::format("\"{}\" is not allowed where \"shape\" is \"{}\"", key, table.text("shape")));
    }
}

void readSize(const TableReader& table, ProbeVolume& volume)
{
    if (volume.shape == VolumeShape::kBox) {
        refuseKeys(table, {"radius"});
        if (table.has("half_extents")) volume.halfExtents = readVec3(table, "half_extents");
    } else {
        refuseKeys(table, {"half_extents"});
        if (table.has("radius")) volume.halfExtents = glm::dvec3(table.number("radius"));
    }
}

// `key` speaks for all faces, its two signed forms for three of them each.
FaceDistances readDistances(const TableReader& table, const std::string& key)
{
    FaceDistances distances{glm::dvec3(table.number(key)), glm::dvec3(table.number(key))};
    const auto read = [&](const std::string& sign, glm::dvec3& target) {
        if (table.has(key + sign)) target = readVec3(table, key + sign);
    };
    read("_positive", distances.positive);
    read("_negative", distances.negative);
    return distances;
}

void buildInfluence(const TableReader& table, Probe& probe)
{
    ProbeVolume& volume = probe.influence;
    volume.shape = shapeOf(table);
    volume.center = readVec3(table, "center");
    if (const Node* rotation = table.find("rotation")) volume.worldFromVolume = buildRotation(*rotation);
    requireSize(table, volume.shape == VolumeShape::kBox ? "half_extents" : "radius");
    readSize(table, volume);
    if (volume.shape == VolumeShape::kSphere) {
        refuseKeys(table, {"blend_positive", "blend_negative", "blend_normal_positive", "blend_normal_negative",
                           "face_positive", "face_negative"});
    }
    probe.blend = readDistances(table, "blend");
    probe.blendNormal = readDistances(table, "blend_normal");
    probe.facePositive = readVec3(table, "face_positive");
    probe.faceNegative = readVec3(table, "face_negative");
}

// Where it says nothing else, a proxy is its influence. Two shapes in one probe would be two ways of seeing one room.
void buildProxy(const TableReader& probeTable, Probe& probe)
{
    if (!probeTable.has("proxy")) return;
    const TableReader table = probeTable.table("proxy");
    const VolumeShape shape = shapeOf(table);
    probe.minProjectionDistance = table.number("min_distance");
    if (shape == VolumeShape::kInfinite) {
        refuseKeys(table, {"center", "rotation", "half_extents", "radius"});
        return;
    }
    if (shape != probe.influence.shape) {
        const std::string influence = probeTable.table("influence").text("shape");
        throw InputError(table.position("shape"),
                         fmt::format("\"shape\" of the proxy is \"{}\" and that of the influence is \"{}\"; the same "
                                     "shape is allowed, or infinite",
                                     table.text("shape"), influence));
    }
    probe.proxy = probe.influence;
    if (table.has("center")) probe.proxy.center = readVec3(table, "center");
    if (const Node* rotation = table.find("rotation")) probe.proxy.worldFromVolume = buildRotation(*rotation);
    readSize(table, probe.proxy);
}

// Each kind of probe has its own way to see.
void requireSight(const TableReader& table, std::string_view required, std::string_view refused)
{
    const std::string& kind = table.text("kind");
    if (table.has(refused)) {
        throw InputError(
            table.position(refused),
            fmt::format("\"{}\" is not allowed where \"kind\" is \"{}\"; \"{}\" is", refused, kind, required));
    }
    if (!table.has(required))
        throw InputError(table.position("kind"), fmt::format("\"{}\" is missing; kind {} requires it", required, kind));
}

Probe buildProbe(const Node& node, const Case& testCase)
{
    const TableReader table(&node, "probe");
    Probe probe;
    probe.kind = static_cast<ProbeKind>(table.choice("kind"));
    buildInfluence(table.table("influence"), probe);
    buildProxy(table, probe);
    probe.capturePosition =
        table.has("capture_position") ? readVec3(table, "capture_position") : probe.influence.center;
    probe.weight = table.number("weight");
    probe.multiplier = table.number("multiplier");
    probe.importance = table.integer("importance");
    probe.distanceBasedRoughness = table.boolean("distance_based_roughness");
    probe.boxProjection = table.boolean("box_projection");
    if (table.has("rgbm")) {
        const TableReader rgbm = table.table("rgbm");
        probe.rgbm = RgbmDecoding{rgbm.number("alpha"), rgbm.number("range"), rgbm.number("exponent"),
                                  rgbm.number("alpha_weight")};
    }
    if (probe.kind == ProbeKind::kPlanar) {
        requireSight(table, "mirror", "environment");
        probe.mirror = buildMirror(table, testCase, probe.influence.center);
    } else {
        requireSight(table, "environment", "mirror");
        probe.environment =
            buildEnvironment(table.table("environment"), testCase, static_cast<int>(testCase.probes.size()) + 1);
    }
    return probe;
}

} // namespace

void buildProbes(const TableReader& top, Case& testCase)
{
    testCase.dominantDirection = static_cast<DominantDirection>(top.choice("dominant_direction"));
    for (const Node& node : top.find("probe")->items) {
        if (testCase.probes.size() == static_cast<size_t>(kMostProbes)) {
            throw InputError(node.place.position(),
                             fmt::format("[[probe]] stands here once more; at most {} are allowed", kMostProbes));
        }
        testCase.probes.push_back(buildProbe(node, testCase));
    }
}

void buildSky(const TableReader& top, Case& testCase)
{
    const TableReader table = top.table("sky");
    SkySettings& sky = testCase.sky;
    sky.model = static_cast<SkyModel>(table.choice("model"));
    sky.gradient = table.has("gradient") ? readGradient(table.table("gradient")) : testCase.scene.sky;
    if (table.has("environment")) sky.environment = buildEnvironment(table.table("environment"), testCase, 0);
    if (sky.model == SkyModel::kCubemap && !sky.environment) {
        throw InputError(table.position("model"), "\"environment\" is missing in [sky]; cubemap requires it");
    }
}

void buildHierarchy(const TableReader& top, Case& testCase)
{
    for (const std::string& tier : top.texts("hierarchy")) {
        testCase.hierarchy |= tier == "screen" ? kTierScreen : tier == "probes" ? kTierProbes : kTierSky;
    }
    if ((testCase.hierarchy & kTierProbes) && testCase.probes.empty()) {
        throw InputError(top.position("hierarchy"),
                         "\"hierarchy\" has probes, and there is no [[probe]]; one is required");
    }
}

} // namespace crossray
