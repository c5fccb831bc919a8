// Screen-space ray tracing over planes: each pixel is taken as a piece of a plane (project/surface_pyramid.glsl), so
// that a hit is a crossing of two straight lines and needs no search, and coarse cells are planes too.
// Hooks: vec4 fetchSurfaceCell(ivec2 cell, int level)   packed cell of the surface pyramid
//        ivec2 surfacePyramidSize(int level)            cells of a level
//        int surfacePyramidLevelCount()                 levels of the pyramid, at least 1
//        void recordPatchStep(PatchStep step)           called once an iteration; a release build leaves it empty
// Source: own; docs/tracer.md has the measurements behind each rule.
//
// When a ray hits. It runs from the front to the back of a pixel's plane inside the pixel; or it comes into the pixel
// behind its plane, and that plane meets the plane of the pixel before within half a pixel of their border: the surface
// goes on. Else it has passed a silhouette and is hidden. A ray never hits the plane on which it starts.
//
// When it comes out again. One layer of depth cannot tell whether a hidden ray passed behind the object or ran into its
// back. An object is about as deep as it is wide: clearance = gap * width / chord^2, where chord is the distance of the
// surfaces at the two silhouettes, width the part of it across the view, and gap the smallest distance by which the ray
// is behind the surface, at both ends and at kHiddenSamples places between. A chord that runs into the depth hides more
// (often two objects), so it counts twice. The ray has passed where the clearance is at least `caution`.
//
// The result does not depend on the levels: each walk visits the pixels that it visits by whole-numbered cells in one
// order, decides by the same expressions, and skips a cell only where no pixel in it could decide anything.
#ifndef CROSSRAY_PROJECT_PATCH_TRACER_GLSL
#define CROSSRAY_PROJECT_PATCH_TRACER_GLSL

#include "crossray/project/surface_pyramid.glsl"

struct PatchTracerSettings {
    int maxLevel;      // taken into [0, levels - 1]; 0 walks pixel after pixel
    int maxIterations; // below 1: no step, kHitReasonIterationCap; above kMostMarchSteps: that
    float caution;     // clearance that a hidden ray needs to have passed: 0 greedy, 0.4 balanced, 1 and more cautious;
                       // negative and NaN count as 0
    float depthError;  // affine depth by which the buffer may be wrong: for depth in whole numbers half a step divided
                       // by |View.depthB|, for 32-bit floats 0
};

// One iteration, as it is recorded.
struct PatchStep {
    int iteration; // from 0
    int level;
    ivec2 cell;
    CellRect rect;         // its pixels
    vec2 positionSS;       // where the ray enters it
    float rayLinearDepth;  // there
    float nearLinearDepth; // the cell's bounds there
    float farLinearDepth;
    int intersectionKind; // kIntersection...
};

struct PatchTraceResult {
    int hitClass;      // kHitClass...
    int reason;        // kHitReason...
    vec2 positionSS;   // of the hit; without one, where the march ended
    float linearDepth; // there, metres
    int iterations;
    int maxUsedLevel;
    int intersectionKind; // of the last step
    float confidence;     // of a hit: the share of such hits that are right; else 0
};

vec4 fetchSurfaceCell(ivec2 cell, int level);
ivec2 surfacePyramidSize(int level);
int surfacePyramidLevelCount();
void recordPatchStep(PatchStep step);

const int kHiddenSamples = 4;
const int kPatchStartLevel = 2;
// A ray this share of its depth behind a plane is still on it.
const float kPatchTolerance = 0.000003814697265625; // 2^-18
// A ray this near to the plane of its start stands on it: what moving a position to world space and back costs.
const float kPatchStartTolerance = 0.0009765625; // 2^-10
const float kNoClearance = 1e30;                 // of a ray that was never hidden

// Where a ray went out of sight.
struct HiddenStart {
    ivec2 pixel;
    float s;
};

struct PatchWalk {
    ScreenRay ray;
    ScreenRay lifted; // towards the eye by the tolerance: what is compared with planes
    ivec2 startPixel;
    bool stands;      // on the plane of the start pixel
    float depthError; // of the settings, not negative
};

struct PatchState {
    ivec2 pixel;
    int level;
    bool inFront;
    HiddenStart hidden; // where it is not in front
    float clearance;    // smallest so far
};

