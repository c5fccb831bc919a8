// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.

int wrongCheck = 0; // function * 100 + output, from 1, of the first wrong answer; what it was, and what was expected
vec2 wrongAnswer = vec2(0.0);

void check(int which, float answer, float expected, float relative, float absolute)
{
    bool isRight = abs(answer - expected) <= max(absolute, relative * abs(expected)); // false for a NaN
    bool isFirst = !isRight && wrongCheck == 0;
    wrongCheck = isFirst ? which : wrongCheck;
    wrongAnswer = isFirst ? vec2(answer, expected) : wrongAnswer;
}

float number(bool condition) { return condition ? 1.0 : 0.0; }

// Cameras of one place and turn: perspective and orthographic, standard and reversed depth; images of 64 x 48 pixels.
View tableView(bool orthographic, bool reversed)
{
    vec4 right = vec4(2.0, 2.0, -1.0, 0.0) / 3.0;
    vec4 up = vec4(-1.0, 2.0, 2.0, 0.0) / 3.0;
    vec4 back = vec4(2.0, -1.0, 2.0, 0.0) / 3.0;
    mat4 world = mat4(right, up, back, vec4(1.0, 2.0, 3.0, 1.0));
    mat4 view = transpose(mat4(right, up, back, vec4(0.0, 0.0, 0.0, 1.0)));
    view[3] = vec4(-(view * vec4(1.0, 2.0, 3.0, 0.0)).xyz, 1.0);
    float nearDistance = 0.5;
    float farDistance = 64.0;
    // Depth 0 at the near plane and 1 at the far one, and its mirror image.
    float b = orthographic ? 1.0 / 63.5 : -32.0 / 63.5;
    float a = orthographic ? -0.5 / 63.5 : 64.0 / 63.5;
    a = reversed ? 1.0 - a : a;
    b = reversed ? -b : b;
    vec2 slope = vec2(0.8, 0.5);
    float z = orthographic ? -1.0 : 0.0;
    mat4 clip = orthographic ? mat4(vec4(1.25, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, -b, 0.0), vec4(0.0, 0.0, a, 1.0))
                             : mat4(vec4(1.25, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, -a, -1.0), vec4(0.0, 0.0, b, 0.0));
    return View(view, world, clip, vec2(64.0, 48.0), slope, a, b, nearDistance, farDistance, orthographic, reversed);
}
#define fetchSurfaceCell copyOf_fetchSurfaceCell
#define surfacePyramidSize copyOf_surfacePyramidSize
#define surfacePyramidLevelCount copyOf_surfacePyramidLevelCount
#define recordPatchStep copyOf_recordPatchStep
#define kHiddenSamples copyOf_kHiddenSamples
#define kPatchStartLevel copyOf_kPatchStartLevel
#define kPatchTolerance copyOf_kPatchTolerance
#define kPatchStartTolerance copyOf_kPatchStartTolerance
#define kNoClearance copyOf_kNoClearance
#define computePixelEntry copyOf_computePixelEntry
#define computePixelBefore copyOf_computePixelBefore
#define fetchPixelSurface copyOf_fetchPixelSurface
#define pixelAffineDepth copyOf_pixelAffineDepth
#define liftAffineDepth copyOf_liftAffineDepth
#define makePatchWalk copyOf_makePatchWalk
#define positionInRect copyOf_positionInRect
#define computeFront copyOf_computeFront
#define enterPatchCell copyOf_enterPatchCell
#define computeExitPixel copyOf_computeExitPixel
#define computeGap copyOf_computeGap
#define computeClearance copyOf_computeClearance
#define doesSurfaceGoOn copyOf_doesSurfaceGoOn
#define makePixelHit copyOf_makePixelHit
#define testPixel copyOf_testPixel
#define computeFreePath copyOf_computeFreePath
#define chooseFinerLevel copyOf_chooseFinerLevel
#define chooseCoarserLevel copyOf_chooseCoarserLevel
#define descendPatch copyOf_descendPatch
#define computeConfidence copyOf_computeConfidence
#define makePatchStep copyOf_makePatchStep
#define makePatchEnd copyOf_makePatchEnd
#define makePatchHit copyOf_makePatchHit
#define tracePatches copyOf_tracePatches
#define PatchTracerSettings copyOf_PatchTracerSettings
#define PatchStep copyOf_PatchStep
#define PatchTraceResult copyOf_PatchTraceResult
#define HiddenStart copyOf_HiddenStart
#define PatchWalk copyOf_PatchWalk
#define PatchState copyOf_PatchState
#define PatchCell copyOf_PatchCell
#define PixelEntry copyOf_PixelEntry
#define PixelTest copyOf_PixelTest
#undef CROSSRAY_PROJECT_PATCH_TRACER_GLSL
#include "crossray/project/patch_tracer.glsl"

