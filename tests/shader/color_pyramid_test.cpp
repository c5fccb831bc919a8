#include "tests/shader/generators.h"

#include <map>

#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_REDUCE_COLOR_PYRAMID
#include "crossray/project/color_pyramid.glsl"
#include "crossray/project/reprojection.glsl"
#include "tests/shader/views.h"

struct ColorLevel {
    ivec2 size;
    std::vector<vec4> cells;
    vec4& at(ivec2 cell) { return cells.at(static_cast<size_t>(cell.y * size.x + cell.x)); }
};
static std::vector<ColorLevel> gLevels;
static int gFinerLevel = 0;

vec4 fetchColorPyramid(ivec2 cell, int level)
{
    return gLevels.at(static_cast<size_t>(level)).at(cell);
}
ivec2 colorPyramidSize(int level)
{
    return gLevels.at(static_cast<size_t>(level)).size;
}
vec4 fetchFinerColor(ivec2 cell)
{
    return fetchColorPyramid(cell, gFinerLevel);
}
ivec2 finerColorSize()
{
    return colorPyramidSize(gFinerLevel);
}
int finerColorLevel()
{
    return gFinerLevel;
}
ivec2 colorImageSize()
{
    return colorPyramidSize(0);
}

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

namespace {

void buildLevels(ivec2 size, const std::vector<vec3>& image)
{
    gLevels = {ColorLevel{size, {}}};
    for (const vec3& color : image)
        gLevels[0].cells.push_back(makeColorPyramidTexel(color));
    while (gLevels.back().size.x > 1 || gLevels.back().size.y > 1) {
        const ivec2 finer = gLevels.back().size;
        gFinerLevel = static_cast<int>(gLevels.size()) - 1;
        ColorLevel next{ivec2(std::max(finer.x / 2, 1), std::max(finer.y / 2, 1)), {}};
        for (int y = 0; y < next.size.y; ++y)
            for (int x = 0; x < next.size.x; ++x)
                next.cells.push_back(reduceColorPyramidCell(ivec2(x, y)));
        gLevels.push_back(std::move(next));
    }
}

int levelCount()
{
    return static_cast<int>(gLevels.size());
}

} // namespace

// Whatever the image's size, the last cell is the mean of its valid pixels.
RC_GTEST_PROP(ShaderColorPyramid, TheTopIsTheMeanOfWhatIsValid, ())
{
    const ivec2 size(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40));
    std::vector<vec3> image;
    double sum = 0;
    int valid = 0;
    for (int i = 0; i < size.x * size.y; ++i) {
        const int kind = *rc::gen::inRange(0, 12);
        const Real value = drawReal(0, 4);
        image.push_back(kind == 0   ? vec3(value, kNaN, value)
                        : kind == 1 ? vec3(value, value, kInfinity)
                        : kind == 2 ? vec3(Real(-0.5), value, value)
                                    : vec3(value, 2 * value, 0));
        if (kind > 2) {
            sum += static_cast<double>(value);
            ++valid;
        }
    }
    buildLevels(size, image);
    const vec4 top = gLevels.back().cells[0];
    const double mean = valid > 0 ? sum / valid : 0;
    RC_ASSERT(std::fabs(static_cast<double>(top.x) - mean) < static_cast<double>(kUlps) * 40);
    RC_ASSERT(std::fabs(static_cast<double>(top.y) - 2 * mean) < static_cast<double>(kUlps) * 80);
    RC_ASSERT(top.z == 0);
    RC_ASSERT(std::fabs(static_cast<double>(top.w) - static_cast<double>(valid) / (size.x * size.y)) <
              static_cast<double>(kUlps));
}

TEST(ShaderColorPyramid, SolidStaysSolidAndBrokenPixelsStayTheirOwn)
{
    const vec3 color(Real(0.3), Real(0.6), Real(0.1));
    for (const ivec2 size : {ivec2(16, 16), ivec2(13, 7), ivec2(1, 9)}) {
        std::vector<vec3> image(static_cast<size_t>(size.x * size.y), color);
        image[static_cast<size_t>(size.x * size.y / 2)] = vec3(kNaN, 1, 1);
        image[static_cast<size_t>(size.x * size.y / 3)] = vec3(1, -kInfinity, 1);
        buildLevels(size, image);
        int none = 0;
        for (Real level : {Real(0), Real(0.5), Real(1), Real(2.25), Real(99)}) {
            for (int i = 0; i < 200; ++i) {
                const vec2 uv(static_cast<Real>(i % 20) / 19, static_cast<Real>(i / 20) / 9);
                const ColorSample sample = sampleColorPyramid(uv, level, levelCount());
                if (!sample.isValid) {
                    EXPECT_EQ(sample.color.y, 0);
                    ++none;
                    continue;
                }
                EXPECT_NEAR(sample.color.x, color.x, kUlps);
                EXPECT_NEAR(sample.color.y, color.y, kUlps);
                EXPECT_NEAR(sample.color.z, color.z, kUlps);
            }
        }
        EXPECT_LT(none, 100); // only where nothing but a broken pixel counts
    }
}

