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
#define kSmallestCoverage copyOf_kSmallestCoverage
#define makeColorPyramidTexel copyOf_makeColorPyramidTexel
#define computeColorLevel copyOf_computeColorLevel
#define computeReflectionColorLevel copyOf_computeReflectionColorLevel
#define computeRefractionColorLevel copyOf_computeRefractionColorLevel
#define fetchColorPyramid copyOf_fetchColorPyramid
#define colorPyramidSize copyOf_colorPyramidSize
#define weighColorCell copyOf_weighColorCell
#define weighColorLevel copyOf_weighColorLevel
#define sampleColorPyramid copyOf_sampleColorPyramid
#define fetchFinerColor copyOf_fetchFinerColor
#define finerColorSize copyOf_finerColorSize
#define finerColorLevel copyOf_finerColorLevel
#define colorImageSize copyOf_colorImageSize
#define computeColorCellWidth copyOf_computeColorCellWidth
#define reduceColorPyramidCell copyOf_reduceColorPyramidCell
#define ColorSample copyOf_ColorSample
#define CROSSRAY_REDUCE_COLOR_PYRAMID
#undef CROSSRAY_PROJECT_COLOR_PYRAMID_GLSL
#include "crossray/project/color_pyramid.glsl"

int tableLevels = 4;
float tableCoverage = -1.0; // of all cells, from 0 on
bool askedOutside = false; // for a cell or a level that there is not
bool tableIsTall = false;
ivec2 colorImageSize() { return tableIsTall ? ivec2(6, 11) : ivec2(11, 6); }
ivec2 colorPyramidSize(int level) { return max(ivec2(colorImageSize().x >> level, colorImageSize().y >> level), ivec2(1)); }

vec4 fetchColorPyramid(ivec2 cell, int level)
{
    ivec2 size = colorPyramidSize(level);
    bool isCell = min(cell.x, cell.y) >= 0 && cell.x < size.x && cell.y < size.y;
    askedOutside = askedOutside || !isCell || level < 0 || level >= tableLevels;
    int number = cell.x * 3 + cell.y * 5 + level * 7;
    float coverage = tableCoverage >= 0.0 ? tableCoverage : float(number % 4) * 0.25;
    float red = tableCoverage >= 0.0 ? 0.0 : float(number % 9) * 0.5;
    return coverage > 0.0 ? vec4(red, float(number % 5), float(number % 7) * 0.25, coverage) : vec4(0.0);
}

int tableLevel = 0;
bool tableIsEmpty = false;
vec4 fetchFinerColor(ivec2 cell) { return fetchColorPyramid(cell, tableLevel); }
ivec2 finerColorSize() { return tableIsEmpty ? ivec2(0) : colorPyramidSize(tableLevel); }
int finerColorLevel() { return tableLevel; }

void checkSample(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    vec2 uv = vec2(d0.x, d0.y);
    float level = d0.z;
    int n = int(d1.x);
    float c = d1.y;
    tableLevels = max(n, 1);
    tableCoverage = c;
    ColorSample s = sampleColorPyramid(uv, level, n);
    check(1, s.color.x, d1.z, 1e-05, 4e-06);
    check(2, s.color.y, d2.x, 1e-05, 4e-06);
    check(3, s.color.z, d2.y, 1e-05, 4e-06);
    check(4, s.coverage, d2.z, 1e-05, 4e-06);
    check(5, number(s.isValid), d3.x, 1e-05, 4e-06);
    check(6, number(askedOutside), d3.y, 1e-05, 4e-06);
}

void checkReduce(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    vec3 d2 = ownNormalWS(ivec2(3, tableRow));
    vec3 d3 = ownNormalWS(ivec2(4, tableRow));
    int x = int(d0.x);
    int y = int(d0.y);
    int l = int(d0.z);
    float f = d1.x;
    bool empty = d1.y > 0.5;
    bool tall = d1.z > 0.5;
    tableLevel = l;
    tableCoverage = f;
    tableIsEmpty = empty;
    tableIsTall = tall;
    vec4 c = reduceColorPyramidCell(ivec2(x, y));
    check(101, c.x, d2.x, 1e-05, 4e-06);
    check(102, c.y, d2.y, 1e-05, 4e-06);
    check(103, c.z, d2.z, 1e-05, 4e-06);
    check(104, c.w, d3.x, 1e-05, 4e-06);
    check(105, number(askedOutside), d3.y, 1e-05, 4e-06);
}

void checkLevel(int tableRow)
{
    vec3 d0 = ownNormalWS(ivec2(1, tableRow));
    vec3 d1 = ownNormalWS(ivec2(2, tableRow));
    float r = d0.x;
    float e = d0.y;
    int n = int(d0.z);
    check(201, computeColorLevel(r, e, n), d1.x, 2e-05, 1e-06);
}

OwnHit traceOwn(OwnRay ray)
{
    int row = ray.pixel.y;
    if (row >= 0 && row <= 136) checkSample(row);
    if (row >= 137 && row <= 175) checkReduce(row);
    if (row >= 176 && row <= 247) checkLevel(row);
    return OwnHit(kHitClassHit, kHitReasonNone, wrongAnswer, float(wrongCheck), number(wrongCheck == 0));
}