int tableKind = 0;

vec3 wallPlane() // affine depth at the corner of the image, and its change a pixel
{
    return tableKind == 1 ? vec3(0.03125, 0.0, 0.0078125) : tableKind == 2 ? vec3(0.375, -0.00390625, 0.0) : vec3(0.125, 0.001953125, 0.00048828125);
}
ivec4 tableBox() { return tableKind == 3 ? ivec4(28, 12, 36, 34) : tableKind == 4 ? ivec4(20, 8, 52, 40) : ivec4(0); } // begin, end
float boxAffine() { return tableKind == 4 ? 0.28125 : 0.3125; }
ivec2 surfacePyramidSize(int level) { return max(ivec2(64 >> level, 48 >> level), ivec2(1)); }
int surfacePyramidLevelCount() { return tableKind == 6 ? 0 : 7; }

vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    ivec2 cells = surfacePyramidSize(level);
    ivec2 begin = ivec2(cell.x << level, cell.y << level);
    ivec2 end = ivec2(cell.x == cells.x - 1 ? 64 : begin.x + (1 << level), cell.y == cells.y - 1 ? 48 : begin.y + (1 << level));
    vec2 center = 0.5 * vec2(begin + end);
    ivec4 box = tableBox();
    bool touches = box.z > 0 && begin.x < box.z && end.x > box.x && begin.y < box.w && end.y > box.y;
    bool isHole = tableKind == 5 && begin.x >= 32;
    vec3 wall = wallPlane();
    vec4 plane = vec4(wall.x + dot(wall.yz, center), wall.yz, level == 0 ? 0.0 : 0.0009765625 * float(level));
    vec4 front = level == 0 ? vec4(boxAffine(), 0.0, 0.0, 0.0) : vec4(plane.xyz, 0.25);
    vec4 edge = vec4(cell.x < 64 && cell.y < 48 ? 0.25 : 0.5, 0.0, 0.0, 0.0); // a wall that faces the eye, and no pixel beyond the image
    return tableKind == 7 ? edge : isHole ? vec4(0.0, 0.0, 0.0, -1.0) : touches ? front : plane;
}

float recorded = 0.0; // a sum over the steps that knows their order
float recordedCells = 0.0;
void recordPatchStep(PatchStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * min(step.rayLinearDepth, 40.0) + 5.0 * min(step.nearLinearDepth, 40.0) + 7.0 * min(step.farLinearDepth, 40.0));
    recordedCells += share * float(step.level + 3 * step.cell.x + 5 * step.cell.y + 7 * (step.rect.end.x - step.rect.begin.x) + 11 * (step.rect.end.y - step.rect.begin.y) + 13 * step.intersectionKind);
}

// Looks along -z from the origin, 90 degrees wide and half as high: the border of its image is met exactly.
View startView(bool edge)
{
    View view = tableView(false, true);
    mat4 clip = mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 2.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, -1.0), vec4(0.0, 0.0, 0.5, 0.0));
    if (edge) view = View(mat4(1.0), mat4(1.0), clip, vec2(64.0, 48.0), vec2(1.0, 0.5), 0.0, 0.5, 0.5, 64.0, false, true);
    return view;
}

void checkStart(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    bool edge = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    tableKind = edge ? 7 : 0;
    PatchTraceResult r = tracePatches(startView(edge), p, d, PatchTracerSettings(edge ? 0 : 4, 100, 0.4, 0.0));
    check(1, float(r.hitClass), d2.y, 2e-05, 0.0001);
    check(2, float(r.reason), d2.z, 2e-05, 0.0001);
    check(3, r.positionSS.x, d3.x, 2e-05, 0.0001);
    check(4, r.positionSS.y, d3.y, 2e-05, 0.0001);
    check(5, r.linearDepth, d3.z, 2e-05, 0.0001);
    check(6, float(r.iterations), d4.x, 2e-05, 0.0001);
    check(7, float(r.maxUsedLevel), d4.y, 2e-05, 0.0001);
    check(8, float(r.intersectionKind), d4.z, 2e-05, 0.0001);
    check(9, r.confidence, d5.x, 2e-05, 0.0001);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 17) checkStart(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
