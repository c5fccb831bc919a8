// [history] and [material.thickness_map].
#include "harness/case/build.h"

#include <fmt/format.h>

namespace crossray {

void buildHistory(const TableReader& top, Case& testCase)
{
    if (!top.has("history")) return;
    const TableReader table = top.table("history");
    if (testCase.recorded) {
        throw InputError(top.position("history"),
                         "[history] is not allowed beside [gbuffer], which holds one frame; it is beside [scene]");
    }
    History history;
    history.camera = testCase.camera;
    const TableReader camera = top.table("camera");
    const auto vectorOf = [&](std::string_view key) { return readVec3(table.has(key) ? table : camera, key); };
    const glm::dvec3 eye = vectorOf("eye"), target = vectorOf("target"), up = vectorOf("up");
    const bool isPlaced = table.has("eye") || table.has("target") || table.has("up");
    if (isPlaced) {
        if (glm::length(target - eye) < 1e-12 ||
            !(glm::length(glm::cross(target - eye, up)) > 1e-9 * glm::length(target - eye) * glm::length(up))) {
            throw InputError(top.position("history"),
                             "\"eye\", \"target\" and \"up\" give no view: the target is the eye, or up is along the "
                             "view; any others are allowed");
        }
        history.camera.worldFromView = makeLookAt(eye, target, up);
    }
    if (table.has("fov")) history.camera.fovYDegrees = table.number("fov");
    if (table.has("height")) history.camera.orthographicHeight = table.number("height");
    history.reprojection = static_cast<Reprojection>(table.choice("reprojection"));
    history.levels = table.integer("levels");
    history.poison = static_cast<HistoryPoison>(table.choice("poison"));
    history.poisonEvery = table.integer("poison_every");
    for (const Node& node : table.find("moved")->items) {
        const TableReader moved(&node, "history.moved");
        const int primitive = moved.integer("primitive");
        const auto count = static_cast<int>(testCase.scene.primitives.size());
        if (primitive >= count) {
            throw InputError(moved.position("primitive"),
                             fmt::format("\"primitive\" is {}; below {}, the number of the "
                                         "scene's primitives, is allowed",
                                         primitive, count));
        }
        history.moved.push_back({primitive, readVec3(moved, "by")});
    }
    testCase.history = std::move(history);
}

void buildThicknessMap(const TableReader& material, Case& testCase)
{
    if (!material.has("thickness_map")) return;
    const TableReader table = material.table("thickness_map");
    const bool isGradient = table.has("from") && table.has("to");
    const bool hasGradient = table.has("from") || table.has("to");
    if (table.has("file") ? hasGradient : !isGradient) {
        throw InputError(
            material.position("thickness_map"),
            "[material.thickness_map] is neither a file alone nor a whole gradient; one of them is allowed, "
            "\"file\" or \"from\" and \"to\"");
    }
    ThicknessMap map;
    if (table.has("file")) {
        map.file = resolveInside(testCase, *table.find("file"), "file", true);
    } else {
        map.from = table.number("from");
        map.to = table.number("to");
    }
    map.axis = table.choice("axis");
    testCase.material.thicknessMap = std::move(map);
}

} // namespace crossray
