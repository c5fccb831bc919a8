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
// The maximum level changes the cost alone: pixels are visited in one order, the cells of the minimum level decide by
// the same expressions, and a coarser cell is skipped only where none of them would do anything else.
//
// Minimum levels above 0 test whole cells: hits are as exact as a cell's plane fits, and the start's cell is never hit.
#ifndef CROSSRAY_PROJECT_HIZ_GLSL
#define CROSSRAY_PROJECT_HIZ_GLSL

#include "crossray/project/depth_patch.glsl"
#include "crossray/project/march_end.glsl"

struct HizSettings {
    int minLevel;      // taken into [0, levels - 1]
    int maxLevel;      // taken into [minLevel, levels - 1]
    int maxIterations; // below 1: no step, kHitReasonIterationCap; above kMostMarchSteps: that
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
// Share of that by which a ray may sink into the plane of its start, within its cell or a pixel, by rounding alone: it
// has a direction, and no gap, to lose.
const float kHizSinkTolerance = 0.015625; // 2^-6
const int kHizRuns = -1;                  // in place of a reason, while the march goes on

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
    vec2 depths;      // nearest, farthest
    float enter;      // s from which the cell is judged
    float leave;      // s where the ray leaves it, at most 1
    ivec2 leavePixel; // the first pixel after it
    bool leavesImage;
    bool isLast;      // the ray ends in it
    float rayNearest; // metres, of the part inside
    float rayFarthest;
};

// What a cell says about the ray.
struct HizTest {
    int kind;          // kIntersectionNone: skipped; kIntersectionCell: tested and passed, or to be looked at closer
    float s;           // of the hit, or from where to look closer
    float affineDepth; // of the hit
    bool inFront;      // when the ray leaves the cell
    bool attached;
    bool isHidden;
};

HizSettings sanitizeHizSettings(HizSettings settings)
{
    int last = max(depthPyramidLevelCount(), 1) - 1;
    int minLevel = clamp(settings.minLevel, 0, last);
    float bias = choose(settings.depthBias > 0.0, min(settings.depthBias, 1e30), 0.0);
    return HizSettings(minLevel, clamp(settings.maxLevel, minLevel, last),
                       clamp(settings.maxIterations, 0, kMostMarchSteps), bias);
}

// Where a ray comes into a cell, or starts.
float computeHizEntry(ScreenRay ray, ivec2 begin, ivec2 end)
{
    float byX = borderTime(ray.startSS.x, ray.deltaSS.x, choose(ray.deltaSS.x > 0.0, begin.x, end.x));
    float byY = borderTime(ray.startSS.y, ray.deltaSS.y, choose(ray.deltaSS.y > 0.0, begin.y, end.y));
    return clamp(max(byX, byY), 0.0, 1.0);
}

HizCell enterHizCell(ScreenFrame frame, ScreenRay ray, HizState state, bool isFinest)
{
    ivec2 cells = depthPyramidSize(state.level);
    ivec2 cell = computeDepthPyramidCell(state.pixel, state.level, cells);
    CellSpan x = computeCellSpan(cell.x, state.level, cells.x, frame.imageSize.x);
    CellSpan y = computeCellSpan(cell.y, state.level, cells.y, frame.imageSize.y);
    ivec2 begin = ivec2(x.begin, y.begin);
    ivec2 end = ivec2(x.end, y.end);
    vec2 start = ray.startSS;
    vec2 delta = ray.deltaSS;
    bool runsLeft = delta.x < 0.0;
    bool runsUp = delta.y < 0.0;
    float leaveX = borderTime(start.x, delta.x, choose(runsLeft, begin.x, end.x));
    float leaveY = borderTime(start.y, delta.y, choose(runsUp, begin.y, end.y));
    // At the minimum level the whole way through the cell counts, wherever the march came down to it.
    float enter = choose(isFinest, computeHizEntry(ray, begin, end), state.s);
    float leave = max(min(leaveX, leaveY), enter);
    bool goesOn = leave < 1.0;
    leave = min(leave, 1.0);

    // Exactly over the border by which the ray leaves, in x first where it leaves by both.
    bool leavesByX = leaveX <= leaveY;
    int nextX =
        choose(leavesByX, choose(runsLeft, begin.x - 1, end.x), pixelAt(start.x, delta.x, state.pixel.x, leave, true));
    int nextY =
        choose(leavesByX, pixelAt(start.y, delta.y, state.pixel.y, leave, false), choose(runsUp, begin.y - 1, end.y));
    ivec2 leavePixel = ivec2(nextX, nextY);
    bool staysInside = all(equal(leavePixel, clamp(leavePixel, ivec2(0), frame.imageSize - ivec2(1))));
    float enterDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, enter));
    float leaveDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, leave));
    return HizCell(cell, begin, end, fetchDepthPyramid(cell, state.level), enter, leave, leavePixel,
                   goesOn && !staysInside, !goesOn, min(enterDepth, leaveDepth), max(enterDepth, leaveDepth));
}

