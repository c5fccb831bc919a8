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
#define kNoSurfaceDepth copyOf_kNoSurfaceDepth
#define kLinearStartTolerance copyOf_kLinearStartTolerance
#define kLinearRuns copyOf_kLinearRuns
#define fetchLinearDepth copyOf_fetchLinearDepth
#define recordLinearStep copyOf_recordLinearStep
#define fetchAffineDepth copyOf_fetchAffineDepth
#define computeLinearGradient copyOf_computeLinearGradient
#define makeLinearStart copyOf_makeLinearStart
#define isOnStartPlane copyOf_isOnStartPlane
#define computeLinearEnd copyOf_computeLinearEnd
#define computeLinearStride copyOf_computeLinearStride
#define linearRayDepth copyOf_linearRayDepth
#define traceLinear copyOf_traceLinear
#define LinearSettings copyOf_LinearSettings
#define LinearStep copyOf_LinearStep
#define LinearResult copyOf_LinearResult
#define LinearStart copyOf_LinearStart
#define LinearState copyOf_LinearState
#undef CROSSRAY_PROJECT_LINEAR_GLSL
#include "crossray/project/linear.glsl"

int tableKind = 0; // 0: columns of 8 pixels, again after 32; 1: five pixels in a row; 2: a plane; 3: two folds
vec4 tableDepths = vec4(0.0);
float tableLast = 0.0;
ivec2 tableAxis = ivec2(1, 0);
bool tableOrthographic = false;

float fetchLinearDepth(ivec2 pixel)
{
    ivec2 from = pixel - ivec2(20, 30);
    int along = tableAxis.x == 1 ? from.x : from.y;
    int aside = tableAxis.x == 1 ? from.y : from.x;
    int at = tableKind == 0 ? pixel.x / 8 % 4 : along + 2;
    float depth = at == 0 ? tableDepths.x : at == 1 ? tableDepths.y : at == 2 ? tableDepths.z : at == 3 ? tableDepths.w : tableLast;
    bool isStray = tableKind == 1 && (aside != 0 || at < 0 || at > 4);
    float affine = tableDepths.x + tableDepths.y * float(pixel.x) + tableDepths.z * float(pixel.y);
    affine = tableKind == 3 ? tableDepths.x + tableDepths.y * abs(float(pixel.x - 50)) + tableDepths.z * abs(float(pixel.y - 46)) : affine;
    return tableKind >= 2 ? linearDepthFromAffine(tableOrthographic, affine) : isStray ? 0.015625 : depth;
}

float recorded = 0.0; // a sum over the steps that knows their order
float recordedKinds = 0.0;
void recordLinearStep(LinearStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * step.rayLinearDepth + 5.0 * min(step.surfaceLinearDepth, 20.0));
    recordedKinds += float(step.intersectionKind) * float(step.iteration + 1);
}

// A pixel a metre, and world space is view space.
View plainView() { return View(mat4(1.0), mat4(1.0), mat4(1.0), vec2(64.0, 48.0), vec2(32.0, 24.0), 0.0, 1.0, 0.5, 64.0, true, true); }

void checkGradient(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    vec4 a = vec4(d0.y, d0.z, d1.x, d1.y);
    float b = d1.z;
    int axis = int(d2.x);
    int place = int(d2.y);
    int last = int(d2.z);
    tableKind = 1;
    tableDepths = a;
    tableLast = b;
    tableAxis = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    check(1, computeLinearGradient(tableView(o, true), ivec2(20, 30), tableAxis, place, last), d3.x, 1e-05, 1e-06);
}

void checkStart(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec2 s = vec2(d1.y, d1.z);
    float a = d2.x;
    tableKind = 2;
    tableDepths = vec4(p, 0.0);
    tableOrthographic = o;
    LinearStart t = makeLinearStart(tableView(o, true), ScreenRay(s, vec2(5.0, 3.0), 0.2, a, 0.0, 0, 0), ivec2(63, 47));
    check(101, t.centerSS.x, d2.y, 1e-05, 2e-06);
    check(102, t.centerSS.y, d2.z, 1e-05, 2e-06);
    check(103, t.affineDepth, d3.x, 1e-05, 2e-06);
    check(104, t.gradient.x, d3.y, 1e-05, 2e-06);
    check(105, t.gradient.y, d3.z, 1e-05, 2e-06);
    check(106, number(t.inFront), d4.x, 1e-05, 2e-06);
    check(107, number(t.isOn), d4.y, 1e-05, 2e-06);
}

