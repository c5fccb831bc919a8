// What a person's own tracer is given, what it may ask, and what it answers; docs/own-tracer.md is the manual. Nothing
// else may be read: harness/compile/confine.h refuses it, counts the rounds of the tracer's loops and ends those that
// go on for ever. Hooks: fetchDepthPyramid, fetchLinearDepth, fetchNormalWS, countFetch, recordStep, the invocation's
// own ints ownRounds and ownCoarsestLevel, and the block params.
#ifndef PASS_OWN_INTERFACE_GLSL
#define PASS_OWN_INTERFACE_GLSL

#include "crossray/core/view.glsl"
#include "crossray/project/linear.glsl"
#include "crossray/project/screen_ray.glsl"
#include "crossray/shared/outputs.glsl"

struct OwnRay {
    vec3 originWS;     // on the surface that the pixel shows, or where a refracted ray leaves its material; metres
    vec3 dirWS;        // unit
    ivec2 pixel;       // whose ray it is
    ivec2 imageSize;   // pixels
    float depthBias;   // [projection] depth_bias, metres
    int maxIterations; // [projection] max_iterations
};

struct OwnHit {
    int hitClass;      // kHitClassHit, kHitClassMiss or kHitClassUnknown
    int reason;        // kHitReason..., why it is no hit
    vec2 positionSS;   // of the hit, else where the way ended; pixels
    float linearDepth; // of the hit, metres
    float confidence;  // of a hit, [0,1]
};

// The ray's way over the screen, from its start to the image's border, the near plane or the far plane.
struct OwnPath {
    vec2 startSS; // pixels
    vec2 deltaSS; // to the end, pixels; no component is 0
    float startAffineDepth;
    float deltaAffineDepth;
    int endReason; // kHitReason... of a way that is gone to its end, or why there is none
    bool exists;
};

ivec2 ownImageSize()
{
    return depthPyramidSize(0);
}

void ownRecordRead(ivec2 cell, int level, vec2 range)
{
    ivec2 size = ivec2(1 << level);
    vec2 centerSS = (vec2(cell) + vec2(0.5)) * vec2(size);
    recordStep(
        RecordedStep(ownRounds - 1, level, cell, size, centerSS, 0.0, range.x, range.y, range.x, kIntersectionNone));
}

// Metres along the view axis; kNoSurfaceDepth where the pixel shows no surface, or is none of the image's. One read.
float ownLinearDepth(ivec2 pixel)
{
    ivec2 inside = clamp(pixel, ivec2(0), ownImageSize() - ivec2(1));
    float linearDepth = choose(inside == pixel, fetchLinearDepth(inside), kNoSurfaceDepth);
    ownRecordRead(pixel, 0, vec2(linearDepth));
    return linearDepth;
}

// Whether the G-buffer has a surface there. One read.
bool ownHasSurface(ivec2 pixel)
{
    return ownLinearDepth(pixel) < kNoSurfaceDepth;
}

// World space, as the G-buffer has it; 0 outside the image. One read.
vec3 ownNormalWS(ivec2 pixel)
{
    countFetch();
    ivec2 inside = clamp(pixel, ivec2(0), ownImageSize() - ivec2(1));
    return choose(inside == pixel, fetchNormalWS(inside), vec3(0.0));
}

// Levels of the depth pyramid, and the size of one: half of the finer one's, rounded down, at least 1.
int ownLevelCount()
{
    return depthPyramidLevelCount();
}
ivec2 ownLevelSize(int level)
{
    return depthPyramidSize(clamp(level, 0, depthPyramidLevelCount() - 1));
}

// Nearest and farthest linear depth in a cell of the depth pyramid, metres. One read.
vec2 ownDepthRange(ivec2 cell, int level)
{
    int inRange = clamp(level, 0, depthPyramidLevelCount() - 1);
    ivec2 inside = clamp(cell, ivec2(0), depthPyramidSize(inRange) - ivec2(1));
    ownCoarsestLevel = max(ownCoarsestLevel, inRange);
    vec2 range = fetchDepthPyramid(inside, inRange);
    ownRecordRead(inside, inRange, range);
    return range;
}

// Where a point is on screen; inFront is false behind the eye.
ScreenPosition ownProject(vec3 positionWS)
{
    return projectWSToSS(loadView(), positionWS);
}

// The point that is seen at a place on screen, at a linear depth.
vec3 ownPositionWS(vec2 positionSS, float linearDepth)
{
    return positionWSFromSS(loadView(), positionSS, linearDepth);
}

OwnPath ownPath(OwnRay ray)
{
    View view = loadView();
    ScreenRay whole = makeScreenRay(view, ray.originWS, ray.dirWS);
    bool isRay = whole.status == kHitReasonNone;
    bool exists = isRay && isOnScreen(view, whole.startSS);
    float end = computeLinearEnd(view, whole);
    int endReason = choose(end < 1.0 || !exists, kHitReasonOffScreen, whole.endReason);
    return OwnPath(whole.startSS, whole.deltaSS * end, whole.startAffineDepth, whole.deltaAffineDepth * end,
                   choose(isRay, endReason, whole.status), exists);
}

// Pixels, at the share t of the way, [0,1].
vec2 ownPathSS(OwnPath path, float t)
{
    return path.startSS + path.deltaSS * t;
}

// The ray's linear depth there, metres: exact, whatever the perspective.
float ownPathDepth(OwnPath path, float t)
{
    return linearDepthFromAffine(loadView().orthographic, path.startAffineDepth + path.deltaAffineDepth * t);
}

OwnHit ownHit(vec2 positionSS, float linearDepth)
{
    return OwnHit(kHitClassHit, kHitReasonNone, positionSS, linearDepth, 1.0);
}

// No hit: a miss where the ray ran out of the scene (kHitReasonSky), unknown for any other reason.
OwnHit ownEnd(int reason, vec2 positionSS)
{
    return OwnHit(choose(reason == kHitReasonSky, kHitClassMiss, kHitClassUnknown), reason, positionSS, 0.0, 0.0);
}

#endif
