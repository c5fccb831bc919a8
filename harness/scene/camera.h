// Cameras. World space is right-handed, metres. View space looks down -z with +y up, so the linear depth of a point is
// -z of its view-space position. NDC: x right, y up, z by convention. Screen space (SS): pixels, origin at the top left
// corner of the image, y down; the centre of pixel (i, j) is (i + 0.5, j + 0.5). UV is SS divided by the image's size.
#pragma once

#include <glm/glm.hpp>

namespace crossray {

enum class ProjectionKind { kPerspective, kOrthographic };
enum class DepthConvention { kReversed, kStandard, kInfiniteReversed };
enum class NdcDepthRange { kZeroToOne, kMinusOneToOne };
// How a depth buffer stores a depth in [0,1]: as a float, or as a whole number of 24 or 16 bits over the largest one.
enum class DepthFormat { kFloat32, kUnorm24, kUnorm16 };

struct Camera {
    ProjectionKind projection = ProjectionKind::kPerspective;
    DepthConvention depthConvention = DepthConvention::kReversed;
    NdcDepthRange ndcDepthRange = NdcDepthRange::kZeroToOne;
    glm::dmat4 worldFromView{1.0}; // rigid
    DepthFormat depthFormat = DepthFormat::kFloat32;
    double fovYDegrees = 60.0;     // perspective: vertical field of view, in (0, 180)
    double orthographicHeight = 2; // orthographic: metres from bottom to top
    double nearDistance = 0.1;     // metres, > 0
    double farDistance = 100.0;    // metres, > near; ignored by kInfiniteReversed
    int width = 64;                // pixels
    int height = 64;
    bool operator==(const Camera&) const = default;
};

struct Ray {
    glm::dvec3 originWS;
    glm::dvec3 dirWS; // unit
};

struct ScreenPoint {
    glm::dvec2 positionSS{0.0}; // 0 where not in front
    double linearDepth = 0;     // metres along the view axis; negative behind the camera
    // As stored in a depth buffer: in [0,1] inside the frustum, also for [-1,1] NDC. 0 where not in front.
    double deviceDepth = 0;
    bool inFront = false;  // linearDepth > 0 (perspective: clip w > 0)
    bool onScreen = false; // in front and inside the image, borders included
};

// worldFromView of a camera at `eyeWS` that looks at `targetWS`. Throws InputError when the eye is the target or the
// view is parallel to `upWS`.
glm::dmat4 makeLookAt(const glm::dvec3& eyeWS, const glm::dvec3& targetWS, const glm::dvec3& upWS);

glm::dmat4 computeViewFromWorld(const Camera& camera);
// Clip space to the camera's convention: z/w is in [0,1] or [-1,1], reversed or not.
glm::dmat4 computeClipFromView(const Camera& camera);

// Ray through a point of the image, from the eye (perspective) or from the eye's plane (orthographic).
Ray computePrimaryRay(const Camera& camera, const glm::dvec2& positionSS);
ScreenPoint projectToScreen(const Camera& camera, const glm::dvec3& positionWS);
glm::dvec3 unprojectFromScreen(const Camera& camera, const glm::dvec2& positionSS, double linearDepth);

// Depth-buffer value in [0,1] (NDC z mapped from [-1,1] where that is the range), and its inverse.
double computeDeviceDepth(const Camera& camera, double linearDepth);
double computeLinearDepth(const Camera& camera, double deviceDepth);
// As the camera's format stores it. A float stays as it is: it is rounded where it is uploaded.
double roundDeviceDepth(const Camera& camera, double deviceDepth);
// The most that 1/linearDepth (orthographic: linearDepth) is off by that rounding; 0 for a reversed float, whose steps
// shrink with the distance as fast.
double computeAffineDepthError(const Camera& camera);
// Depth-buffer value of "no surface": 0 for the reversed conventions, 1 for the standard one.
double clearedDeviceDepth(const Camera& camera);

// Throws InputError with what is allowed when a number is NaN, infinite or out of range, the world matrix is not rigid
// (to 1e-6), the image is not 1 to 16384 a side, or an orthographic camera asks for an infinite far plane.
void validateCamera(const Camera& camera);

} // namespace crossray