// The ray against the plane of a cell at the minimum level.
HizTest testHizPlane(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, float depthBias)
{
    // A ray that starts on an edge is in front of the side that falls away from it.
    vec2 favourSS = choose(state.isStart, ray.deltaSS, vec2(0.0));
    DepthPatch plane = fitDepthPatch(frame, cell.cell, state.level, cell.depths.x, favourSS);
    float rayAffine = screenRayAffineDepth(ray, cell.enter);
    float planeAffine = patchAffineDepth(plane, screenRayPositionSS(ray, cell.enter));
    float planeRate = dot(plane.gradient, ray.deltaSS);
    float rate = ray.deltaAffineDepth - planeRate;
    float enter = rayAffine - planeAffine; // above 0: in front
    float leave = enter + rate * (cell.leave - cell.enter);

    float tolerance = kHizStartTolerance * abs(plane.affineDepth);
    float noise = choose(state.attached, tolerance, 0.0);
    bool isBehind = enter < -noise;
    bool goesBehind = leave < -noise;
    bool sinks = rate < 0.0;
    bool crosses = goesBehind && !isBehind;

    // Came in behind: did it cross the plane at most a cell's length before, or is it in what the depth bias makes
    // solid?
    int cellPixels = max(cell.end.x - cell.begin.x, cell.end.y - cell.begin.y);
    float crossing = cell.enter - safeDivide(enter, rate, 0.0);
    bool isRecent = cell.enter - crossing <= float(cellPixels) * ray.pixelLength;
    bool crossed = sinks && isRecent;
    float behind =
        linearDepthFromAffine(frame.orthographic, rayAffine) - linearDepthFromAffine(frame.orthographic, planeAffine);
    bool isThick = behind <= depthBias;
    bool isSolid = sinks && isThick;
    bool cameIn = isBehind && state.inFront;
    bool metBefore = crossed || isSolid;
    bool meets = cameIn && metBefore;

    // In the cell of its start: it cannot hit the plane on which it stands.
    bool isOffPlane = enter > tolerance;
    bool floats = isOffPlane && state.level == 0;
    bool hitsFromStart = crosses && floats;
    bool hitsElsewhere = crosses || meets;
    bool hit = state.isStart ? hitsFromStart : hitsElsewhere;

    bool isCrossing = crosses || crossed;
    float sCrossing = clamp(crossing, choose(isBehind, 0.0, cell.enter), cell.leave);
    float sHit = choose(isCrossing, sCrossing, cell.enter);
    float hitAffine = choose(isCrossing, planeAffine + planeRate * (sCrossing - cell.enter), rayAffine);
    // A ray that sinks into the plane on which it stands is behind it at once, be the gap as small as it may.
    // Judged over a pixel at least: a ray may start at its cell's border. One that starts well in front only comes nearer.
    bool sinksAtStart = rate * max(cell.leave - cell.enter, ray.pixelLength) < -kHizSinkTolerance * tolerance;
    bool isInFront = leave >= -choose(isBehind, 0.0, noise);
    bool inFront = isInFront && !(state.isStart && sinksAtStart && !isOffPlane);
    bool isClose = leave <= tolerance && inFront;
    bool stands = !(state.isStart && isOffPlane);
    bool keepsClose = isClose && stands;
    return HizTest(choose(hit, kIntersectionDepth, kIntersectionCell), sHit, hitAffine, inFront,
                   state.attached && keepsClose, isBehind && !state.isStart);
}

HizTest testHizCell(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, HizSettings settings)
{
    bool isSky = isSkyDepth(cell.depths.x);
    // Cells show the depth of their pixels' centres: a ray just behind a sloping surface may pass nearer than that, and
    // only the plane tells that it has come out, or where it starts. On the surface of the start a nearer ray may be a
    // rounding.
    float margin = choose(state.attached, 1.0 + kHizStartTolerance, 1.0);
    bool isNearer = cell.rayFarthest * margin < cell.depths.x;
    bool isTrusted = state.inFront && !state.isStart;
    bool isNearerInFront = isNearer && isTrusted;
    bool isClear = isSky || isNearerInFront;
    bool isDeeper = cell.rayNearest > cell.depths.y + settings.depthBias;
    bool isPassed = isDeeper && !(state.inFront || isSky);
    // Before it leaves the image the ray is tested against the last pixel's plane: after it comes no cell that would
    // see that the ray has crossed it in the pixel's corner.
    bool leavesUnseen = cell.leavesImage && !isSky;
    bool isSkipped = isPassed || (isClear && !leavesUnseen);
    bool isFinest = state.level == settings.minLevel;

    // Looked at closer: from where the ray first is as deep as the cell's nearest surface.
    float nearestAffine = affineDepthFromLinear(frame.orthographic, cell.depths.x);
    float toNearest = safeDivide(nearestAffine - ray.startAffineDepth, ray.deltaAffineDepth, 0.0);
    bool comesFromFront = state.inFront && ray.deltaAffineDepth < 0.0;
    float closer = choose(comesFromFront, clamp(toNearest, state.s, cell.leave), state.s);
    closer = choose(isClear, cell.leave, closer);

    bool isHidden = isPassed && !state.isStart;
    bool inFront = isClear || (state.inFront && !isSkipped);
    bool keepsAttached = state.attached && !isSkipped;
    HizTest test =
        HizTest(choose(isSkipped, kIntersectionNone, kIntersectionCell), closer, 0.0, inFront, keepsAttached, isHidden);
    bool isTested = isFinest && !isSkipped;
    if (isTested) test = testHizPlane(frame, ray, state, cell, settings.depthBias);
    return test;
}

