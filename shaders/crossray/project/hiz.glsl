// Screen-space ray tracing by a depth pyramid ("HiZ"): skip what the ray cannot meet in large cells, look closer where
// it may.
// Hooks: those of project/depth_patch.glsl, and
//        int depthPyramidLevelCount()      levels of the pyramid, at least 1
//        void recordHizStep(HizStep step)  called once an iteration; a release build leaves it empty
// Source: Uludag 2014, "Hi-Z Screen-Space Cone-Traced Reflections", with the parameters of Unity HDRP 2018 (minimum and
// maximum level, iterations, depth success bias). Own: cells in whole numbers, the farthest depth that lets rays pass
// behind in large steps too, and the plane of each cell instead of a constant depth (project/depth_patch.glsl).
//
// When a ray hits. At the minimum level the surface of a cell is a plane. The ray hits it where it runs from its front
// to its back inside the cell. A ray that was in front and comes into the cell behind its plane, on its way deeper,
// hits it too: where it crossed the plane at most one cell earlier (the surface goes on), or else where it is at most
// `depthBias` metres behind the plane, for so thick is what the depth buffer shows. Farther behind it passes, and hits
// nothing until it has come out again; a ray that starts behind what is seen (a refracted one) likewise. A ray that
// nears the plane from behind would meet its back, and passes. A ray never hits the plane on which it starts.
//
// What the end means. Out of iterations: unknown, kHitReasonIterationCap. Over the image's border or through the near
// plane: unknown, kHitReasonOffScreen or kHitReasonNearPlane, and kHitReasonBehindSurface where a surface hides the ray
// just then. Through the far plane (or 65504 m): a miss, kHitReasonSky; but where anything hid the ray on its way,
// unknown, kHitReasonBehindSurface. A start off screen or behind the eye is unknown, a ray without direction
// kHitClassNoRaycast.
//
// Minimum levels above 0 test whole cells: hits are as exact as a cell's plane fits, and the start's cell is never hit.
#ifndef CROSSRAY_PROJECT_HIZ_GLSL
#define CROSSRAY_PROJECT_HIZ_GLSL

#include "crossray/project/depth_patch.glsl"

struct HizSettings {
    int minLevel;      // taken into [0, levels - 1]
    int maxLevel;      // taken into [minLevel, levels - 1]
    int maxIterations; // below 1: no step, kHitReasonIterationCap
    float depthBias;   // metres that a surface is thick; negative and NaN count as 0
};

// One iteration, as it is recorded.
struct HizStep {
    int iteration; // from 0
    int level;
    ivec2 cell;
    ivec2 cellSizeSS;          // pixels
    vec2 positionSS;           // where the ray is when the step begins
    float rayLinearDepth;      // there
    float nearestLinearDepth;  // of the cell
    float farthestLinearDepth; // of the cell
    float thickLinearDepth;    // nearest + depthBias
    int intersectionKind;      // kIntersection...
};

struct TraceResult {
    int hitClass;      // kHitClass...
    int reason;        // kHitReason...
    vec2 positionSS;   // of the hit; without one, where the march ended
    float linearDepth; // there, metres
    int iterations;
    int maxUsedLevel;
    int intersectionKind; // of the last step
};

int depthPyramidLevelCount();
void recordHizStep(HizStep step);

// Ray and surface within this share of their depth are one at the start: what moving a position to world space and back
// costs.
const float kHizStartTolerance = 0.000244140625; // 2^-12

struct HizState {
    float s;     // place on the ray
    ivec2 pixel; // the pixel in which it is, kept in whole numbers
    int level;
    bool inFront;   // of what its last cell shows
    bool attached;  // still on the surface on which it started, to rounding
    bool wasHidden; // something hid it on its way
    bool isStart;   // in the cell in which it starts
};

// The cell under the ray and the part of the ray in it.
struct HizCell {
    ivec2 cell;
    ivec2 begin; // pixels [begin, end)
    ivec2 end;
    vec2 depths; // nearest, farthest
    float leave; // s where the ray leaves it, at most 1
    bool leavesByX;
    bool isLast;      // the ray ends in it
    float rayNearest; // metres, of the part inside
    float rayFarthest;
};