void checkFolds(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec2 s = vec2(d1.x, d1.y);
    tableKind = 3;
    tableDepths = vec4(p, 0.0);
    tableOrthographic = true;
    LinearStart t = makeLinearStart(tableView(true, true), ScreenRay(s, vec2(5.0, 3.0), 0.2, -4.0, 0.0, 0, 0), ivec2(63, 47));
    check(201, t.gradient.x, d1.z, 1e-05, 1e-06);
    check(202, t.gradient.y, d2.x, 1e-05, 1e-06);
}

void checkOnPlane(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool o = d0.x > 0.5;
    float a = d0.y;
    vec2 g = vec2(d0.z, d1.x);
    int x = int(d1.y);
    int y = int(d1.z);
    float z = d2.x;
    check(301, number(isOnStartPlane(tableView(o, true), LinearStart(vec2(20.5, 30.5), a, g, true, true), ivec2(x, y), z)), d2.y, 1e-05, 1e-06);
}

void checkEnd(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec2 a = vec2(d0.x, d0.y);
    vec2 d = vec2(d0.z, d1.x);
    check(401, computeLinearEnd(tableView(false, true), ScreenRay(a, d, 0.1, 0.0, 0.0, 0, 0)), d1.y, 1e-05, 1e-06);
}

void checkStride(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float s = d0.x;
    int n = int(d0.y);
    float end = d0.z;
    float p = d1.x;
    check(501, computeLinearStride(LinearSettings(s, n, 1, 0.0, 0), ScreenRay(vec2(0.0), vec2(1.0), p, 0.0, 0.0, 0, 0), end), d1.y, 1e-05, 1e-06);
}

void checkRayDepth(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    bool o = d0.x > 0.5;
    float s = d0.y;
    ScreenRay r = ScreenRay(vec2(3.0, 5.0), vec2(10.0, -4.0), 0.1, 0.5, -0.25, 0, 0);
    check(601, linearRayDepth(tableView(o, true), r, s), d0.z, 1e-05, 1e-06);
}

void checkMarch(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    vec4 e = vec4(d2.x, d2.y, d2.z, d3.x);
    float stride = d3.y;
    int n = int(d3.z);
    int most = int(d4.x);
    float bias = d4.y;
    int h = int(d4.z);
    tableDepths = e;
    LinearResult r = traceLinear(plainView(), p, d, LinearSettings(stride, n, most, bias, h));
    tableKind = 0;
    check(701, float(r.hitClass), d5.x, 0.0002, 0.002);
    check(702, float(r.reason), d5.y, 0.0002, 0.002);
    check(703, r.positionSS.x, d5.z, 0.0002, 0.002);
    check(704, r.positionSS.y, d6.x, 0.0002, 0.002);
    check(705, r.linearDepth, d6.y, 0.0002, 0.002);
    check(706, float(r.iterations), d6.z, 0.0002, 0.002);
    check(707, float(r.intersectionKind), d7.x, 0.0002, 0.002);
    check(708, recorded, d7.y, 0.0002, 0.002);
    check(709, recordedKinds, d7.z, 0.0002, 0.002);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 147) checkGradient(row);
    if (row >= 148 && row <= 231) checkStart(row);
    if (row >= 232 && row <= 234) checkFolds(row);
    if (row >= 235 && row <= 258) checkOnPlane(row);
    if (row >= 259 && row <= 282) checkEnd(row);
    if (row >= 283 && row <= 300) checkStride(row);
    if (row >= 301 && row <= 306) checkRayDepth(row);
    if (row >= 307 && row <= 454) checkMarch(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