// The cell under the ray and its part of the ray.
struct PatchCell {
    ivec2 cell;
    CellRect rect;
    SurfaceCell surface;
    float enter;        // s
    float leave;        // s, at most 1
    float frontAtEnter; // affine depth by which the lifted ray is in front of the cell's plane
    float frontAtLeave;
    bool leavesByX;
    bool isLast; // the ray ends in it
};

// How a ray came into a pixel: the later of the borders that it crossed.
struct PixelEntry {
    float s;
    bool isByX;
};

// What one pixel decides.
struct PixelTest {
    bool isHit;
    bool isRefused; // came out again without having passed for sure
    float s;        // of the hit
    bool inFront;   // where the ray leaves it
    HiddenStart hidden;
    float clearance;
};

// Where two borders are crossed at once, the one in x is first.
PixelEntry computePixelEntry(PatchWalk walk, ivec2 pixel)
{
    vec2 start = walk.ray.startSS;
    vec2 delta = walk.ray.deltaSS;
    bool movedX = pixel.x != walk.startPixel.x;
    bool movedY = pixel.y != walk.startPixel.y;
    float sX = movedX ? borderTime(start.x, delta.x, entryBorder(pixel.x, delta.x)) : 0.0;
    float sY = movedY ? borderTime(start.y, delta.y, entryBorder(pixel.y, delta.y)) : 0.0;
    return PixelEntry(clamp(max(sX, sY), 0.0, 1.0), movedX && (!movedY || sX > sY));
}

// The pixel from which the ray came; the start's own for the start.
ivec2 computePixelBefore(PatchWalk walk, ivec2 pixel, bool isByX)
{
    ivec2 direction = ivec2(walk.ray.deltaSS.x > 0.0 ? 1 : -1, walk.ray.deltaSS.y > 0.0 ? 1 : -1);
    bool isStart = pixel == walk.startPixel;
    return isStart ? pixel : pixel - (isByX ? ivec2(direction.x, 0) : ivec2(0, direction.y));
}

SurfaceCell fetchPixelSurface(ivec2 pixel)
{
    return unpackSurfaceCell(fetchSurfaceCell(pixel, 0));
}

float pixelAffineDepth(SurfaceCell surface, ivec2 pixel, vec2 positionSS)
{
    return surfaceAffineDepth(surface, vec2(pixel) + 0.5, positionSS);
}

float liftAffineDepth(float affineDepth, float depthError)
{
    return affineDepth + kPatchTolerance * abs(affineDepth) + depthError;
}

// The start is moved onto its pixel's plane where it stands there to rounding. 1 read.
PatchWalk makePatchWalk(ScreenRay ray, ivec2 startPixel, float depthError)
{
    SurfaceCell surface = fetchPixelSurface(startPixel);
    float onPlane = pixelAffineDepth(surface, startPixel, ray.startSS);
    bool isNear = abs(ray.startAffineDepth - onPlane) <= kPatchStartTolerance * abs(onPlane) + 2.0 * depthError;
    bool stands = isNear && !isSky(surface);
    float end = ray.startAffineDepth + ray.deltaAffineDepth;
    float start = stands ? onPlane : ray.startAffineDepth;
    ScreenRay settled = ray;
    settled.startAffineDepth = start;
    settled.deltaAffineDepth = end - start;
    ScreenRay lifted = ray;
    lifted.startAffineDepth = liftAffineDepth(start, depthError);
    lifted.deltaAffineDepth = liftAffineDepth(end, depthError) - lifted.startAffineDepth;
    return PatchWalk(settled, lifted, startPixel, stands, depthError);
}

// Where the ray is at s, inside a cell: rounding may put it just outside, where the cell's slack says nothing.
vec2 positionInRect(ScreenRay ray, float s, CellRect rect)
{
    return clamp(screenRayPositionSS(ray, s), vec2(rect.begin), vec2(rect.end));
}

// Affine depth by which a ray is in front of the plane of a cell.
float computeFront(ScreenRay ray, float s, SurfaceCell surface, CellRect rect)
{
    return screenRayAffineDepth(ray, s) -
           surfaceAffineDepth(surface, computeRectCenter(rect), positionInRect(ray, s, rect));
}