// What a cell says about the ray.
struct HizTest {
    int kind;          // kIntersectionNone: skipped; kIntersectionCell: tested and passed, or to be looked at closer
    float s;           // kIntersectionDepth: of the hit
    float linearDepth; // of the hit, metres
    bool inFront;      // when the ray leaves the cell
    bool attached;
    bool isHidden;
};

HizSettings sanitizeHizSettings(HizSettings settings)
{
    int last = max(depthPyramidLevelCount(), 1) - 1;
    int minLevel = clamp(settings.minLevel, 0, last);
    float bias = settings.depthBias > 0.0 ? min(settings.depthBias, 1e30) : 0.0;
    return HizSettings(minLevel, clamp(settings.maxLevel, minLevel, last), max(settings.maxIterations, 0), bias);
}

HizCell enterHizCell(View view, ScreenRay ray, HizState state)
{
    ivec2 cells = depthPyramidSize(state.level);
    ivec2 cell = computeDepthPyramidCell(state.pixel, state.level, cells);
    CellSpan x = computeCellSpan(cell.x, state.level, cells.x, int(view.imageSize.x));
    CellSpan y = computeCellSpan(cell.y, state.level, cells.y, int(view.imageSize.y));
    vec2 delta = vec2(awayFromZero(ray.deltaSS.x, 1e-20), awayFromZero(ray.deltaSS.y, 1e-20));
    float leaveX = (float(delta.x > 0.0 ? x.end : x.begin) - ray.startSS.x) / delta.x;
    float leaveY = (float(delta.y > 0.0 ? y.end : y.begin) - ray.startSS.y) / delta.y;
    float leave = max(min(leaveX, leaveY), state.s);
    bool isLast = leave < 1.0 ? false : true;
    leave = min(leave, 1.0);
    float enterDepth = linearDepthFromAffine(view, screenRayAffineDepth(ray, state.s));
    float leaveDepth = linearDepthFromAffine(view, screenRayAffineDepth(ray, leave));
    return HizCell(cell, ivec2(x.begin, y.begin), ivec2(x.end, y.end), fetchDepthPyramid(cell, state.level), leave,
                   leaveX <= leaveY, isLast, min(enterDepth, leaveDepth), max(enterDepth, leaveDepth));
}

// The pixel in which the ray is at s, inside the cell and never before the pixel in which it was: rounding cannot turn
// it back.
ivec2 computeHizPixel(ScreenRay ray, HizCell cell, ivec2 before, float s)
{
    vec2 positionSS = clamp(screenRayPositionSS(ray, s), vec2(cell.begin), vec2(cell.end));
    ivec2 pixel = clamp(ivec2(floor(positionSS)), cell.begin, cell.end - ivec2(1));
    return ivec2(ray.deltaSS.x < 0.0 ? min(pixel.x, before.x) : max(pixel.x, before.x),
                 ray.deltaSS.y < 0.0 ? min(pixel.y, before.y) : max(pixel.y, before.y));
}

// The first pixel of the next cell: exactly over the border by which the ray leaves.
ivec2 computeHizExitPixel(ScreenRay ray, HizCell cell, ivec2 before)
{
    ivec2 pixel = computeHizPixel(ray, cell, before, cell.leave);
    int overX = ray.deltaSS.x < 0.0 ? cell.begin.x - 1 : cell.end.x;
    int overY = ray.deltaSS.y < 0.0 ? cell.begin.y - 1 : cell.end.y;
    return cell.leavesByX ? ivec2(overX, pixel.y) : ivec2(pixel.x, overY);
}

// The ray in the cell where it starts: it cannot hit the plane on which it stands. enter and leave: by how much affine
// depth it is in front of the plane.
HizTest testHizStart(View view, ScreenRay ray, HizState state, HizCell cell, DepthPatch plane, float enter, float leave)
{
    float tolerance = kHizStartTolerance * abs(plane.affineDepth);
    bool stands = abs(enter) <= tolerance;
    bool crosses = enter > tolerance && leave < -tolerance && state.level == 0;
    float s = mix(state.s, cell.leave, saturate(safeDivide(enter, enter - leave, 0.0)));
    float depth = linearDepthFromAffine(view, patchAffineDepth(plane, screenRayPositionSS(ray, s)));
    bool inFront = leave >= (stands ? -tolerance : 0.0);
    return HizTest(crosses ? kIntersectionDepth : kIntersectionCell, s, depth, inFront, stands && leave <= tolerance,
                   false);
}

