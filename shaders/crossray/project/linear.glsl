// Screen-space ray tracing by a march of fixed stride over the depth buffer: the baseline that the others are charted
// against.
// Hooks: float fetchLinearDepth(ivec2 pixel)     metres along the view axis; kNoSurfaceDepth and more: no surface
//        void recordLinearStep(LinearStep step)  called once an iteration; a release build leaves it empty
// Source: Unity HDRP reflection documentation (2018), the linear projection; the test in front of and behind the depth
// buffer after McGuire and Mara 2014. Own: the plane of the start, the search by halves after the crossing, and the
// three-valued end.
//
// Samples lie `stride` pixels apart along the longer axis of the ray's way over the screen, or that way is cut into
// `steps` equal parts; the last sample is where the ray ends or leaves the image. A sample is in front of its pixel's
// surface or behind it. Between one in front and one behind the ray has crossed something: with `bisections` that
// stretch is halved so many times, and it is a hit where the ray is, at the sample behind, at most `depthBias` behind
// the surface or no more than the stretch changes its depth. Otherwise it passes behind, and hits nothing until it has
// come out again; a ray that starts behind what is seen (a refracted one) likewise. What continues the plane of the
// start's pixel, as two neighbours tell it on each axis, is the surface on which the ray stands, and is not hit: a
// pixel's one depth is half a pixel off, and near its start the ray is no farther from the surface. The hit is the
// sample behind, so it lies up to a stride (halved `bisections` times) too far along the ray; what is thinner than a
// stride may be missed.
//
// One fetch an iteration, and 9 different ones at the start; halvings count as iterations.
#ifndef CROSSRAY_PROJECT_LINEAR_GLSL
#define CROSSRAY_PROJECT_LINEAR_GLSL

#include "crossray/core/math.glsl"
#include "crossray/core/view.glsl"
#include "crossray/project/march_end.glsl"
#include "crossray/project/screen_ray.glsl"

// Metres: this and more stands for "no surface", which no ray is behind.
const float kNoSurfaceDepth = 1e30;
// Ray and surface within this share of their depth are one: what moving a position to world space and back costs.
const float kLinearStartTolerance = 0.000244140625; // 2^-12
const int kLinearRuns = -1;                         // in place of a reason, while the march goes on

struct LinearSettings {
    float stride;      // pixels between samples; read where steps is below 1. Not above 0 and NaN: 1
    int steps;         // parts of the way, at least 1; below 1: by stride
    int maxIterations; // below 1: no sample, kHitReasonIterationCap; above kMostMarchSteps: that
    float depthBias;   // metres that a surface is thick; negative and NaN count as 0
    int bisections;    // halvings after a crossing; below 1: none
};

// One iteration, as it is recorded.
struct LinearStep {
    int iteration; // from 0
    vec2 positionSS;
    float rayLinearDepth;     // metres
    float surfaceLinearDepth; // of the pixel
    int intersectionKind;     // kIntersectionNone in front, kIntersectionCell behind, kIntersectionDepth a hit
};

struct LinearResult {
    int hitClass;      // kHitClass...
    int reason;        // kHitReason...
    vec2 positionSS;   // of the hit; without one, where the march ended
    float linearDepth; // there, of the ray, metres
    int iterations;
    int intersectionKind; // of the last iteration
};

float fetchLinearDepth(ivec2 pixel);
void recordLinearStep(LinearStep step);

// The plane of the pixel in which a ray starts.
struct LinearStart {
    vec2 centerSS;
    float affineDepth; // at the pixel's centre
    vec2 gradient;     // of the affine depth, a pixel
    bool inFront;      // the ray starts on it or in front of it
    bool isOn;         // on it
};

struct LinearState {
    int samples;    // of the march, halvings apart
    float s;        // of the last of them
    float inner;    // the stretch that is being halved: in front at its inner end ...
    float outer;    // ... behind at its outer one
    float gap;      // metres that the ray is behind at the outer end
    int halvings;   // still to do
    bool inFront;   // of what the last sample of the march showed
    bool wasHidden; // something hid it on its way
};

float fetchAffineDepth(View view, ivec2 pixel)
{
    return affineDepthFromLinear(view.orthographic, fetchLinearDepth(pixel));
}