TEST(ShaderColorPyramid, IsTrilinear)
{
    // A ramp along x: between the centres of the first and last cells it is the ramp itself, at levels 0 and 1 and
    // between.
    std::vector<vec3> image;
    for (int i = 0; i < 16 * 4; ++i)
        image.push_back(vec3((static_cast<Real>(i % 16) + Real(0.5)) / 16, 1, 0));
    buildLevels(ivec2(16, 4), image);
    for (Real u : {Real(0.1), Real(0.31), Real(0.5), Real(0.77)}) {
        for (Real level : {Real(0), Real(0.3), Real(1)})
            EXPECT_NEAR(sampleColorPyramid(vec2(u, Real(0.4)), level, levelCount()).color.x, u, kUlps) << level;
    }
    EXPECT_NEAR(sampleColorPyramid(vec2(Real(0.1), Real(0.5)), 99, levelCount()).color.x, Real(0.5), kUlps);
    EXPECT_NEAR(sampleColorPyramid(vec2(Real(0.1), Real(0.5)), 99, 1).color.x, Real(0.1), kUlps);
    EXPECT_NEAR(sampleColorPyramid(vec2(kNaN, Real(0.5)), kNaN, levelCount()).color.x, Real(1) / 32, kUlps);
}

TEST(ShaderColorPyramid, RoughnessChoosesTheLevel)
{
    EXPECT_EQ(computeReflectionColorLevel(0, 7), 0);
    EXPECT_EQ(computeReflectionColorLevel(1, 7), 6);
    EXPECT_EQ(computeReflectionColorLevel(2, 7), 6);
    EXPECT_EQ(computeReflectionColorLevel(kNaN, 7), 0);
    EXPECT_EQ(computeReflectionColorLevel(Real(0.5), 0), 0);
    EXPECT_NEAR(computeReflectionColorLevel(Real(0.5), 7), 6 * Real(0.574349177498517), 4 * kUlps);
    EXPECT_NEAR(computeRefractionColorLevel(Real(0.5), 7), 6 * Real(0.406126198178117), 4 * kUlps);
}

TEST(ShaderReprojection, BothWays)
{
    const View before = makeView(vec2(200, 100), Real(0.5), Real(0.1), 100, 1, false, vec3(1, 0, 0));
    // A point 4 m ahead of the previous eye, 1 m to its left: half the width less its share.
    const Reprojection byView = reprojectByView(before, vec3(0, 0, -4));
    EXPECT_NEAR(byView.positionUV.x, Real(0.5) - Real(0.5) / (4 * before.slope.x), kUlps);
    EXPECT_NEAR(byView.positionUV.y, Real(0.5), kUlps);
    EXPECT_TRUE(byView.isOnScreen);
    EXPECT_FALSE(reprojectByView(before, vec3(0, 0, 4)).isOnScreen);
    EXPECT_FALSE(reprojectByView(before, vec3(-40, 0, -4)).isOnScreen);
    EXPECT_FALSE(reprojectByView(before, vec3(kNaN, 0, -4)).isOnScreen);

    const Reprojection byMotion = reprojectByMotion(vec2(Real(0.25), Real(0.5)), vec2(Real(0.125), Real(-0.25)));
    EXPECT_EQ(byMotion.positionUV.x, Real(0.125));
    EXPECT_EQ(byMotion.positionUV.y, Real(0.75));
    EXPECT_TRUE(byMotion.isOnScreen);
    EXPECT_TRUE(reprojectByMotion(vec2(0, 1), vec2(0)).isOnScreen);
    EXPECT_FALSE(reprojectByMotion(vec2(0, 1), vec2(Real(0.01), 0)).isOnScreen);
    for (Real broken : {kNaN, kInfinity}) {
        const Reprojection none = reprojectByMotion(vec2(Real(0.5)), vec2(0, broken));
        EXPECT_FALSE(none.isOnScreen);
        EXPECT_EQ(none.positionUV.x, 0);
    }
}

RC_GTEST_PROP(ShaderColorPyramid, AnswersAnything, ())
{
    const ivec2 size(*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9));
    std::vector<vec3> image;
    for (int i = 0; i < size.x * size.y; ++i)
        image.push_back(drawHostileVector<vec3>());
    buildLevels(size, image);
    const ColorSample sample = sampleColorPyramid(vec2(drawHostile(), drawHostile()), drawHostile(), levelCount());
    RC_ASSERT(isFinite(sample.color));
    RC_ASSERT(sample.color.x >= 0 && sample.color.y >= 0 && sample.color.z >= 0);
    RC_ASSERT(sample.coverage >= 0 && sample.coverage <= 1);
    RC_ASSERT(
        isFinite(reprojectByMotion(vec2(drawHostile(), drawHostile()), vec2(drawHostile(), drawHostile())).positionUV));
}
