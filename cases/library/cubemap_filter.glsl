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
#define fetchProbeTexel copyOf_fetchProbeTexel
#define probeCubeSize copyOf_probeCubeSize
#define probeCubeLevelCount copyOf_probeCubeLevelCount
#define usableRadiance copyOf_usableRadiance
#define fetchFoldedTexel copyOf_fetchFoldedTexel
#define weightBeyondEdge copyOf_weightBeyondEdge
#define computeTapWeight copyOf_computeTapWeight
#define sampleProbeCubemap copyOf_sampleProbeCubemap
#undef CROSSRAY_PROBE_CUBEMAP_FILTER_GLSL
#include "crossray/probe/cubemap_filter.glsl"

int probeCubeSize(int cubemap) { return cubemap == 4 ? 8 : 4; }
int probeCubeLevelCount(int cubemap) { return cubemap == 2 ? 0 : cubemap == 3 ? 4 : 3; }

bool askedOutside = false; // for a face, a texel or a level that there is not
vec3 fetchProbeTexel(int cubemap, int face, ivec2 texel, int level)
{
    int last = max((probeCubeSize(cubemap) >> level) - 1, 0);
    bool isTexel = min(texel.x, texel.y) >= 0 && max(texel.x, texel.y) <= last;
    bool isThere = isTexel && face >= 0 && face <= 5 && level >= 0 && level < max(probeCubeLevelCount(cubemap), 1);
    askedOutside = askedOutside || !isThere;
    int number = face * 7 + texel.x * 3 + texel.y * 5 + level * 11;
    vec3 radiance = vec3(float(number % 13), float(number % 7) + 0.5, float(number % 5)) * 0.25;
    int kind = cubemap == 1 ? number % 6 : 0;
    radiance.x = kind == 1 ? -1.0 : kind == 2 ? uintBitsToFloat(0x7fc00000u) : kind == 3 ? 90000.0 : radiance.x;
    radiance.y = kind == 2 ? -1.0 : kind == 4 ? uintBitsToFloat(0x7fc00000u) : kind == 5 ? 80000.0 : radiance.y;
    radiance.z = kind == 4 ? uintBitsToFloat(0x7f800000u) : kind == 5 ? 70000.0 : radiance.z;
    return radiance;
}

void checkSample(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    int c = int(d0.x);
    vec3 d = vec3(d0.y, d0.z, d1.x);
    float level = d1.y;
    vec3 r = sampleProbeCubemap(c, d, level);
    check(1, r.x, d1.z, 4e-06, 4e-06);
    check(2, r.y, d2.x, 4e-06, 4e-06);
    check(3, r.z, d2.y, 4e-06, 4e-06);
    check(4, number(askedOutside), d2.z, 4e-06, 4e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 250) checkSample(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
