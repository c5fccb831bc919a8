// A world-space ray as a straight way over the screen.
// Hooks: none. Source: McGuire and Mara 2014, "Efficient GPU Screen-Space Ray Tracing" (1/z is linear over the screen).
//
// Affine depth: 1/linearDepth in perspective, -linearDepth in orthographic views. Over the screen it is an affine
// function on any plane and on any ray, and of two depths the nearer one's is larger in both kinds of view. A point of
// the ray is startSS + s*deltaSS with affine depth start + s*delta, s in [0,1].
#ifndef CROSSRAY_PROJECT_SCREEN_RAY_GLSL
#define CROSSRAY_PROJECT_SCREEN_RAY_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"
#include "crossray/shared/outputs.glsl"

// What a march over the screen needs of the view.
struct ScreenFrame {
    ivec2 imageSize; // pixels
    float footprint; // of a pixel: metres a metre of distance, or metres in orthographic views
    bool orthographic;
};

struct ScreenRay {
    vec2 startSS;      // pixels
    vec2 deltaSS;      // pixels to the end of the ray, which may lie off screen; no component is 0
    float pixelLength; // the part of the ray, in s, that is a pixel along its longer axis
    float startAffineDepth;
    float deltaAffineDepth;
    int endReason; // what the end of the ray is: kHitReasonNearPlane or kHitReasonSky
    int status;    // kHitReasonNone, or why there is nothing to march
};

ScreenFrame makeScreenFrame(View view)
{
    return ScreenFrame(ivec2(view.imageSize), 2.0 * view.slope.y / view.imageSize.y, view.orthographic);
}

float affineDepthFromLinear(bool orthographic, float linearDepth)
{
    return choose(orthographic, -linearDepth, 1.0 / max(linearDepth, 1e-30));
}

// Perspective: affine depths of 0 and less lie at infinity or beyond, and give 1e30 m.
float linearDepthFromAffine(bool orthographic, float affineDepth)
{
    return choose(orthographic, -affineDepth, 1.0 / max(affineDepth, 1e-30));
}

vec2 screenRayPositionSS(ScreenRay ray, float s)
{
    return ray.startSS + ray.deltaSS * s;
}

float screenRayAffineDepth(ScreenRay ray, float s)
{
    return ray.startAffineDepth + ray.deltaAffineDepth * s;
}

const float kNever = 1e30; // s of what does not happen
// Rounds of any march, whatever its settings ask for: some drivers end every loop at 65535 and say nothing.
const int kMostMarchSteps = 65534;

// Where a ray crosses the border between pixels border - 1 and border along one axis. Every walk asks by this
// expression alone, so that all of them agree on the order of the pixels, whatever rounding does.
float borderTime(float start, float delta, int border)
{
    return delta == 0.0 ? kNever : (float(border) - start) / delta;
}

// The border of a pixel over which a ray comes in, or goes out.
int entryBorder(int pixel, float delta)
{
    return delta > 0.0 ? pixel : pixel + 1;
}

int exitBorder(int pixel, float delta)
{
    return delta > 0.0 ? pixel + 1 : pixel;
}

// Pixel along one axis, starting at `from`, when all borders up to s are crossed; a border crossed exactly at s counts
// where isInclusive. The guess is at most a pixel off by rounding; the comparisons make it exact.
int pixelAt(float start, float delta, int from, float s, bool isInclusive)
{
    if (delta == 0.0) return from;
    int direction = delta > 0.0 ? 1 : -1;
    int guess = int(floor(clamp(start + delta * s, -2.0, 1e6)));
    guess = delta > 0.0 ? max(guess, from) : min(guess, from);
    for (int i = 0; i < 2; ++i) {
        float entered = borderTime(start, delta, entryBorder(guess, delta));
        bool isIn = isInclusive ? entered <= s : entered < s;
        if (guess != from && !isIn) guess = guess - direction;
    }
    for (int i = 0; i < 2; ++i) {
        float left = borderTime(start, delta, exitBorder(guess, delta));
        bool isOut = isInclusive ? left <= s : left < s;
        if (isOut) guess = guess + direction;
    }
    return guess;
}

// The ray from its origin to the near plane, the far plane, or 65504 m, whichever comes first. Status:
// kHitReasonDegenerateRay for input that is not finite or has no direction; kHitReasonNearPlane when it starts at or
// before the near plane and does not run away from the eye, or starts behind the eye; kHitReasonSky when it starts
// beyond the far plane, not coming back. With a status the ray is a point at screen position 0 and linear depth 1.
ScreenRay makeScreenRay(View view, vec3 originWS, vec3 dirWS)
{
    vec3 dir = safeNormalize(directionVSFromWS(view, dirWS), vec3(0.0));
    vec3 origin = positionVSFromWS(view, originWS);
    bool isDirected = hasDirection(dir);
    bool isPlaced = isFinite(origin);
    float startDepth = -origin.z;
    float depthRate = -dir.z; // metres of depth a metre of ray
    bool isAhead = startDepth > 0.0;
    float toNear = choose(depthRate < 0.0, safeDivide(view.nearDistance - startDepth, depthRate, kFarAway), kFarAway);
    float toFar = choose(depthRate > 0.0, safeDivide(view.farDistance - startDepth, depthRate, kFarAway), kFarAway);
    bool isNear = toNear <= 0.0 || !isAhead;
    bool isFar = toFar <= 0.0;
    float range = min(kFarAway, min(toNear, toFar));
    bool isNearFirst = toNear < toFar;
    bool meetsNear = isNearFirst && toNear < kFarAway;
    float endDepth = choose(meetsNear, view.nearDistance, startDepth + range * depthRate);

    // The difference of the two projections in the form that does not cancel: the lateral part that perspective leaves.
    vec2 scale = screenScale(view);
    float product = choose(isAhead, startDepth * endDepth, 1.0);
    vec2 lateral = choose(view.orthographic, dir.xy, (dir.xy * startDepth - origin.xy * depthRate) / product);
    vec2 delta = scale * lateral * range;
    float divisor = choose(isAhead, startDepth, 1.0);
    vec2 startSS = 0.5 * view.imageSize + scale * origin.xy / choose(view.orthographic, 1.0, divisor);
    float startAffine = affineDepthFromLinear(view.orthographic, startDepth);
    float deltaAffine = (startDepth - endDepth) / choose(view.orthographic, 1.0, product);
    bool isComputed = isFinite(vec4(startSS, delta)) && isFinite(vec2(startAffine, deltaAffine));

    int status = choose(isFar, kHitReasonSky, kHitReasonNone);
    status = choose(isNear, kHitReasonNearPlane, status);
    bool isUsable = isDirected && isPlaced;
    status = choose(isUsable && (isComputed || status != kHitReasonNone), status, kHitReasonDegenerateRay);
    bool isRay = status == kHitReasonNone;
    vec2 deltaSS =
        vec2(awayFromZero(choose(isRay, delta.x, 0.0), 1e-20), awayFromZero(choose(isRay, delta.y, 0.0), 1e-20));
    return ScreenRay(choose(isRay, startSS, vec2(0.0)), deltaSS, 1.0 / max(abs(deltaSS.x), abs(deltaSS.y)),
                     choose(isRay, startAffine, affineDepthFromLinear(view.orthographic, 1.0)),
                     choose(isRay, deltaAffine, 0.0), choose(meetsNear, kHitReasonNearPlane, kHitReasonSky), status);
}

#endif
