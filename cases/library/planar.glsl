// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/probe/planar.glsl"

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

void checkReflection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec3 q = vec3(d1.x, d1.y, d1.z);
    vec3 n = vec3(d2.x, d2.y, d2.z);
    vec3 m = (makeReflectionMatrix(MirrorPlane(q, n)) * vec4(p, 1.0)).xyz;
    check(1, m.x, d3.x, 1e-05, 4e-06);
    check(2, m.y, d3.y, 1e-05, 4e-06);
    check(3, m.z, d3.z, 1e-05, 4e-06);
}

void checkView(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    bool o = d0.x > 0.5;
    float sx = d0.y;
    float sy = d0.z;
    vec3 p = vec3(d1.x, d1.y, d1.z);
    vec3 n = vec3(d2.x, d2.y, d2.z);
    vec3 q = vec3(d3.x, d3.y, d3.z);
    View v = tableView(o, true);
    v.slope = vec2(sx, sy);
    MirroredView m = makeMirroredView(v, MirrorPlane(p, n));
    vec3 s = (m.view.viewFromWorld * vec4(q, 1.0)).xyz;
    vec3 b = (m.view.worldFromView * vec4(s, 1.0)).xyz;
    check(101, float(m.status), d4.x, 1e-05, 1e-05);
    check(102, s.x, d4.y, 1e-05, 1e-05);
    check(103, s.y, d4.z, 1e-05, 1e-05);
    check(104, s.z, d5.x, 1e-05, 1e-05);
    check(105, b.x, d5.y, 1e-05, 1e-05);
    check(106, b.y, d5.z, 1e-05, 1e-05);
    check(107, b.z, d6.x, 1e-05, 1e-05);
}

void checkSlope(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float f = d0.x;
    float a = d0.y;
    check(201, computeCaptureSlope(f, a).x, d0.z, 0.0001, 1e-06);
    check(202, computeCaptureSlope(f, a).y, d1.x, 0.0001, 1e-06);
}

void checkOblique(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    bool o = d0.x > 0.5;
    bool r = d0.y > 0.5;
    float far = d0.z;
    vec3 p = vec3(d1.x, d1.y, d1.z);
    vec3 n = vec3(d2.x, d2.y, d2.z);
    float x = d3.x;
    float y = d3.y;
    View v = tableView(o, r);
    v.farDistance = far;
    MirrorPlane plane = MirrorPlane(p, n);
    ObliqueProjection found = makeObliqueProjection(v, plane);
    vec4 row = depthRow(found.clipFromView);
    vec3 nVS = safeNormalize(directionVSFromWS(v, safeNormalize(n, vec3(0.0))), vec3(0.0));
    vec3 pVS = positionVSFromWS(v, p);
    vec2 side = vec2(nVS.x < 0.0 ? -0.8 : 0.8, nVS.y < 0.0 ? -0.5 : 0.5);
    vec3 along = o ? vec3(0.0, 0.0, -1.0) : vec3(x * 0.8, y * 0.5, -1.0);
    vec3 from = o ? vec3(x * 0.8, y * 0.5, 0.0) : vec3(0.0);
    vec3 onPlane = from + along * (dot(nVS, pVS - from) / dot(nVS, along));
    float w = o ? 1.0 : -onPlane.z;
    vec4 corner = o ? vec4(side, -far, 1.0) : vec4(side, -1.0, far >= 65504.0 ? 0.0 : 1.0 / far);
    float valid = found.status == 0 ? 1.0 : 0.0;
    float near = valid > 0.5 ? dot(row, vec4(onPlane, 1.0)) / w : 0.0;
    float end = valid > 0.5 ? dot(row, corner) : 0.0;
    mat4 clip = v.clipFromView;
    float kept = number(found.clipFromView[0].x == clip[0].x && found.clipFromView[1].y == clip[1].y && found.clipFromView[2].w == clip[2].w && found.clipFromView[3].w == clip[3].w
        && found.clipFromView[0].y == 0.0 && found.clipFromView[1].x == 0.0 && found.clipFromView[3].x == 0.0 && found.clipFromView[2].y == 0.0);
    check(301, float(found.status), d3.z, 1e-05, 2e-05);
    check(302, near, d4.x, 1e-05, 2e-05);
    check(303, end, d4.y, 1e-05, 2e-05);
    check(304, kept, d4.z, 1e-05, 2e-05);
}

void checkFromOblique(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    bool r = d0.y > 0.5;
    vec4 row = vec4(d0.z, d1.x, d1.y, d1.z);
    vec2 ndc = vec2(d2.x, d2.y);
    float d = d2.z;
    check(401, linearDepthFromOblique(tableView(o, r), withDepthRow(mat4(1.0), row), ndc, d), d3.x, 4e-05, 1e-06);
}

