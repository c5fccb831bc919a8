// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/probe/parallax.glsl"
#include "crossray/probe/box_projection.glsl"
#include "crossray/probe/shapes.glsl"

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

// A rotation without a zero: its columns are the axes.
mat3 tableTurn(bool turned)
{
    mat3 turn = mat3(vec3(2.0, 2.0, -1.0) / 3.0, vec3(-1.0, 2.0, 2.0) / 3.0, vec3(2.0, -1.0, 2.0) / 3.0);
    return turned ? turn : mat3(1.0);
}

void checkParallax(int tableRow)
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
    vec3 p = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    int s = int(d2.x);
    vec3 c = vec3(d2.y, d2.z, d3.x);
    bool t = d3.y > 0.5;
    vec3 h = vec3(d3.z, d4.x, d4.y);
    float n = d4.z;
    vec3 q = vec3(d5.x, d5.y, d5.z);
    ParallaxRay r = computeParallax(p, d, ProbeProxy(s, c, tableTurn(t), h, n), q);
    check(1, r.dirWS.x, d6.x, 2e-05, 3e-05);
    check(2, r.dirWS.y, d6.y, 2e-05, 3e-05);
    check(3, r.dirWS.z, d6.z, 2e-05, 3e-05);
    check(4, r.distance, d7.x, 2e-05, 3e-05);
    check(5, r.distanceFromCapture, d7.y, 2e-05, 3e-05);
    check(6, number(r.hit), d7.z, 2e-05, 3e-05);
    check(7, float(r.reason), d8.x, 2e-05, 3e-05);
}

void checkBeyond(int tableRow)
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
    int s = int(d2.x);
    vec3 c = vec3(d2.y, d2.z, d3.x);
    bool t = d3.y > 0.5;
    vec3 h = vec3(d3.z, d4.x, d4.y);
    float n = d4.z;
    vec3 q = vec3(d5.x, d5.y, d5.z);
    ParallaxRay r = computeParallax(p, d, ProbeProxy(s, c, tableTurn(t), h, n), q);
    check(101, r.dirWS.y, d6.x, 1e-05, 1e-06);
    check(102, r.distance, d6.y, 1e-05, 1e-06);
    check(103, r.distanceFromCapture, d6.z, 1e-05, 1e-06);
    check(104, number(r.hit), d7.x, 1e-05, 1e-06);
    check(105, float(r.reason), d7.y, 1e-05, 1e-06);
}

void checkBoxProjection(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 d7 = ownNormalWS(ivec2(8, tableRow));
    int f = int(d0.x);
    vec3 p = vec3(d0.y, d0.z, d1.x);
    vec3 d = vec3(d1.y, d1.z, d2.x);
    vec3 low = vec3(d2.y, d2.z, d3.x);
    vec3 high = vec3(d3.y, d3.z, d4.x);
    vec4 q = vec4(d4.y, d4.z, d5.x, d5.y);
    ProbeBox box = ProbeBox(low, high, q);
    BoxProjection b = computeBoxProjectionDivision(p, d, box);
    if (f == 1) b = computeBoxProjectionSelect(p, d, box);
    check(201, b.dirWS.x, d5.z, 1e-05, 2e-05);
    check(202, b.dirWS.y, d6.x, 1e-05, 2e-05);
    check(203, b.dirWS.z, d6.y, 1e-05, 2e-05);
    check(204, b.distance, d6.z, 1e-05, 2e-05);
    check(205, number(b.applied), d7.x, 1e-05, 2e-05);
}

void checkShapes(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    int a = int(d0.x);
    int b = int(d0.y);
    check(301, number(acceptsProxyShape(a, b)), d0.z, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 253) checkParallax(row);
    if (row >= 254 && row <= 254) checkBeyond(row);
    if (row >= 255 && row <= 456) checkBoxProjection(row);
    if (row >= 457 && row <= 505) checkShapes(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
