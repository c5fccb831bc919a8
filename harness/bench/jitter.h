// The camera moved by a hundredth of a pixel: how many rays change their class, by a method and in truth.
#pragma once

#include "harness/expect/expect.h"

#include <cstdint>
#include <vector>

namespace crossray {

inline constexpr int kJitterDirections = 16;
inline constexpr double kJitterPixels = 0.01;

// The camera turned so that the middle of its image moves by kJitterPixels in each of the directions; an orthographic
// one shifted by as much.
std::vector<Camera> makeJitteredCameras(const Camera& camera);

// Classes of a view, 0 to 3 as HitSuccess has them, a pixel each.
using ClassImage = std::vector<uint8_t>;
ClassImage classesOf(const Truth& truth);
// Of a plane of HitSuccess; a coarser one stands for `scale` pixels each way of an image of that size.
ClassImage classesOf(const Plane& hitSuccess, int scale, int width, int height);

// Pixels that trace a ray in both views, and those of them whose class differs.
struct FlipCount {
    double rays = 0, flips = 0;
    double share() const { return rays > 0 ? flips / rays : 0; }
};
// Which pixels trace is the truth's to say: one rule for all methods.
void countFlips(const ClassImage& truthBefore, const ClassImage& truthAfter, const ClassImage& before,
                const ClassImage& after, FlipCount& count);

// What is there to move: the case, its views, and the true classes of each.
struct JitterViews {
    std::vector<Camera> cameras;
    ClassImage before;
    std::vector<ClassImage> after;
    FlipCount truth; // what really changes: no method that is right can have less
};
// Throws what computeTruth throws. The case has an analytic scene.
JitterViews makeJitterViews(const Case& testCase, const Truth& truth);

} // namespace crossray
