// What a probe or a sky shows: [environment], and the mirror of a planar probe.
#include "harness/case/build.h"
#include "harness/scene/cubemap.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace crossray {

namespace {

glm::dvec3 colorOf(const Node& list)
{
    return {list.items[0].number, list.items[1].number, list.items[2].number};
}

EnvironmentContent buildColors(const TableReader& table)
{
    if (table.has("solid")) return SolidColor{readVec3(table, "solid")};
    if (table.has("gradient")) return GradientColors{readGradient(table.table("gradient"))};
    const bool isFaces = table.has("faces");
    const std::vector<Node>& colors = table.find(isFaces ? "faces" : "levels")->items;
    if (!isFaces) {
        if (colors.empty())
            throw InputError(table.position("levels"), "\"levels\" is empty; 1 colour or more is allowed");
        LevelColors levels;
        std::transform(colors.begin(), colors.end(), std::back_inserter(levels.colors), colorOf);
        return levels;
    }
    FaceColors faces;
    if (colors.size() != faces.colors.size()) {
        throw InputError(table.position("faces"),
                         fmt::format("\"faces\" has {} colours; 6 are allowed: +x, -x, +y, -y, +z, -z", colors.size()));
    }
    std::transform(colors.begin(), colors.end(), faces.colors.begin(), colorOf);
    return faces;
}

CubemapFile buildFile(const TableReader& table, const Case& testCase)
{
    if (table.has("size"))
        throw InputError(table.position("size"), "\"size\" is not allowed beside \"file\", which has its own");
    return {resolveInside(testCase, *table.find("file"), "file", true)};
}

SceneCapture buildCapture(const TableReader& table, const Case& testCase, int probe)
{
    if (probe == 0)
        throw InputError(table.position("capture"), "a sky has no position to capture from; \"file\" is allowed");
    if (testCase.recorded)
        throw InputError(table.position("capture"), "[gbuffer] has no scene to capture; \"file\" is allowed");
    SceneCapture capture;
    capture.mode = static_cast<SceneCapture::Mode>(table.choice("capture"));
    capture.position = table.position("capture");
    if (table.has("bounces")) capture.bounces = table.integer("bounces");
    if (const int face = table.choice("face"); face > 0) capture.face = face - 1; // the first choice is all
    if (capture.mode == SceneCapture::Mode::kRealtime) {
        if (table.has("file"))
            throw InputError(table.position("file"), "\"file\" is not allowed beside capture = \"realtime\"");
        return capture;
    }
    if (table.has("file")) {
        capture.bakedFile = resolveInside(testCase, *table.find("file"), "file", false);
    } else {
        const std::string name = fmt::format("{}.probe{}.exr", testCase.file.stem().string(), probe);
        capture.bakedFile = testCase.file.parent_path() / name;
    }
    return capture;
}

} // namespace

Sky readGradient(const TableReader& table)
{
    return {readVec3(table, "zenith"), readVec3(table, "horizon"), readVec3(table, "nadir")};
}

Environment buildEnvironment(const TableReader& table, const Case& testCase, int probe)
{
    constexpr std::array<std::string_view, 6> kContents{"solid", "faces", "levels", "gradient", "file", "capture"};
    std::string_view given;
    for (const std::string_view key : kContents) {
        if (!table.has(key) || (key == "file" && table.has("capture"))) continue;
        if (!given.empty()) {
            throw InputError(table.position(key), fmt::format("two contents, \"{}\" and \"{}\"; exactly one of {} is "
                                                              "allowed",
                                                              given, key, fmt::join(kContents, ", ")));
        }
        given = key;
    }
    if (given.empty()) {
        throw InputError(table.position(""),
                         fmt::format("no content; exactly one of {} is required", fmt::join(kContents, ", ")));
    }
    for (const std::string_view key : {"bounces", "face"}) {
        if (table.has(key) && given != "capture")
            throw InputError(table.position(key), fmt::format("\"{}\" is not allowed without \"capture\"", key));
    }
    if (!isCubeSize(table.integer("size"))) {
        throw InputError(table.position("size"),
                         fmt::format("\"size\" is {}; a power of two is allowed", table.integer("size")));
    }
    if (given == "capture") return {buildCapture(table, testCase, probe), table.integer("size")};
    if (given == "file") return {buildFile(table, testCase), 0};
    return {buildColors(table), table.integer("size")};
}

ProbeMirror buildMirror(const TableReader& probeTable, const Case& testCase, const glm::dvec3& influenceCenter)
{
    const TableReader table = probeTable.table("mirror");
    ProbeMirror mirror;
    mirror.position = table.has("position") ? readVec3(table, "position") : influenceCenter;
    if (const Node* rotation = table.find("rotation")) mirror.normal = buildRotation(*rotation)[2];
    if (table.has("normal")) {
        if (table.has("rotation")) {
            throw InputError(table.position("normal"),
                             "\"normal\" and \"rotation\" are both given; one of them is allowed");
        }
        const glm::dvec3 normal = readVec3(table, "normal");
        if (glm::length(normal) < 1e-12)
            throw InputError(table.position("normal"), "\"normal\" has length 0; any other length is allowed");
        mirror.normal = glm::normalize(normal);
    }
    if (testCase.recorded)
        throw InputError(probeTable.position("kind"), "[gbuffer] has no scene to capture; kind reflection is allowed");
    if (table.has("fov")) {
        if (testCase.camera.projection == ProjectionKind::kOrthographic)
            throw InputError(table.position("fov"), "\"fov\" is not allowed with an orthographic camera");
        mirror.fovYDegrees = table.number("fov");
    }
    const std::vector<double> size = table.numbers("size");
    mirror.width = size.empty() ? testCase.camera.width : static_cast<int>(size[0]);
    mirror.height = size.empty() ? testCase.camera.height : static_cast<int>(size[1]);
    mirror.linearFilter = table.choice("filter") == 1;
    return mirror;
}

} // namespace crossray