PatchCell enterPatchCell(View view, PatchWalk walk, PatchState state)
{
    ivec2 cells = surfacePyramidSize(state.level);
    ivec2 cell = computeDepthPyramidCell(state.pixel, state.level, cells);
    CellRect rect = computeCellRect(cell, state.level, cells, ivec2(view.imageSize));
    SurfaceCell surface = unpackSurfaceCell(fetchSurfaceCell(cell, state.level));
    ScreenRay ray = walk.lifted;
    float leaveX = borderTime(ray.startSS.x, ray.deltaSS.x, ray.deltaSS.x > 0.0 ? rect.end.x : rect.begin.x);
    float leaveY = borderTime(ray.startSS.y, ray.deltaSS.y, ray.deltaSS.y > 0.0 ? rect.end.y : rect.begin.y);
    float enter = computePixelEntry(walk, state.pixel).s;
    float leave = max(min(leaveX, leaveY), enter);
    float inside = min(leave, 1.0);
    float atEnter = computeFront(ray, enter, surface, rect);
    float atLeave = computeFront(ray, inside, surface, rect);
    return PatchCell(cell, rect, surface, enter, inside, atEnter, atLeave, leaveX <= leaveY,
                     leave < 1.0 ? false : true);
}

// The first pixel after the cell.
ivec2 computeExitPixel(PatchWalk walk, PatchCell cell, ivec2 pixel)
{
    vec2 start = walk.ray.startSS;
    vec2 delta = walk.ray.deltaSS;
    int overX = delta.x > 0.0 ? cell.rect.end.x : cell.rect.begin.x - 1;
    int overY = delta.y > 0.0 ? cell.rect.end.y : cell.rect.begin.y - 1;
    int x = cell.leavesByX ? overX : pixelAt(start.x, delta.x, pixel.x, cell.leave, true);
    int y = cell.leavesByX ? pixelAt(start.y, delta.y, pixel.y, cell.leave, false) : overY;
    return ivec2(x, y);
}

// Distance in metres by which the ray is behind a pixel's surface at its centre.
float computeGap(View view, PatchWalk walk, SurfaceCell surface, float s)
{
    return linearDepthFromAffine(view.orthographic, screenRayAffineDepth(walk.ray, s)) -
           linearDepthFromAffine(view.orthographic, surface.affineDepth);
}

// Clearance of a ray that is hidden from `hidden` to s, where `last` is the last pixel that hides it. 2 reads and
// kHiddenSamples.
float computeClearance(View view, PatchWalk walk, HiddenStart hidden, ivec2 last, float s)
{
    SurfaceCell first = fetchPixelSurface(hidden.pixel);
    SurfaceCell final = fetchPixelSurface(last);
    float gap = min(computeGap(view, walk, first, hidden.s), computeGap(view, walk, final, s));
    ivec2 lastPixel = ivec2(view.imageSize) - ivec2(1);
    for (int i = 0; i < kHiddenSamples; ++i) {
        float between = mix(hidden.s, s, (float(i) + 0.5) / float(kHiddenSamples));
        ivec2 pixel = clamp(ivec2(floor(screenRayPositionSS(walk.ray, between))), ivec2(0), lastPixel);
        SurfaceCell surface = fetchPixelSurface(pixel);
        if (!isSky(surface)) gap = min(gap, computeGap(view, walk, surface, between));
    }
    vec2 firstSS = screenRayPositionSS(walk.ray, hidden.s);
    vec2 finalSS = screenRayPositionSS(walk.ray, s);
    float firstDepth = linearDepthFromAffine(view.orthographic, first.affineDepth);
    float finalDepth = linearDepthFromAffine(view.orthographic, final.affineDepth);
    float depth = 0.5 * (firstDepth + finalDepth);
    vec3 chord = positionVSFromSS(view, finalSS, finalDepth) - positionVSFromSS(view, firstSS, firstDepth);
    vec3 across = positionVSFromSS(view, finalSS, depth) - positionVSFromSS(view, firstSS, depth);
    return safeDivide(max(gap, 0.0) * length(across), dot(chord, chord), 0.0);
}