void checkLookUp(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    bool r = d0.y > 0.5;
    vec3 p = vec3(d0.z, d1.x, d1.y);
    vec3 d = vec3(d1.z, d2.x, d2.y);
    View v = tableView(o, r);
    PlanarLookup f = lookUpPlanar(v, v.clipFromView, p, d);
    check(501, f.positionUV.x, d2.z, 1e-05, 4e-06);
    check(502, f.positionUV.y, d3.x, 1e-05, 4e-06);
    check(503, f.weight, d3.y, 1e-05, 4e-06);
    check(504, float(f.status), d3.z, 1e-05, 4e-06);
}

void checkOnBorder(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec4 row = vec4(d1.x, d1.y, d1.z, d2.x);
    vec3 d = vec3(d2.y, d2.z, d3.x);
    View v = tableView(false, false);
    v.viewFromWorld = mat4(1.0);
    v.worldFromView = mat4(1.0);
    PlanarLookup f = lookUpPlanar(v, withDepthRow(mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, 0.0, -1.0), vec4(0.0)), row), p, d);
    check(601, f.positionUV.x, d3.y, 1e-05, 1e-06);
    check(602, f.positionUV.y, d3.z, 1e-05, 1e-06);
    check(603, f.weight, d4.x, 1e-05, 1e-06);
    check(604, float(f.status), d4.y, 1e-05, 1e-06);
}

void checkThresholds(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool flattened = d0.x > 0.5;
    vec2 s = vec2(d0.y, d0.z);
    float far = d1.x;
    vec3 p = vec3(d1.y, d1.z, d2.x);
    vec3 n = vec3(d2.y, d2.z, d3.x);
    View v = tableView(false, true);
    v.worldFromView = mat4(1.0);
    v.viewFromWorld = flattened ? mat4(vec4(0.0), vec4(0.0), vec4(0.0), vec4(1.0)) : mat4(1.0);
    v.slope = s;
    v.farDistance = far;
    check(701, float(makeMirroredView(v, MirrorPlane(p, n)).status), d3.y, 1e-05, 0);
    check(702, float(makeObliqueProjection(v, MirrorPlane(p, n)).status), d3.z, 1e-05, 0);
}

void checkDepthRow(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    vec3 d8 = ownNormalWS(ivec2(9, tableRow));
    vec3 d9 = ownNormalWS(ivec2(10, tableRow));
    vec3 d10 = ownNormalWS(ivec2(11, tableRow));
    vec3 d11 = ownNormalWS(ivec2(12, tableRow));
    vec3 d12 = ownNormalWS(ivec2(13, tableRow));
    vec3 d13 = ownNormalWS(ivec2(14, tableRow));
    vec4 a = vec4(d0.x, d0.y, d0.z, d1.x);
    vec4 b = vec4(d1.y, d1.z, d2.x, d2.y);
    vec4 c = vec4(d2.z, d3.x, d3.y, d3.z);
    vec4 d = vec4(d4.x, d4.y, d4.z, d5.x);
    vec4 row = vec4(d5.y, d5.z, d6.x, d6.y);
    mat4 m = withDepthRow(mat4(a, b, c, d), row);
    vec4 was = depthRow(mat4(a, b, c, d));
    check(801, m[0].x, d6.z, 1e-05, 0);
    check(802, m[0].y, d7.x, 1e-05, 0);
    check(803, m[0].z, d7.y, 1e-05, 0);
    check(804, m[0].w, d7.z, 1e-05, 0);
    check(805, m[1].x, d8.x, 1e-05, 0);
    check(806, m[1].y, d8.y, 1e-05, 0);
    check(807, m[1].z, d8.z, 1e-05, 0);
    check(808, m[1].w, d9.x, 1e-05, 0);
    check(809, m[2].x, d9.y, 1e-05, 0);
    check(810, m[2].y, d9.z, 1e-05, 0);
    check(811, m[2].z, d10.x, 1e-05, 0);
    check(812, m[2].w, d10.y, 1e-05, 0);
    check(813, m[3].x, d10.z, 1e-05, 0);
    check(814, m[3].y, d11.x, 1e-05, 0);
    check(815, m[3].z, d11.y, 1e-05, 0);
    check(816, m[3].w, d11.z, 1e-05, 0);
    check(817, was.x, d12.x, 1e-05, 0);
    check(818, was.y, d12.y, 1e-05, 0);
    check(819, was.z, d12.z, 1e-05, 0);
    check(820, was.w, d13.x, 1e-05, 0);
}

void checkAlignment(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 n = vec3(d0.x, d0.y, d0.z);
    vec3 m = vec3(d1.x, d1.y, d1.z);
    check(901, computeMirrorAlignment(MirrorPlane(vec3(0.0), n), m), d2.x, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 20) checkReflection(row);
    if (row >= 21 && row <= 51) checkView(row);
    if (row >= 52 && row <= 105) checkSlope(row);
    if (row >= 106 && row <= 178) checkOblique(row);
    if (row >= 179 && row <= 302) checkFromOblique(row);
    if (row >= 303 && row <= 366) checkLookUp(row);
    if (row >= 367 && row <= 429) checkOnBorder(row);
    if (row >= 430 && row <= 437) checkThresholds(row);
    if (row >= 438 && row <= 438) checkDepthRow(row);
    if (row >= 439 && row <= 450) checkAlignment(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
