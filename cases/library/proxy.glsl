// Made by tables.py: functions of the library on the rows of data/. Confidence is 1 where the row's answers are right; else HitDepth
// says which is wrong first (function * 100 + output, from 1), and HitPositionSS what it was and what was expected.
#include "crossray/project/proxy.glsl"

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

void checkBox(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 o = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    vec3 c = vec3(d2.x, d2.y, d2.z);
    bool turned = d3.x > 0.5;
    vec3 h = vec3(d3.y, d3.z, d4.x);
    ProxyHit hit = projectProxyBox(o, d, c, tableTurn(turned), h);
    check(1, hit.positionWS.x, d4.y, 2e-05, 6e-05);
    check(2, hit.positionWS.y, d4.z, 2e-05, 6e-05);
    check(3, hit.positionWS.z, d5.x, 2e-05, 6e-05);
    check(4, hit.distance, d5.y, 2e-05, 6e-05);
    check(5, number(hit.hit), d5.z, 2e-05, 6e-05);
    check(6, float(hit.reason), d6.x, 2e-05, 6e-05);
}

void checkOnFace(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 d6 = ownNormalWS(ivec2(7, tableRow));
    vec3 o = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    vec3 c = vec3(d2.x, d2.y, d2.z);
    bool turned = d3.x > 0.5;
    vec3 h = vec3(d3.y, d3.z, d4.x);
    ProxyHit hit = projectProxyBox(o, d, c, tableTurn(turned), h);
    check(101, hit.positionWS.x, d4.y, 5e-07, 1e-06);
    check(102, hit.positionWS.y, d4.z, 5e-07, 1e-06);
    check(103, hit.positionWS.z, d5.x, 5e-07, 1e-06);
    check(104, hit.distance, d5.y, 5e-07, 1e-06);
    check(105, number(hit.hit), d5.z, 5e-07, 1e-06);
    check(106, float(hit.reason), d6.x, 5e-07, 1e-06);
}

void checkSphere(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 d4 = ownNormalWS(ivec2(5, tableRow));
    vec3 d5 = ownNormalWS(ivec2(6, tableRow));
    vec3 o = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    vec3 c = vec3(d2.x, d2.y, d2.z);
    float r = d3.x;
    ProxyHit hit = projectProxySphere(o, d, c, r);
    check(201, hit.positionWS.x, d3.y, 2e-05, 3e-05);
    check(202, hit.positionWS.y, d3.z, 2e-05, 3e-05);
    check(203, hit.positionWS.z, d4.x, 2e-05, 3e-05);
    check(204, hit.distance, d4.y, 2e-05, 3e-05);
    check(205, number(hit.hit), d4.z, 2e-05, 3e-05);
    check(206, float(hit.reason), d5.x, 2e-05, 3e-05);
}

void checkInfinite(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec3 o = vec3(d0.x, d0.y, d0.z);
    vec3 d = vec3(d1.x, d1.y, d1.z);
    ProxyHit hit = projectProxyInfinite(o, d);
    check(301, hit.positionWS.x, d2.x, 1e-05, 1e-06);
    check(302, hit.positionWS.y, d2.y, 1e-05, 1e-06);
    check(303, hit.positionWS.z, d2.z, 1e-05, 1e-06);
    check(304, hit.distance, d3.x, 1e-05, 1e-06);
    check(305, number(hit.hit), d3.y, 1e-05, 1e-06);
    check(306, float(hit.reason), d3.z, 1e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 117) checkBox(row);
    if (row >= 118 && row <= 129) checkOnFace(row);
    if (row >= 130 && row <= 177) checkSphere(row);
    if (row >= 178 && row <= 191) checkInfinite(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