// The ray against the plane of a cell at the minimum level.
HizTest testHizPlane(View view, ScreenRay ray, HizState state, HizCell cell, float depthBias)
{
    DepthPatch plane = fitDepthPatch(view, cell.cell, state.level, cell.depths.x);
    float rayAffine = screenRayAffineDepth(ray, state.s);
    float planeAffine = patchAffineDepth(plane, screenRayPositionSS(ray, state.s));
    float enter = rayAffine - planeAffine;
    float rate = ray.deltaAffineDepth - dot(plane.gradient, ray.deltaSS); // of the same along the ray
    float leave = enter + rate * (cell.leave - state.s);
    if (state.isStart) return testHizStart(view, ray, state, cell, plane, enter, leave);

    float tolerance = kHizStartTolerance * abs(plane.affineDepth);
    float noise = state.attached ? tolerance : 0.0;
    bool isBehind = enter < -noise;
    bool goesBehind = leave < -noise;
    if (!isBehind && !goesBehind) {
        return HizTest(kIntersectionCell, 0.0, 0.0, true, state.attached && leave <= tolerance, false);
    }

    // Where the ray crosses the plane: in this cell, or at most a cell's length before.
    float cellPixels = float(max(cell.end.x - cell.begin.x, cell.end.y - cell.begin.y));
    float cellLength = cellPixels / max(max(abs(ray.deltaSS.x), abs(ray.deltaSS.y)), 1e-20);
    float crossing = state.s - safeDivide(enter, rate, 0.0);
    bool goesOn = rate < 0.0 && state.s - crossing <= cellLength;
    if (!isBehind || (state.inFront && goesOn)) {
        float s = clamp(crossing, isBehind ? 0.0 : state.s, cell.leave);
        float depth = linearDepthFromAffine(view, patchAffineDepth(plane, screenRayPositionSS(ray, s)));
        return HizTest(kIntersectionDepth, s, depth, false, false, false);
    }
    float rayDepth = linearDepthFromAffine(view, rayAffine);
    bool isThick = rate < 0.0 && rayDepth - linearDepthFromAffine(view, planeAffine) <= depthBias;
    if (state.inFront && isThick) return HizTest(kIntersectionDepth, state.s, rayDepth, false, false, false);
    return HizTest(kIntersectionCell, 0.0, 0.0, leave >= 0.0, false, true);
}

HizTest testHizCell(View view, ScreenRay ray, HizState state, HizCell cell, HizSettings settings)
{
    bool isSky = isSkyDepth(cell.depths.x);
    if (isSky || cell.rayFarthest < cell.depths.x) {
        bool isWellClear = isSky || cell.rayFarthest * (1.0 + kHizStartTolerance) < cell.depths.x;
        return HizTest(kIntersectionNone, 0.0, 0.0, true, state.attached && !isWellClear, false);
    }
    if (!state.inFront && cell.rayNearest > cell.depths.y + settings.depthBias) {
        return HizTest(kIntersectionNone, 0.0, 0.0, false, false, !state.isStart);
    }
    if (state.level == settings.minLevel) return testHizPlane(view, ray, state, cell, settings.depthBias);
    return HizTest(kIntersectionCell, 0.0, 0.0, state.inFront, state.attached, false);
}

// One level finer, from where the ray first is as deep as the cell's nearest surface.
HizState descendHiz(View view, ScreenRay ray, HizState state, HizCell cell)
{
    float nearestAffine = affineDepthFromLinear(view, cell.depths.x);
    float toNearest = safeDivide(nearestAffine - ray.startAffineDepth, ray.deltaAffineDepth, 0.0);
    bool comesFromFront = state.inFront && ray.deltaAffineDepth < 0.0;
    float s = comesFromFront ? clamp(toNearest, state.s, cell.leave) : state.s;
    ivec2 pixel = computeHizPixel(ray, cell, state.pixel, s);
    return HizState(s, pixel, state.level - 1, state.inFront, state.attached, state.wasHidden, state.isStart);
}