// A pixel whose plane the ray comes in behind: does the surface before meet it within half a pixel of their border?
bool doesSurfaceGoOn(PatchWalk walk, PatchCell cell, ivec2 pixel, PixelEntry entry)
{
    if (pixel == walk.startPixel) return false;
    ivec2 pixelBefore = computePixelBefore(walk, pixel, entry.isByX);
    SurfaceCell before = fetchPixelSurface(pixelBefore);
    if (isSky(before)) return false;
    vec2 borderSS = screenRayPositionSS(walk.ray, entry.s);
    float rise = pixelAffineDepth(cell.surface, pixel, borderSS) - pixelAffineDepth(before, pixelBefore, borderSS);
    vec2 delta = walk.ray.deltaSS;
    float perPixel = 1.0 / max(max(abs(delta.x), abs(delta.y)), 1e-20);
    float bend = abs(dot(cell.surface.gradient - before.gradient, delta)) * perPixel;
    float nearing = (walk.ray.deltaAffineDepth - dot(cell.surface.gradient, delta)) * perPixel;
    // Both depths may be wrong, and both planes' slopes with them.
    float error = 2.0 * walk.depthError;
    return nearing < error && -cell.frontAtEnter <= error - nearing && rise <= error + 0.5 * bend;
}

PixelTest makePixelHit(PatchWalk walk, PatchCell cell, PatchState state, float clearance)
{
    // By the ray itself: it was lifted only to be compared.
    float atEnter = computeFront(walk.ray, cell.enter, cell.surface, cell.rect);
    float atLeave = computeFront(walk.ray, cell.leave, cell.surface, cell.rect);
    float share = atEnter > 0.0 ? saturate(safeDivide(atEnter, atEnter - atLeave, 0.0)) : 0.0;
    return PixelTest(true, false, mix(cell.enter, cell.leave, share), false, state.hidden, clearance);
}

PixelTest testPixel(View view, PatchWalk walk, PatchCell cell, PatchState state, float caution)
{
    bool noSurface = isSky(cell.surface);
    bool isBehind = !noSurface && cell.frontAtEnter < 0.0;
    bool goesBehind = !noSurface && cell.frontAtLeave < 0.0;
    if (walk.stands && state.pixel == walk.startPixel) {
        return PixelTest(false, false, 0.0, true, state.hidden, state.clearance);
    }

    PixelEntry entry = computePixelEntry(walk, state.pixel);
    float clearance = state.clearance;
    if (state.inFront && isBehind) {
        if (doesSurfaceGoOn(walk, cell, state.pixel, entry)) return makePixelHit(walk, cell, state, clearance);
        // Hidden, and already out again where it crosses the plane from behind: it was inside the object.
        HiddenStart hidden = HiddenStart(state.pixel, cell.enter);
        float now = goesBehind ? clearance : 0.0;
        return PixelTest(false, !goesBehind && caution > 0.0, 0.0, !goesBehind, hidden, now);
    }
    if (!state.inFront && isBehind) {
        float now = goesBehind ? clearance : 0.0;
        return PixelTest(false, !goesBehind && caution > 0.0, 0.0, !goesBehind, state.hidden, now);
    }
    if (!state.inFront) {
        ivec2 last = computePixelBefore(walk, state.pixel, entry.isByX);
        clearance = min(clearance, computeClearance(view, walk, state.hidden, last, cell.enter));
        if (clearance < caution) return PixelTest(false, true, 0.0, true, state.hidden, clearance);
    }
    if (goesBehind) return makePixelHit(walk, cell, state, clearance);
    return PixelTest(false, false, 0.0, true, state.hidden, clearance);
}

// How far the ray gets in a cell above level 0 before any pixel could decide anything; 1e30 when it passes the cell.
// Rounding is on the careful side.
float computeFreePath(PatchWalk walk, PatchCell cell, bool inFront)
{
    vec2 gradient = abs(cell.surface.gradient);
    float terms = abs(cell.surface.affineDepth) + abs(walk.lifted.startAffineDepth) +
                  abs(screenRayAffineDepth(walk.lifted, cell.leave)) + gradient.x * float(cell.rect.end.x) +
                  gradient.y * float(cell.rect.end.y);
    float margin = max(cell.surface.slack, 0.0) + kSurfaceRounding * terms;
    float atEnter = (inFront ? cell.frontAtEnter : -cell.frontAtEnter) - margin;
    float atLeave = (inFront ? cell.frontAtLeave : -cell.frontAtLeave) - margin;
    if (!(atEnter > 0.0)) return cell.enter;
    if (atLeave > 0.0) return kNever;
    return mix(cell.enter, cell.leave, saturate(safeDivide(atEnter, atEnter - atLeave, 0.0)));
}

