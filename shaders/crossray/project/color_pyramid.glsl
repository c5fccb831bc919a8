// The colour pyramid of the previous frame: what rough reflections and refractions see, level by level. Broken texels
// stay where they are.
// Hooks: vec4 fetchColorPyramid(ivec2 cell, int level)  a cell as the functions below make it; the cell is inside the
// level
//        ivec2 colorPyramidSize(int level)              cells of a level, as those of the depth pyramid
//   and, only for reduceColorPyramidCell, where CROSSRAY_REDUCE_COLOR_PYRAMID is defined before the include:
//        vec4 fetchFinerColor(ivec2 cell)  a cell of the next finer level; the cell is inside it
//        ivec2 finerColorSize()            cells of that level
//        int finerColorLevel()             its number
//        ivec2 colorImageSize()            pixels of level 0
// Source: Williams 1983, "Pyramidal Parametrics"; the roughness of a level: Unity HDRP (2018). Own: the coverage, and
// the covering of odd sizes.
//
// A cell is the mean colour (rgb, linear radiance) of the valid pixels that it covers, and their share (a, its
// coverage): a pixel with a NaN, an infinity or a negative channel is not valid and counts nowhere. So a broken pixel
// darkens and brightens nothing, at any level, and the coarsest cell is the mean of the image whatever its size.
#ifndef CROSSRAY_PROJECT_COLOR_PYRAMID_GLSL
#define CROSSRAY_PROJECT_COLOR_PYRAMID_GLSL

#include "crossray/core/math.glsl"

// Coverage below which a place has no colour.
const float kSmallestCoverage = 1e-6;

struct ColorSample {
    vec3 color;     // linear radiance, at least 0; 0 where there is none
    float coverage; // share of valid pixels behind it, [0,1]
    bool isValid;   // the coverage is at least kSmallestCoverage
};

vec4 makeColorPyramidTexel(vec3 color)
{
    bool isNumber = isFinite(color);
    bool isPositive = all(greaterThanEqual(color, vec3(0.0)));
    bool isValid = isNumber && isPositive;
    return isValid ? vec4(color, 1.0) : vec4(0.0);
}

// Coarser levels for rougher surfaces: r^0.8 and r^1.3 of the way from level 0 to the last. Roughness is taken into
// [0,1], NaN is 0; `levels` counts all, below 1 it is 1.
float computeColorLevel(float roughness, float exponent, int levels)
{
    float r = saturate(roughness);
    float share = choose(r > 0.0, pow(max(r, 1e-30), exponent), 0.0);
    return share * float(max(levels, 1) - 1);
}
float computeReflectionColorLevel(float roughness, int levels)
{
    return computeColorLevel(roughness, 0.8, levels);
}
float computeRefractionColorLevel(float roughness, int levels)
{
    return computeColorLevel(roughness, 1.3, levels);
}

vec4 fetchColorPyramid(ivec2 cell, int level);
ivec2 colorPyramidSize(int level);

// Cell times weight and coverage, and that product itself.
vec4 weighColorCell(ivec2 cell, ivec2 size, int level, float weight)
{
    vec4 found = fetchColorPyramid(clamp(cell, ivec2(0), size - ivec2(1)), level);
    float share = found.w * weight;
    return vec4(found.xyz * share, share);
}

// The four cells about a place, weighted bilinearly; cells beyond the border repeat the last.
vec4 weighColorLevel(vec2 positionUV, int level)
{
    ivec2 size = colorPyramidSize(level);
    vec2 place = positionUV * vec2(size) - vec2(0.5);
    vec2 base = floor(place);
    vec2 share = place - base;
    ivec2 cell = ivec2(base);
    return weighColorCell(cell, size, level, (1.0 - share.x) * (1.0 - share.y)) +
           weighColorCell(cell + ivec2(1, 0), size, level, share.x * (1.0 - share.y)) +
           weighColorCell(cell + ivec2(0, 1), size, level, (1.0 - share.x) * share.y) +
           weighColorCell(cell + ivec2(1, 1), size, level, share.x * share.y);
}

// Trilinear. The position is taken into [0,1], the level into [0, levels - 1]; NaN is 0.
ColorSample sampleColorPyramid(vec2 positionUV, float level, int levels)
{
    vec2 place = saturate(positionUV);
    float last = float(max(levels, 1) - 1);
    float placeLevel = choose(level > 0.0, min(level, last), 0.0);
    int lower = int(floor(placeLevel));
    int upper = min(lower + 1, max(levels, 1) - 1);
    float share = placeLevel - float(lower);
    vec4 sum = weighColorLevel(place, lower) * (1.0 - share) + weighColorLevel(place, upper) * share;
    bool isValid = sum.w >= kSmallestCoverage;
    return ColorSample(choose(isValid, sum.xyz / max(sum.w, kSmallestCoverage), vec3(0.0)), min(sum.w, 1.0), isValid);
}

#ifdef CROSSRAY_REDUCE_COLOR_PYRAMID
vec4 fetchFinerColor(ivec2 cell);
ivec2 finerColorSize();
int finerColorLevel();
ivec2 colorImageSize();

// Pixels that a cell covers along one axis: the last of a level reaches to the image's border.
int computeColorCellWidth(int cell, int cells, int level, int pixels)
{
    int begin = cell << level;
    return choose(cell == cells - 1, pixels - begin, 1 << level);
}

// One cell from the 1 to 9 that it covers in the finer level, each by its share of the pixels.
vec4 reduceColorPyramidCell(ivec2 cell)
{
    ivec2 finerSize = max(finerColorSize(), ivec2(1));
    ivec2 size = max(ivec2(finerSize.x / 2, finerSize.y / 2), ivec2(1));
    ivec2 begin = ivec2(cell.x * 2, cell.y * 2);
    ivec2 end =
        ivec2(cell.x == size.x - 1 ? finerSize.x : begin.x + 2, cell.y == size.y - 1 ? finerSize.y : begin.y + 2);
    int level = finerColorLevel();
    ivec2 pixels = colorImageSize();
    ivec2 covered = ivec2(computeColorCellWidth(cell.x, size.x, level + 1, pixels.x),
                          computeColorCellWidth(cell.y, size.y, level + 1, pixels.y));
    vec4 sum = vec4(0.0);
    for (int y = begin.y; y < end.y; ++y) {
        float shareY = float(computeColorCellWidth(y, finerSize.y, level, pixels.y)) / float(covered.y);
        for (int x = begin.x; x < end.x; ++x) {
            float shareX = float(computeColorCellWidth(x, finerSize.x, level, pixels.x)) / float(covered.x);
            vec4 finer = fetchFinerColor(ivec2(x, y));
            float share = finer.w * (shareX * shareY);
            sum = sum + vec4(finer.xyz * share, share);
        }
    }
    bool isValid = sum.w > 0.0;
    return isValid ? vec4(sum.xyz / sum.w, min(sum.w, 1.0)) : vec4(0.0);
}
#endif

#endif
