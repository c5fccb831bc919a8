#include "harness/bench/jitter.h"

#include "harness/expect/truth_class.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace crossray {

std::vector<Camera> makeJitteredCameras(const Camera& camera)
{
    std::vector<Camera> cameras(kJitterDirections, camera);
    const bool isPerspective = camera.projection == ProjectionKind::kPerspective;
    // A pixel in the middle of the image: radians, or metres.
    const double pixel = isPerspective ? 2.0 * std::tan(glm::radians(camera.fovYDegrees) / 2) / camera.height
                                       : camera.orthographicHeight / camera.height;
    for (size_t i = 0; i < cameras.size(); ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / kJitterDirections;
        const double right = kJitterPixels * pixel * std::cos(turn), up = kJitterPixels * pixel * std::sin(turn);
        glm::dmat4 moved(1.0);
        if (isPerspective) {
            // The shortest rotation of the view axis -z towards (right, up).
            const glm::dvec3 forward = glm::normalize(glm::dvec3(right, up, -1.0));
            const glm::dvec3 side = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
            moved = glm::dmat4(glm::dvec4(side, 0), glm::dvec4(glm::cross(side, forward), 0), glm::dvec4(-forward, 0),
                               glm::dvec4(0, 0, 0, 1));
        } else {
            moved[3] = glm::dvec4(right, up, 0, 1);
        }
        cameras[i].worldFromView = camera.worldFromView * moved;
    }
    return cameras;
}

ClassImage classesOf(const Truth& truth)
{
    ClassImage classes(truth.pixels.size());
    std::transform(truth.pixels.begin(), truth.pixels.end(), classes.begin(),
                   [](const TruthPixel& pixel) { return static_cast<uint8_t>(classOf(pixel.screen)); });
    return classes;
}

ClassImage classesOf(const Plane& hitSuccess, int scale, int width, int height)
{
    ClassImage classes;
    classes.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double value =
                hitSuccess.at(std::min(x / scale, hitSuccess.width - 1), std::min(y / scale, hitSuccess.height - 1));
            classes.push_back(static_cast<uint8_t>(value));
        }
    }
    return classes;
}

void countFlips(const ClassImage& truthBefore, const ClassImage& truthAfter, const ClassImage& before,
                const ClassImage& after, FlipCount& count)
{
    constexpr auto kNone = static_cast<uint8_t>(HitClass::kNoRaycast);
    for (size_t pixel = 0; pixel < before.size(); ++pixel) {
        if (truthBefore[pixel] == kNone || truthAfter[pixel] == kNone) continue;
        count.rays += 1;
        count.flips += before[pixel] != after[pixel];
    }
}

JitterViews makeJitterViews(const Case& testCase, const Truth& truth)
{
    JitterViews views;
    views.cameras = makeJitteredCameras(testCase.camera);
    views.before = classesOf(truth);
    for (const Camera& camera : views.cameras) {
        views.after.push_back(classesOf(computeTruth(testCase.scene, camera, testCase.effect, testCase.screenLayer)));
        countFlips(views.before, views.after.back(), views.before, views.after.back(), views.truth);
    }
    return views;
}

} // namespace crossray
