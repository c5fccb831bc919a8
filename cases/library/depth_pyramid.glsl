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
#define kSkyLinearDepth copyOf_kSkyLinearDepth
#define makeDepthPyramidTexel copyOf_makeDepthPyramidTexel
#define computeDepthPyramidSize copyOf_computeDepthPyramidSize
#define computeDepthPyramidLevelCount copyOf_computeDepthPyramidLevelCount
#define computeDepthPyramidCell copyOf_computeDepthPyramidCell
#define fetchFinerDepth copyOf_fetchFinerDepth
#define finerDepthSize copyOf_finerDepthSize
#define reduceDepthPyramidCell copyOf_reduceDepthPyramidCell
#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#undef CROSSRAY_PROJECT_DEPTH_PYRAMID_GLSL
#include "crossray/project/depth_pyramid.glsl"

ivec2 tableSize = ivec2(0);
int tableSalt = 0;

ivec2 finerDepthSize() { return tableSize; }

vec2 fetchFinerDepth(ivec2 cell)
{
    ivec2 size = max(tableSize, ivec2(1));
    bool isInside = cell.x >= 0 && cell.y >= 0 && cell.x < size.x && cell.y < size.y;
    int number = (cell.x % 3 + cell.y % 3 * 3 + tableSalt) % 9;
    return isInside ? vec2(0.0625 * float(number + 1), 0.0625 * float(number + 2)) : vec2(-1.0, 2e30);
}

void checkReduce(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int x = int(d0.x);
    int y = int(d0.y);
    int w = int(d0.z);
    int h = int(d1.x);
    int salt = int(d1.y);
    tableSize = ivec2(w, h);
    tableSalt = salt;
    vec2 c = reduceDepthPyramidCell(ivec2(x, y));
    check(1, c.x, d1.z, 0, 0);
    check(2, c.y, d2.x, 0, 0);
}

void checkTexel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    bool o = d0.x > 0.5;
    bool r = d0.y > 0.5;
    float d = d0.z;
    View v = tableView(o, r);
    check(101, makeDepthPyramidTexel(v, d).x, d1.x, 0.0001, 1e-06);
    check(102, makeDepthPyramidTexel(v, d).y, d1.y, 0.0001, 1e-06);
}

void checkSizes(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    int w = int(d0.x);
    int h = int(d0.y);
    int l = int(d0.z);
    ivec2 s = computeDepthPyramidSize(ivec2(w, h), l);
    check(201, float(s.x), d1.x, 1e-05, 0);
    check(202, float(s.y), d1.y, 1e-05, 0);
    check(203, float(computeDepthPyramidLevelCount(ivec2(w, h))), d1.z, 1e-05, 0);
}

void checkCell(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int x = int(d0.x);
    int y = int(d0.y);
    int l = int(d0.z);
    int w = int(d1.x);
    int h = int(d1.y);
    ivec2 c = computeDepthPyramidCell(ivec2(x, y), l, ivec2(w, h));
    check(301, float(c.x), d1.z, 1e-05, 0);
    check(302, float(c.y), d2.x, 1e-05, 0);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 113) checkReduce(row);
    if (row >= 114 && row <= 173) checkTexel(row);
    if (row >= 174 && row <= 236) checkSizes(row);
    if (row >= 237 && row <= 292) checkCell(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
