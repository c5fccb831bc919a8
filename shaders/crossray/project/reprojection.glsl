// Where what a pixel shows now was on screen in the previous frame.
// Hooks: none. Source: Nehab et al. 2007, "Accelerating Real-Time Shading with Reverse Reprojection Caching".
//
// Both ways answer with a place in UV of the previous image. Off that image, behind that camera, or from input that is
// no number, there is no history: isOnScreen is false, and a place that is no number is 0.
#ifndef CROSSRAY_PROJECT_REPROJECTION_GLSL
#define CROSSRAY_PROJECT_REPROJECTION_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"

struct Reprojection {
    vec2 positionUV;
    bool isOnScreen; // borders included
};

Reprojection makeReprojection(vec2 positionUV, bool isPlaced)
{
    bool isNumber = isPlaced && isFinite(positionUV);
    bool isPastStart = all(greaterThanEqual(positionUV, vec2(0.0)));
    bool isBeforeEnd = all(lessThanEqual(positionUV, vec2(1.0)));
    bool isInside = isPastStart && isBeforeEnd;
    return Reprojection(choose(isNumber, positionUV, vec2(0.0)), isNumber && isInside);
}

// By the motion vector at the place: UV now less UV then. It knows the camera's motion and the objects'.
Reprojection reprojectByMotion(vec2 positionUV, vec2 motionUV)
{
    return makeReprojection(positionUV - motionUV, true);
}

// By the previous camera alone: exact for what stands still, and wrong by an object's own motion.
Reprojection reprojectByView(View previousView, vec3 positionWS)
{
    ScreenPosition previous = projectWSToSS(previousView, positionWS);
    return makeReprojection(previous.positionSS / previousView.imageSize, previous.inFront);
}

#endif