// Into the next cell; one level coarser after a skip.
HizState advanceHiz(ScreenRay ray, HizState state, HizCell cell, HizTest test, int maxLevel)
{
    int level = test.kind == kIntersectionNone ? min(state.level + 1, maxLevel) : state.level;
    return HizState(cell.leave, computeHizExitPixel(ray, cell, state.pixel), level, test.inFront, test.attached,
                    state.wasHidden || test.isHidden, false);
}

HizStep makeHizStep(View view, ScreenRay ray, HizState state, HizCell cell, int kind, int iteration, float depthBias)
{
    float rayDepth = linearDepthFromAffine(view, screenRayAffineDepth(ray, state.s));
    return HizStep(iteration, state.level, cell.cell, cell.end - cell.begin, screenRayPositionSS(ray, state.s),
                   rayDepth, cell.depths.x, cell.depths.y, cell.depths.x + depthBias, kind);
}

TraceResult makeHizEnd(View view, ScreenRay ray, HizState state, int reason, int iterations, int maxUsedLevel, int kind)
{
    int hitClass = kHitClassUnknown;
    int why = reason;
    if (reason == kHitReasonDegenerateRay) hitClass = kHitClassNoRaycast;
    if (reason == kHitReasonSky) {
        bool sawAll = state.inFront && !state.wasHidden;
        hitClass = sawAll ? kHitClassMiss : kHitClassUnknown;
        why = sawAll ? reason : kHitReasonBehindSurface;
    }
    bool leaves = reason == kHitReasonOffScreen || reason == kHitReasonNearPlane;
    if (leaves && !state.inFront) why = kHitReasonBehindSurface;
    float linearDepth = linearDepthFromAffine(view, screenRayAffineDepth(ray, state.s));
    if (ray.status != kHitReasonNone) linearDepth = 0.0;
    return TraceResult(hitClass, why, screenRayPositionSS(ray, state.s), linearDepth, iterations, maxUsedLevel, kind);
}

// Traces from originWS along dirWS (any length). Positions and depths are finite whatever the input.
TraceResult traceHiz(View view, vec3 originWS, vec3 dirWS, HizSettings userSettings)
{
    HizSettings settings = sanitizeHizSettings(userSettings);
    ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    ivec2 lastPixel = ivec2(view.imageSize) - ivec2(1);
    bool starts = ray.status == kHitReasonNone && isOnScreen(view, ray.startSS);
    ivec2 startPixel = starts ? min(ivec2(floor(ray.startSS)), lastPixel) : ivec2(0);
    HizState state = HizState(0.0, startPixel, settings.minLevel, true, true, false, true);
    if (!starts) {
        int reason = ray.status == kHitReasonNone ? kHitReasonOffScreen : ray.status;
        return makeHizEnd(view, ray, state, reason, 0, 0, kIntersectionNone);
    }

    int maxUsedLevel = state.level;
    int kind = kIntersectionNone;
    for (int i = 0; i < settings.maxIterations; ++i) {
        HizCell cell = enterHizCell(view, ray, state);
        HizTest test = testHizCell(view, ray, state, cell, settings);
        maxUsedLevel = max(maxUsedLevel, state.level);
        kind = test.kind;
        recordHizStep(makeHizStep(view, ray, state, cell, kind, i, settings.depthBias));
        if (kind == kIntersectionDepth) {
            vec2 hitSS = screenRayPositionSS(ray, test.s);
            return TraceResult(kHitClassHit, kHitReasonNone, hitSS, test.linearDepth, i + 1, maxUsedLevel, kind);
        }
        if (kind == kIntersectionCell && state.level > settings.minLevel) {
            state = descendHiz(view, ray, state, cell);
        } else {
            state = advanceHiz(ray, state, cell, test, settings.maxLevel);
            if (cell.isLast) return makeHizEnd(view, ray, state, ray.endReason, i + 1, maxUsedLevel, kind);
            bool isInside = state.pixel.x >= 0 && state.pixel.y >= 0 && state.pixel.x <= lastPixel.x &&
                            state.pixel.y <= lastPixel.y;
            if (!isInside) return makeHizEnd(view, ray, state, kHitReasonOffScreen, i + 1, maxUsedLevel, kind);
        }
    }
    return makeHizEnd(view, ray, state, kHitReasonIterationCap, settings.maxIterations, maxUsedLevel, kind);
}

#endif