// The level at which what is left to be found out is about a cell long.
int chooseFinerLevel(PatchWalk walk, PatchCell cell, int level)
{
    vec2 delta = abs(walk.ray.deltaSS);
    float perPixel =
        abs(cell.frontAtLeave - cell.frontAtEnter) / max((cell.leave - cell.enter) * max(delta.x, delta.y), 1e-20);
    float pixels = safeDivide(2.0 * max(cell.surface.slack, 0.0), perPixel, 1e9);
    return clamp(int(ceil(log2(clamp(pixels, 1.0, 1e9)))), 0, level - 1);
}

// Up to two levels coarser, as the border allows over which the ray goes.
int chooseCoarserLevel(PatchCell cell, ivec2 next, vec2 deltaSS, int level, int maxLevel)
{
    int border = cell.leavesByX ? entryBorder(next.x, deltaSS.x) : entryBorder(next.y, deltaSS.y);
    int wanted = level;
    for (int i = 0; i < 2; ++i) {
        bool isOdd = ((border >> wanted) & 1) != 0;
        if (!isOdd) wanted = wanted + 1;
    }
    return min(wanted, maxLevel);
}

// To the pixel that the ray reaches undecided, at a finer level. A ray that is undecided at once stays where it is: it
// may be in a corner of its pixel, with the next border at the same s.
PatchState descendPatch(PatchWalk walk, PatchCell cell, PatchState state, float freePath)
{
    vec2 start = walk.ray.startSS;
    vec2 delta = walk.ray.deltaSS;
    ivec2 pixel = state.pixel;
    if (freePath > cell.enter) {
        pixel = ivec2(pixelAt(start.x, delta.x, state.pixel.x, freePath, true),
                      pixelAt(start.y, delta.y, state.pixel.y, freePath, true));
        pixel = clamp(pixel, cell.rect.begin, cell.rect.end - ivec2(1));
    }
    return PatchState(pixel, chooseFinerLevel(walk, cell, state.level), state.inFront, state.hidden, state.clearance);
}

// Share of hits that are right, measured (docs/tracer.md): two straight lines over the logarithm of the clearance.
float computeConfidence(float clearance)
{
    if (clearance > 0.5 * kNoClearance) return 0.998;
    float logarithm = log(choose(clearance > 1e-4, clearance, 1e-4));
    float logit = min(2.2 + 1.3 * logarithm, 3.25 + 2.5 * logarithm);
    return min(1.0 / (1.0 + exp(-logit)), 0.995);
}

PatchStep makePatchStep(View view, PatchWalk walk, PatchCell cell, int level, int kind, int iteration)
{
    float ray = screenRayAffineDepth(walk.ray, cell.enter);
    float plane = screenRayAffineDepth(walk.lifted, cell.enter) - cell.frontAtEnter;
    float slack = max(cell.surface.slack, 0.0);
    return PatchStep(iteration, level, cell.cell, cell.rect, screenRayPositionSS(walk.ray, cell.enter),
                     linearDepthFromAffine(view.orthographic, ray),
                     linearDepthFromAffine(view.orthographic, plane + slack),
                     linearDepthFromAffine(view.orthographic, plane - slack), kind);
}

PatchTraceResult makePatchEnd(View view, ScreenRay ray, float s, int reason, PatchTraceResult counts)
{
    int hitClass = reason == kHitReasonSky ? kHitClassMiss : kHitClassUnknown;
    if (reason == kHitReasonDegenerateRay) hitClass = kHitClassNoRaycast;
    float depth = linearDepthFromAffine(view.orthographic, screenRayAffineDepth(ray, s));
    return PatchTraceResult(hitClass, reason, screenRayPositionSS(ray, s), ray.status == kHitReasonNone ? depth : 0.0,
                            counts.iterations, counts.maxUsedLevel, counts.intersectionKind, 0.0);
}

