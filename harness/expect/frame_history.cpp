#include "harness/expect/frame_history.h"

#include "harness/base/error.h"
#include "harness/scene/camera_frame.h"
#include "harness/scene/exr.h"
#include "harness/scene/gbuffer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace crossray {

namespace {

constexpr double kSkyDistance = 1e9; // metres; the sky stands so far that no camera's motion shifts it

double poisonValue(HistoryPoison poison)
{
    switch (poison) {
    case HistoryPoison::kNan:
        return std::numeric_limits<double>::quiet_NaN();
    case HistoryPoison::kInfinity:
        return std::numeric_limits<double>::infinity();
    case HistoryPoison::kNegative:
        return -1.0;
    case HistoryPoison::kNone:
        break;
    }
    return 0.0;
}

Plane renderColor(const Case& testCase)
{
    const History& history = *testCase.history;
    constexpr std::array kChannels{GBufferChannel::kColor};
    Scene scene = makePreviousScene(testCase);
    if (testCase.screenLayer == ScreenLayer::kOpaque) scene = makeOpaqueScene(scene);
    GBuffer frame = renderGBuffer(scene, history.camera, kChannels);
    Plane color = std::move(frame.planes.at(GBufferChannel::kColor));
    if (history.poison == HistoryPoison::kNone) return color;
    for (int y = 0; y < color.height; ++y)
        for (int x = 0; x < color.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                if (isPoisoned(history, x, y)) color.at(x, y, channel) = poisonValue(history.poison);
    return color;
}

// The primitives of the scene that the screen shows, by their numbers in the whole one.
std::vector<int> findShown(const Case& testCase)
{
    std::vector<int> shown;
    for (size_t i = 0; i < testCase.scene.primitives.size(); ++i) {
        const bool isGlass = testCase.scene.primitives[i].material == "glass";
        if (!isGlass || testCase.screenLayer == ScreenLayer::kAll) shown.push_back(static_cast<int>(i));
    }
    return shown;
}

Plane computeMotion(const Case& testCase)
{
    const bool isOpaque = testCase.screenLayer == ScreenLayer::kOpaque;
    const Scene scene = isOpaque ? makeOpaqueScene(testCase.scene) : testCase.scene;
    const std::vector<int> shown = findShown(testCase);
    const Camera& camera = testCase.camera;
    const CameraFrame now(camera), previous(testCase.history->camera);
    Plane motion("Motion", camera.width, camera.height, 2, std::numeric_limits<double>::quiet_NaN());
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec2 centerSS(x + 0.5, y + 0.5);
            const Ray ray = now.primaryRay(centerSS);
            const auto hit = castPrimaryRay(scene, now, ray);
            const auto then =
                hit ? findPreviousUV(testCase, previous, hit->positionWS, shown[static_cast<size_t>(hit->primitive)])
                    : findPreviousUV(testCase, previous, ray.originWS + kSkyDistance * ray.dirWS, -1);
            if (!then) continue;
            const glm::dvec2 moved = centerSS / glm::dvec2(camera.width, camera.height) - *then;
            motion.at(x, y, 0) = moved.x;
            motion.at(x, y, 1) = moved.y;
        }
    return motion;
}

} // namespace

Scene makePreviousScene(const Case& testCase)
{
    Scene scene = testCase.scene;
    for (const PrimitiveMotion& moved : testCase.history->moved)
        scene.primitives[static_cast<size_t>(moved.primitive)].center -= moved.by;
    return scene;
}

std::optional<glm::dvec2> findPreviousUV(const Case& testCase, const CameraFrame& previous,
                                         const glm::dvec3& positionWS, int primitive)
{
    glm::dvec3 then = positionWS;
    for (const PrimitiveMotion& moved : testCase.history->moved)
        if (moved.primitive == primitive) then -= moved.by;
    const ScreenPoint point = previous.project(then);
    if (!point.inFront) return std::nullopt;
    return point.positionSS / glm::dvec2(previous.camera().width, previous.camera().height);
}

bool isPoisoned(const History& history, int x, int y)
{
    const int every = history.poisonEvery;
    return history.poison != HistoryPoison::kNone && x % every == every / 2 && y % every == every / 2;
}

FrameHistory makeFrameHistory(const Case& testCase)
{
    validateCamera(testCase.history->camera);
    return {renderColor(testCase), computeMotion(testCase)};
}

Plane makeThicknessMap(const Case& testCase)
{
    const ThicknessMap& map = *testCase.material.thicknessMap;
    const Camera& camera = testCase.camera;
    if (!map.file.empty()) {
        std::map<std::string, Plane> channels = readExrChannels(map.file);
        if (channels.size() == 1) {
            Plane& plane = channels.begin()->second;
            if (plane.width == camera.width && plane.height == camera.height) return std::move(plane);
        }
        throw InputError(testCase.position,
                         fmt::format("the thickness map {} is not one channel of {}x{}, which alone is allowed",
                                     map.file.string(), camera.width, camera.height));
    }
    Plane plane("Thickness", camera.width, camera.height, 1);
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            const double share = map.axis == 0 ? (x + 0.5) / camera.width : (y + 0.5) / camera.height;
            plane.at(x, y) = map.from + share * (map.to - map.from);
        }
    return plane;
}

} // namespace crossray
