// The camera, and the ways between world (WS), view (VS), screen (SS) and depth-buffer values.
// Hooks: none. Source: the projections' definitions; harness/scene/camera.h holds the same conventions in C++.
//
// World space is right-handed, in metres. View space looks down -z with +y up, so that linearDepth = -positionVS.z.
// Screen space counts pixels from the top left corner, y down; pixel (i, j) has its centre at (i + 0.5, j + 0.5). NDC:
// x right, y up.
#ifndef CROSSRAY_CORE_VIEW_GLSL
#define CROSSRAY_CORE_VIEW_GLSL

#include "crossray/core/math.glsl"

struct View {
    mat4 viewFromWorld;
    mat4 worldFromView;
    mat4 clipFromView;
    vec2 imageSize;     // pixels
    vec2 slope;         // perspective: tan(half field of view) in x and y; orthographic: half extents in metres
    float depthA;       // deviceDepth = A + B/linearDepth (perspective) or A + B*linearDepth (orthographic), ...
    float depthB;       // ... always as stored, in [0,1], whatever the API's clip range
    float nearDistance; // metres, > 0
    float farDistance;  // metres; 65504 where the far plane is infinite
    bool orthographic;
    bool reversedDepth; // the near plane is stored as 1, and "no surface" as 0
};

struct ScreenPosition {
    vec2 positionSS;   // pixels; 0 where it is not in front
    float linearDepth; // metres, as it came, also behind the camera
    bool inFront;      // linearDepth > 0: clip w > 0 in perspective
};

// A stored depth is in [0,1]; what is nearer than the near plane's by more than a rounding was never drawn.
const float kMostFromCleared = 1.0009765625; // 1 + 2^-10

bool isSurfaceDepth(View view, float deviceDepth)
{
    float fromCleared = choose(view.reversedDepth, deviceDepth, 1.0 - deviceDepth);
    bool isDrawn = fromCleared > 0.0;
    bool isPossible = fromCleared < kMostFromCleared;
    return isDrawn && isPossible;
}

// True for a depth-buffer value of "no surface": what the buffer is cleared to, what lies outside [0,1], or NaN.
bool isClearedDepth(View view, float deviceDepth)
{
    return isSurfaceDepth(view, deviceDepth) ? false : true;
}

// Metres along the view axis, in (0, farDistance]. Cleared, NaN and impossible values give farDistance.
float linearDepthFromDevice(View view, float deviceDepth)
{
    float shifted = deviceDepth - view.depthA;
    float linearDepth = safeDivide(choose(view.orthographic, shifted, view.depthB),
                                   choose(view.orthographic, view.depthB, shifted), view.farDistance);
    float limited = min(linearDepth, view.farDistance);
    bool isAhead = linearDepth > 0.0;
    return isAhead && isSurfaceDepth(view, deviceDepth) ? limited : view.farDistance;
}

// The stored value for a depth in metres; depths of 0 and less (perspective) give the near plane's.
float deviceDepthFromLinear(View view, float linearDepth)
{
    float inverse = 1.0 / max(choose(linearDepth > 0.0, linearDepth, view.nearDistance), 1e-30);
    return view.depthA + view.depthB * choose(view.orthographic, linearDepth, inverse);
}

vec2 positionNDCFromSS(View view, vec2 positionSS)
{
    vec2 positionUV = positionSS / view.imageSize;
    return vec2(positionUV.x * 2.0 - 1.0, 1.0 - positionUV.y * 2.0);
}

vec3 positionVSFromSS(View view, vec2 positionSS, float linearDepth)
{
    vec2 extent = view.slope * choose(view.orthographic, 1.0, linearDepth);
    return vec3(positionNDCFromSS(view, positionSS) * extent, -linearDepth);
}

vec3 positionWSFromVS(View view, vec3 positionVS)
{
    return (view.worldFromView * vec4(positionVS, 1.0)).xyz;
}

vec3 positionVSFromWS(View view, vec3 positionWS)
{
    return (view.viewFromWorld * vec4(positionWS, 1.0)).xyz;
}

vec3 positionWSFromSS(View view, vec2 positionSS, float linearDepth)
{
    return positionWSFromVS(view, positionVSFromSS(view, positionSS, linearDepth));
}

vec3 directionVSFromWS(View view, vec3 dirWS)
{
    return (view.viewFromWorld * vec4(dirWS, 0.0)).xyz;
}

// Pixels a metre at linear depth 1 (perspective) or anywhere (orthographic); y is negative, as SS runs down.
vec2 screenScale(View view)
{
    return vec2(0.5, -0.5) * view.imageSize / view.slope;
}

// Behind the camera, on the eye's plane, or where the projection overflows: positionSS 0 and inFront false.
ScreenPosition projectVSToSS(View view, vec3 positionVS)
{
    float linearDepth = -positionVS.z;
    bool isAhead = linearDepth > 0.0;
    float divisor = choose(view.orthographic || !isAhead, 1.0, linearDepth);
    vec2 positionSS = 0.5 * view.imageSize + screenScale(view) * positionVS.xy / divisor;
    bool isPlaced = isFinite(positionSS);
    bool inFront = isAhead && isPlaced;
    return ScreenPosition(choose(inFront, positionSS, vec2(0.0)), linearDepth, inFront);
}

ScreenPosition projectWSToSS(View view, vec3 positionWS)
{
    return projectVSToSS(view, positionVSFromWS(view, positionWS));
}

// Inside the image, borders included.
bool isOnScreen(View view, vec2 positionSS)
{
    bool isPastStart = all(greaterThanEqual(positionSS, vec2(0.0)));
    bool isBeforeEnd = all(lessThanEqual(positionSS, view.imageSize));
    return isPastStart && isBeforeEnd;
}

// Unit vector from a surface point towards the eye. At the eye itself, and in orthographic views, against the view's
// axis.
vec3 viewDirectionWS(View view, vec3 positionWS)
{
    vec3 backwardWS = safeNormalize(view.worldFromView[2].xyz, vec3(0.0, 0.0, 1.0));
    vec3 towardsEyeWS = safeNormalize(view.worldFromView[3].xyz - positionWS, backwardWS);
    return choose(view.orthographic, backwardWS, towardsEyeWS);
}

#endif