PatchTraceResult makePatchHit(View view, PatchWalk walk, PatchCell cell, PixelTest test, PatchTraceResult counts)
{
    vec2 hitSS = positionInRect(walk.ray, test.s, cell.rect);
    float plane = surfaceAffineDepth(cell.surface, computeRectCenter(cell.rect), hitSS);
    return PatchTraceResult(kHitClassHit, kHitReasonNone, hitSS, linearDepthFromAffine(view.orthographic, plane),
                            counts.iterations, counts.maxUsedLevel, kIntersectionDepth,
                            computeConfidence(test.clearance));
}

// Traces from originWS along dirWS (any length). Positions and depths are finite whatever the input. Off screen, out of
// iterations, through the near plane, or hidden at the end: unknown, with the reason; through the far plane in sight: a
// miss, kHitReasonSky.
PatchTraceResult tracePatches(View view, vec3 originWS, vec3 dirWS, PatchTracerSettings settings)
{
    ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    PatchTraceResult counts = PatchTraceResult(0, 0, vec2(0.0), 0.0, 0, 0, kIntersectionNone, 0.0);
    if (ray.status != kHitReasonNone) return makePatchEnd(view, ray, 0.0, ray.status, counts);
    if (!isOnScreen(view, ray.startSS)) return makePatchEnd(view, ray, 0.0, kHitReasonOffScreen, counts);

    int maxLevel = clamp(settings.maxLevel, 0, max(surfacePyramidLevelCount(), 1) - 1);
    float caution = settings.caution > 0.0 ? settings.caution : 0.0;
    ivec2 lastPixel = ivec2(view.imageSize) - ivec2(1);
    ivec2 startPixel = min(ivec2(floor(ray.startSS)), lastPixel);
    PatchWalk walk = makePatchWalk(ray, startPixel, settings.depthError > 0.0 ? settings.depthError : 0.0);
    HiddenStart noStart = HiddenStart(startPixel, 0.0);
    PatchState state = PatchState(startPixel, min(kPatchStartLevel, maxLevel), true, noStart, kNoClearance);
    int limit = min(settings.maxIterations, kMostMarchSteps);
    for (int i = 0; i < limit; ++i) {
        PatchCell cell = enterPatchCell(view, walk, state);
        counts.iterations = i + 1;
        counts.maxUsedLevel = max(counts.maxUsedLevel, state.level);
        float freePath = state.level > 0 ? computeFreePath(walk, cell, state.inFront) : kNever;
        counts.intersectionKind = state.level > 0 && freePath >= kNever ? kIntersectionNone : kIntersectionCell;
        PixelTest test = PixelTest(false, false, 0.0, state.inFront, state.hidden, state.clearance);
        if (state.level == 0) test = testPixel(view, walk, cell, state, caution);
        if (test.isHit) counts.intersectionKind = kIntersectionDepth;
        recordPatchStep(makePatchStep(view, walk, cell, state.level, counts.intersectionKind, i));
        if (test.isHit) return makePatchHit(view, walk, cell, test, counts);
        if (test.isRefused) return makePatchEnd(view, ray, cell.enter, kHitReasonBehindSurface, counts);
        state.inFront = test.inFront;
        state.hidden = test.hidden;
        state.clearance = test.clearance;
        if (freePath < kNever) {
            state = descendPatch(walk, cell, state, freePath);
        } else {
            ivec2 next = computeExitPixel(walk, cell, state.pixel);
            bool isInside = next.x >= 0 && next.y >= 0 && next.x <= lastPixel.x && next.y <= lastPixel.y;
            if (cell.isLast || !isInside) {
                int reason = cell.isLast ? ray.endReason : kHitReasonOffScreen;
                return makePatchEnd(view, ray, cell.leave, state.inFront ? reason : kHitReasonBehindSurface, counts);
            }
            state.level = chooseCoarserLevel(cell, next, ray.deltaSS, state.level, maxLevel);
            state.pixel = next;
        }
    }
    return makePatchEnd(view, ray, computePixelEntry(walk, state.pixel).s, kHitReasonIterationCap, counts);
}

#endif