// Change a pixel along one axis, from the side whose two neighbours go on straight to the pixel: the other may belong
// to another surface, also where it touches. Within 2 pixels of the image's border the other side decides; 0 in images
// of less than 5 pixels, and where that side shows no surface: the way to its depth of 1e30 m is no slope.
float computeLinearGradient(View view, ivec2 pixel, ivec2 axis, int place, int last)
{
    bool hasBefore = place >= 2;
    bool hasAfter = place <= last - 2;
    ivec2 back = choose(hasBefore, axis, ivec2(0));
    ivec2 ahead = choose(hasAfter, axis, ivec2(0));
    float here = fetchAffineDepth(view, pixel);
    float before = fetchAffineDepth(view, pixel - back);
    float after = fetchAffineDepth(view, pixel + ahead);
    float bendBefore = abs(here - 2.0 * before + fetchAffineDepth(view, pixel - back - back));
    float bendAfter = abs(here - 2.0 * after + fetchAffineDepth(view, pixel + ahead + ahead));
    bool isStraighter = bendBefore < bendAfter;
    bool bothSides = hasBefore && hasAfter;
    bool takesBefore = bothSides ? isStraighter : hasBefore;
    bool isSurface = choose(takesBefore, before, after) > affineDepthFromLinear(view.orthographic, kNoSurfaceDepth);
    return choose(isSurface, choose(takesBefore, here - before, after - here), 0.0);
}

LinearStart makeLinearStart(View view, ScreenRay ray, ivec2 lastPixel)
{
    ivec2 pixel = clamp(ivec2(floor(ray.startSS)), ivec2(0), lastPixel);
    float here = fetchAffineDepth(view, pixel);
    vec2 gradient = vec2(computeLinearGradient(view, pixel, ivec2(1, 0), pixel.x, lastPixel.x),
                         computeLinearGradient(view, pixel, ivec2(0, 1), pixel.y, lastPixel.y));
    vec2 centerSS = vec2(pixel) + vec2(0.5);
    float planeAffine = here + dot(gradient, ray.startSS - centerSS);
    float ahead = ray.startAffineDepth - planeAffine;
    float tolerance = kLinearStartTolerance * abs(here);
    return LinearStart(centerSS, here, gradient, ahead >= -tolerance, abs(ahead) <= tolerance);
}

// The pixel shows what the plane of the start continues to.
bool isOnStartPlane(View view, LinearStart start, ivec2 pixel, float linearDepth)
{
    float affine = affineDepthFromLinear(view.orthographic, linearDepth);
    float planeAffine = start.affineDepth + dot(start.gradient, vec2(pixel) + vec2(0.5) - start.centerSS);
    return abs(affine - planeAffine) <= kLinearStartTolerance * abs(affine);
}

// s where the way over the screen leaves the image, at most 1.
float computeLinearEnd(View view, ScreenRay ray)
{
    vec2 border =
        vec2(choose(ray.deltaSS.x < 0.0, 0.0, view.imageSize.x), choose(ray.deltaSS.y < 0.0, 0.0, view.imageSize.y));
    vec2 toBorder = (border - ray.startSS) / ray.deltaSS;
    return clamp(min(toBorder.x, toBorder.y), 0.0, 1.0);
}

// s between two samples.
float computeLinearStride(LinearSettings settings, ScreenRay ray, float end)
{
    float pixels = choose(settings.stride > 0.0, clamp(settings.stride, 0.001, 65536.0), 1.0);
    return choose(settings.steps > 0, end / float(max(settings.steps, 1)), pixels * ray.pixelLength);
}

float linearRayDepth(View view, ScreenRay ray, float s)
{
    return linearDepthFromAffine(view.orthographic, screenRayAffineDepth(ray, s));
}

