// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/core/ray_ndc.glsl"
#include "crossray/core/view.glsl"

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

void checkDepths(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    bool o = d0.x > 0.5;
    bool r = d0.y > 0.5;
    float d = d0.z;
    check(1, number(isClearedDepth(tableView(o, r), d)), d1.x, 0.0002, 1e-06);
    check(2, linearDepthFromDevice(tableView(o, r), d), d1.y, 0.0002, 1e-06);
}

void checkInfiniteFar(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float d = d0.x;
    View v = tableView(false, true);
    v.depthA = 0.0;
    v.depthB = 0.5;
    v.farDistance = 65504.0;
    check(101, linearDepthFromDevice(v, d), d0.y, 1e-05, 1e-06);
}

void checkFromEye(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float d = d0.x;
    View v = tableView(true, false);
    v.depthA = -0.0001220703125;
    v.depthB = 0.015625;
    check(201, linearDepthFromDevice(v, d), d0.y, 1e-05, 1e-06);
}

void checkDeviceDepth(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    bool o = d0.x > 0.5;
    bool r = d0.y > 0.5;
    float z = d0.z;
    check(301, deviceDepthFromLinear(tableView(o, r), z), d1.x, 1e-05, 1e-06);
}

void checkNearestDepth(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    float z = d0.x;
    check(401, deviceDepthFromLinear(tableView(false, false), z) / 1e30, d0.y, 1e-05, 1e-06);
}

void checkNoAxis(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 p = vec3(d0.x, d0.y, d0.z);
    View v = tableView(false, true);
    v.worldFromView[2] = vec4(0.0);
    vec3 d = viewDirectionWS(v, p);
    check(501, d.x, d1.x, 1e-05, 1e-06);
    check(502, d.y, d1.y, 1e-05, 1e-06);
    check(503, d.z, d1.z, 1e-05, 1e-06);
}

void checkNearEye(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    float z = d0.x;
    vec3 d = vec3(d0.y, d0.z, d1.x);
    View v = tableView(false, true);
    v.viewFromWorld = mat4(1.0);
    vec3 found = computeRayDirNDC(v, vec3(z, z, -z), d);
    check(601, found.x, d1.y, 1e-05, 1e-06);
    check(602, found.y, d1.z, 1e-05, 1e-06);
    check(603, found.z, d2.x, 1e-05, 1e-06);
}

void checkAlong(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float z = d0.x;
    float x = d0.y;
    View v = tableView(false, true);
    v.viewFromWorld = mat4(1.0);
    vec3 found = computeRayDirNDC(v, vec3(0.0, 0.0, -z), vec3(x, 0.0, -1.0));
    check(701, found.x, d0.z, 1e-05, 1e-06);
    check(702, found.y, d1.x, 1e-05, 1e-06);
    check(703, found.z, d1.y, 1e-05, 1e-06);
}

void checkFromScreen(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    vec2 ss = vec2(d0.y, d0.z);
    float z = d1.x;
    vec3 vs = positionVSFromSS(tableView(o, false), ss, z);
    vec3 ws = positionWSFromSS(tableView(o, false), ss, z);
    check(801, positionNDCFromSS(tableView(o, false), ss).x, d1.y, 1e-05, 4e-06);
    check(802, positionNDCFromSS(tableView(o, false), ss).y, d1.z, 1e-05, 4e-06);
    check(803, vs.x, d2.x, 1e-05, 4e-06);
    check(804, vs.y, d2.y, 1e-05, 4e-06);
    check(805, vs.z, d2.z, 1e-05, 4e-06);
    check(806, ws.x, d3.x, 1e-05, 4e-06);
    check(807, ws.y, d3.y, 1e-05, 4e-06);
    check(808, ws.z, d3.z, 1e-05, 4e-06);
}

void checkToScreen(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    ScreenPosition found = projectWSToSS(tableView(o, true), p);
    check(901, found.positionSS.x, d1.y, 4e-06, 2e-05);
    check(902, found.positionSS.y, d1.z, 4e-06, 2e-05);
    check(903, found.linearDepth, d2.x, 4e-06, 2e-05);
    check(904, number(found.inFront), d2.y, 4e-06, 2e-05);
}

void checkOverflow(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    ScreenPosition found = projectVSToSS(tableView(o, true), p);
    check(1001, found.positionSS.x, d1.y, 1e-05, 1e-06);
    check(1002, found.positionSS.y, d1.z, 1e-05, 1e-06);
    check(1003, found.linearDepth, d2.x, 1e-05, 1e-06);
    check(1004, number(found.inFront), d2.y, 1e-05, 1e-06);
}

void checkDirections(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    vec3 toEye = viewDirectionWS(tableView(o, true), p);
    check(1101, directionVSFromWS(tableView(o, true), d).x, d2.y, 1e-05, 4e-06);
    check(1102, directionVSFromWS(tableView(o, true), d).y, d2.z, 1e-05, 4e-06);
    check(1103, directionVSFromWS(tableView(o, true), d).z, d3.x, 1e-05, 4e-06);
    check(1104, toEye.x, d3.y, 1e-05, 4e-06);
    check(1105, toEye.y, d3.z, 1e-05, 4e-06);
    check(1106, toEye.z, d4.x, 1e-05, 4e-06);
    check(1107, positionVSFromWS(tableView(o, true), p).x, d4.y, 1e-05, 4e-06);
    check(1108, positionVSFromWS(tableView(o, true), p).y, d4.z, 1e-05, 4e-06);
    check(1109, positionVSFromWS(tableView(o, true), p).z, d5.x, 1e-05, 4e-06);
}

void checkOnScreen(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec2 ss = vec2(d0.x, d0.y);
    check(1201, number(isOnScreen(tableView(false, true), ss)), d0.z, 1e-05, 1e-06);
    check(1202, screenScale(tableView(false, true)).x, d1.x, 1e-05, 1e-06);
    check(1203, screenScale(tableView(true, true)).y, d1.y, 1e-05, 1e-06);
}

void checkRayDirNDC(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    bool o = d0.x > 0.5;
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    vec3 found = computeRayDirNDC(tableView(o, true), p, d);
    check(1301, found.x, d2.y, 2e-05, 1e-05);
    check(1302, found.y, d2.z, 2e-05, 1e-05);
    check(1303, found.z, d3.x, 2e-05, 1e-05);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 87) checkDepths(row);
    if (row >= 88 && row <= 92) checkInfiniteFar(row);
    if (row >= 93 && row <= 96) checkFromEye(row);
    if (row >= 97 && row <= 121) checkDeviceDepth(row);
    if (row >= 122 && row <= 124) checkNearestDepth(row);
    if (row >= 125 && row <= 126) checkNoAxis(row);
    if (row >= 127 && row <= 131) checkNearEye(row);
    if (row >= 132 && row <= 136) checkAlong(row);
    if (row >= 137 && row <= 146) checkFromScreen(row);
    if (row >= 147 && row <= 180) checkToScreen(row);
    if (row >= 181 && row <= 187) checkOverflow(row);
    if (row >= 188 && row <= 201) checkDirections(row);
    if (row >= 202 && row <= 217) checkOnScreen(row);
    if (row >= 218 && row <= 267) checkRayDirNDC(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