// The pixel from which a cell is looked at closer: the one in which the ray is just before s. All pixels before it must
// be clear by themselves, which rounding may deny; then the march stays where it is.
ivec2 computeHizCloserPixel(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, float s)
{
    ivec2 pixel = ivec2(pixelAt(ray.startSS.x, ray.deltaSS.x, state.pixel.x, s, false),
                        pixelAt(ray.startSS.y, ray.deltaSS.y, state.pixel.y, s, false));
    float entry = computeHizEntry(ray, pixel, pixel + ivec2(1));
    float depth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, entry));
    float margin = choose(state.attached, 1.0 + kHizStartTolerance, 1.0);
    return choose(depth * margin < cell.depths.x, pixel, state.pixel);
}

// Down a level where the cell needs a closer look; else into the next cell, and up a level after a skip.
HizState stepHiz(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, HizTest test, HizSettings settings)
{
    bool isSkipped = test.kind == kIntersectionNone;
    bool isFinest = state.level == settings.minLevel;
    bool descends = !(isSkipped || isFinest);
    ivec2 closerPixel = computeHizCloserPixel(frame, ray, state, cell, test.s);
    int levelAfter = choose(isSkipped, min(state.level + 1, settings.maxLevel), state.level);
    bool isHidden = test.isHidden && !descends;
    return HizState(choose(descends, test.s, cell.leave), choose(descends, closerPixel, cell.leavePixel),
                    choose(descends, state.level - 1, levelAfter), test.inFront, test.attached,
                    state.wasHidden || isHidden, state.isStart && descends);
}

HizStep makeHizStep(ScreenFrame frame, ScreenRay ray, HizState state, HizCell cell, int kind, int iteration,
                    float depthBias)
{
    float rayDepth = linearDepthFromAffine(frame.orthographic, screenRayAffineDepth(ray, state.s));
    return HizStep(iteration, state.level, cell.cell, cell.end - cell.begin, screenRayPositionSS(ray, state.s),
                   rayDepth, cell.depths.x, cell.depths.y, cell.depths.x + depthBias, kind);
}

// Traces from originWS along dirWS (any length). Positions and depths are finite whatever the input; a
// ray that could not start ends at its start.
TraceResult traceHiz(View view, vec3 originWS, vec3 dirWS, HizSettings userSettings)
{
    HizSettings settings = sanitizeHizSettings(userSettings);
    ScreenFrame frame = makeScreenFrame(view);
    ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    bool isOnImage = isOnScreen(view, ray.startSS);
    bool isRay = ray.status == kHitReasonNone;
    bool starts = isRay && isOnImage;
    ivec2 startPixel = min(ivec2(floor(choose(starts, ray.startSS, vec2(0.0)))), frame.imageSize - ivec2(1));
    HizState state = HizState(0.0, startPixel, settings.minLevel, true, true, false, true);
    int limit = choose(starts, settings.maxIterations, 0);
    int end = choose(isRay, kHitReasonOffScreen, ray.status);
    end = choose(starts, kHizRuns, end);

    int iterations = 0;
    int maxUsedLevel = choose(starts, settings.minLevel, 0);
    int kind = kIntersectionNone;
    float endS = 0.0;
    float endAffine = ray.startAffineDepth;
    for (int i = 0; i < limit; ++i) {
        HizCell cell = enterHizCell(frame, ray, state, state.level == settings.minLevel);
        HizTest test = testHizCell(frame, ray, state, cell, settings);
        recordHizStep(makeHizStep(frame, ray, state, cell, test.kind, i, settings.depthBias));
        bool descends = test.kind == kIntersectionCell && state.level > settings.minLevel;
        maxUsedLevel = max(maxUsedLevel, state.level);
        iterations = i + 1;
        kind = test.kind;
        state = stepHiz(frame, ray, state, cell, test, settings);

        int reason = choose(cell.leavesImage, kHitReasonOffScreen, kHizRuns);
        reason = choose(cell.isLast, ray.endReason, reason);
        reason = choose(descends, kHizRuns, reason);
        bool isHit = kind == kIntersectionDepth;
        end = choose(isHit, kHitReasonNone, reason);
        endS = choose(isHit, test.s, state.s);
        endAffine = choose(isHit, test.affineDepth, screenRayAffineDepth(ray, state.s));
        if (end != kHizRuns) break;
    }
    bool isCapped = end == kHizRuns;
    bool isHit = end == kHitReasonNone;
    int reason = computeMarchReason(choose(isCapped, kHitReasonIterationCap, end), state.inFront, state.wasHidden);
    reason = choose(isHit, kHitReasonNone, reason);
    return TraceResult(computeMarchClass(reason), reason, screenRayPositionSS(ray, endS),
                       linearDepthFromAffine(frame.orthographic, endAffine), iterations, maxUsedLevel, kind);
}

#endif