// Traces from originWS along dirWS (any length). Positions and depths are finite whatever the input; a ray that could
// not start ends at its start.
LinearResult traceLinear(View view, vec3 originWS, vec3 dirWS, LinearSettings settings)
{
    ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    bool isRay = ray.status == kHitReasonNone;
    bool starts = isRay && isOnScreen(view, ray.startSS);
    float end = computeLinearEnd(view, ray);
    float stride = computeLinearStride(settings, ray, end);
    float bias = choose(settings.depthBias > 0.0, min(settings.depthBias, 1e30), 0.0);
    float lastStart = end * (1.0 - 1e-6); // beyond, rounding apart, lies the last sample
    int endReason = choose(end < 1.0, kHitReasonOffScreen, ray.endReason);
    ivec2 lastPixel = ivec2(view.imageSize) - ivec2(1);

    LinearStart start = makeLinearStart(view, ray, lastPixel);
    bool startsInFront = start.inFront || !starts;
    LinearState state = LinearState(0, 0.0, 0.0, 0.0, 0.0, 0, startsInFront, !startsInFront);
    int limit = choose(starts, clamp(settings.maxIterations, 0, kMostMarchSteps), 0);
    int reason = choose(isRay, kHitReasonOffScreen, ray.status);
    reason = choose(starts, kLinearRuns, reason);
    int iterations = 0;
    int kind = kIntersectionNone;
    for (int i = 0; i < limit; ++i) {
        bool halves = state.halvings > 0;
        float next = float(state.samples + 1) * stride;
        float marchS = choose(next < lastStart, next, end);
        float s = choose(halves, 0.5 * (state.inner + state.outer), marchS);
        vec2 positionSS = screenRayPositionSS(ray, s);
        ivec2 pixel = clamp(ivec2(floor(positionSS)), ivec2(0), lastPixel);
        float surfaceDepth = fetchLinearDepth(pixel);
        float rayDepth = linearRayDepth(view, ray, s);
        bool isSurface = surfaceDepth < kNoSurfaceDepth;
        bool continuesStart = isOnStartPlane(view, start, pixel, surfaceDepth);
        bool isOwn = start.isOn && continuesStart;
        bool isDeeper = isSurface && rayDepth > surfaceDepth;
        bool isBehind = isDeeper && !isOwn;

        // A crossing begins, or the stretch of one shrinks.
        bool crosses = isBehind && state.inFront && !halves;
        bool movesOuter = crosses || (halves && isBehind);
        bool movesInner = halves && !isBehind;
        float inner = choose(crosses, state.s, choose(movesInner, s, state.inner));
        float outer = choose(movesOuter, s, state.outer);
        float gap = choose(movesOuter, rayDepth - surfaceDepth, state.gap);
        int halvings = choose(crosses, max(settings.bisections, 0), max(state.halvings - 1, 0));

        // The stretch is as short as it gets: hit it, or pass behind.
        bool isDecided = (crosses || halves) && halvings == 0;
        float change = abs(linearRayDepth(view, ray, outer) - linearRayDepth(view, ray, inner));
        bool isHit = isDecided && gap <= max(bias, change);
        bool passes = isDecided && !isHit;

        bool isUndecided = halves || crosses;
        bool inFront = isUndecided || !isBehind;
        bool hides = isBehind && !state.inFront;
        kind = choose(isHit, kIntersectionDepth, choose(isBehind, kIntersectionCell, kIntersectionNone));
        recordLinearStep(LinearStep(i, positionSS, rayDepth, surfaceDepth, kind));

        float marched = choose(halves, state.s, s);
        bool isFree = halvings == 0;
        bool isAtEnd = marched >= end && isFree;
        state = LinearState(choose(halves, state.samples, state.samples + 1), marched, inner, outer, gap, halvings,
                            inFront && !passes, state.wasHidden || hides || passes);
        iterations = i + 1;
        reason = choose(isHit, kHitReasonNone, choose(isAtEnd, endReason, kLinearRuns));
        if (reason != kLinearRuns) break;
    }
    bool isCapped = reason == kLinearRuns;
    reason = choose(isCapped, kHitReasonIterationCap, reason);
    bool isFound = reason == kHitReasonNone;
    reason = computeMarchReason(reason, state.inFront, state.wasHidden);
    float s = choose(isFound, state.outer, state.s);
    return LinearResult(computeMarchClass(reason), reason, screenRayPositionSS(ray, s), linearRayDepth(view, ray, s),
                        iterations, kind);
}

#endif
