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

int tableKind = 0;

// Floor and back wall; a wall with a hole, behind which nothing is; a slab that floats before a wall; a step to the right; small and nearly flat.
float fetchLinearDepth(ivec2 pixel)
{
    float x = float(pixel.x) + 0.5;
    float y = float(pixel.y) + 0.5;
    float floorDepth = y > 26.0 ? 1.0 / (0.0234375 * (y - 24.0)) : 1e30;
    float depth = min(floorDepth, 12.0);
    bool isHole = pixel.x >= 36 && pixel.x < 52;
    depth = tableKind == 1 ? (isHole ? 1e30 : 1.0 / (0.125 + 0.0009765625 * x)) : depth;
    bool isSlab = pixel.x >= 28 && pixel.x < 40 && pixel.y >= 10 && pixel.y < 30;
    depth = tableKind == 2 ? (isSlab ? 3.0 : 1.0 / (0.25 - 0.001953125 * y)) : depth;
    depth = tableKind == 3 ? (pixel.x < 30 ? 1.0 / (0.25 - 0.00390625 * x) : 1.0 / (0.125 + 0.00390625 * (x - 30.0))) : depth;
    return depth;
}

float recorded = 0.0; // a sum over the steps that knows their order
float recordedKinds = 0.0;
void recordLinearStep(LinearStep step)
{
    float share = 1.0 / float(step.iteration + 2);
    recorded += share * (step.positionSS.x + 2.0 * step.positionSS.y + 3.0 * step.rayLinearDepth + 5.0 * min(step.surfaceLinearDepth, 20.0));
    recordedKinds += float(step.intersectionKind) * float(step.iteration + 1);
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
    bool o = d0.x > 0.5;
    int k = int(d0.y);
    int x = int(d0.z);
    int y = int(d1.x);
    float lift = d1.y;
    vec3 d = vec3(d1.z, d2.x, d2.y);
    float stride = d2.z;
    int n = int(d3.x);
    int most = int(d3.y);
    float bias = d3.z;
    int h = int(d4.x);
    tableKind = k;
    View v = tableView(o, true);
    float z = fetchLinearDepth(ivec2(x, y)) * (1.0 + lift);
    vec3 p = positionWSFromSS(v, vec2(float(x) + 0.5, float(y) + 0.5), z);
    vec3 w = (v.worldFromView * vec4(d, 0.0)).xyz;
    LinearResult r = traceLinear(v, p, w, LinearSettings(stride, n, most, bias, h));
    check(1, float(r.hitClass), d4.y, 0.0002, 0.002);
    check(2, float(r.reason), d4.z, 0.0002, 0.002);
    check(3, r.positionSS.x, d5.x, 0.0002, 0.002);
    check(4, r.positionSS.y, d5.y, 0.0002, 0.002);
    check(5, r.linearDepth, d5.z, 0.0002, 0.002);
    check(6, float(r.iterations), d6.x, 0.0002, 0.002);
    check(7, float(r.intersectionKind), d6.y, 0.0002, 0.002);
    check(8, recorded, d6.z, 0.0002, 0.002);
    check(9, recordedKinds, d7.x, 0.0002, 0.002);
}

void checkNoStart(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    LinearResult r = traceLinear(tableView(false, true), p, d, LinearSettings(4.0, 0, 100, 1.0, 0));
    check(101, float(r.hitClass), d2.x, 2e-05, 0.0001);
    check(102, float(r.reason), d2.y, 2e-05, 0.0001);
    check(103, r.positionSS.x, d2.z, 2e-05, 0.0001);
    check(104, r.positionSS.y, d3.x, 2e-05, 0.0001);
    check(105, r.linearDepth, d3.y, 2e-05, 0.0001);
    check(106, float(r.iterations), d3.z, 2e-05, 0.0001);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 776) checkMarch(row);
    if (row >= 777 && row <= 794) checkNoStart(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
