// The cubemap read by texel fetches: held to what filtering is for, whatever the folding: constants stay, texel centres
// are read exactly, and nothing jumps where a direction crosses an edge of the cube.
#include "tests/shader/generators.h"

#include <array>

#include "harness/backend/cpu/glsl.h"

#include "crossray/probe/cubemap_filter.glsl"

// Three cubemaps of 4 texels a side and 3 levels: a constant, one whose texels differ, and one with texels that no
// radiance should have.
int probeCubeSize(int)
{
    return 4;
}
int probeCubeLevelCount(int)
{
    return 3;
}
vec3 fetchProbeTexel(int cubemap, int face, ivec2 texel, int level)
{
    const int size = 4 >> level;
    if (face < 0 || face > 5 || texel.x < 0 || texel.y < 0 || texel.x >= size || texel.y >= size || level > 2) {
        ADD_FAILURE() << "outside: face " << face << " texel " << texel.x << "," << texel.y << " level " << level;
    }
    if (cubemap == 0) return vec3(Real(0.25), Real(0.5), 2);
    if (cubemap == 2) return vec3(kNaN, -1, kInfinity);
    const Real number = Real(((face * 7 + texel.y) * 11 + texel.x) % 17) / 17;
    return vec3(number, number * number, Real(level));
}

#include "harness/backend/cpu/glsl_end.h"

using namespace CROSSRAY_SHADER_NAMESPACE;

RC_GTEST_PROP(ShaderCubemapFilter, AConstantStays, ())
{
    const vec3 color = sampleProbeCubemap(0, drawUnitVector<vec3>(), drawReal(-1, 5));
    RC_ASSERT(std::abs(color.x - Real(0.25)) < kUlps && std::abs(color.y - Real(0.5)) < kUlps);
    RC_ASSERT(std::abs(color.z - 2) < 4 * kUlps);
}

TEST(ShaderCubemapFilter, TexelCentresAreReadExactly)
{
    for (int level = 0; level < 3; ++level) {
        const int size = 4 >> level;
        for (int texel = 0; texel < 6 * size * size; ++texel) {
            const int face = texel / (size * size), x = texel % size, y = texel / size % size;
            const vec2 uv((Real(x) + Real(0.5)) / Real(size), (Real(y) + Real(0.5)) / Real(size));
            const vec3 read = sampleProbeCubemap(1, directionFromCubePosition(face, uv), Real(level));
            const vec3 stored = fetchProbeTexel(1, face, ivec2(x, y), level);
            EXPECT_LT(length(read - stored), 4 * kUlps)
                << "level " << level << " face " << face << " " << x << "," << y;
        }
    }
}

// Two directions apart by a hundred-thousandth, on the two sides of an edge: no seam, up to the corners.
RC_GTEST_PROP(ShaderCubemapFilter, EdgesHaveNoSeam, ())
{
    const int axis = *rc::gen::inRange(0, 3);
    vec3 edge;
    edge[axis] = drawReal(Real(-0.9999), Real(0.9999));
    edge[(axis + 1) % 3] = *rc::gen::element(Real(-1), Real(1));
    edge[(axis + 2) % 3] = *rc::gen::element(Real(-1), Real(1));
    const Real level = drawReal(0, 1);
    vec3 here = edge, there = edge;
    here[(axis + 1) % 3] *= Real(1.00001);
    there[(axis + 2) % 3] *= Real(1.00001);
    const vec3 difference = sampleProbeCubemap(1, here, level) - sampleProbeCubemap(1, there, level);
    RC_ASSERT(length(difference) < Real(3e-4));
}

TEST(ShaderCubemapFilter, LevelsBlendInBetween)
{
    EXPECT_NEAR(sampleProbeCubemap(1, vec3(1, 0, 0), Real(0.25)).z, 0.25, kUlps);
    EXPECT_NEAR(sampleProbeCubemap(1, vec3(1, 0, 0), Real(1.5)).z, 1.5, kUlps);
    EXPECT_EQ(sampleProbeCubemap(1, vec3(1, 0, 0), 9).z, 2);
    EXPECT_EQ(sampleProbeCubemap(1, vec3(1, 0, 0), -9).z, 0);
    EXPECT_EQ(sampleProbeCubemap(1, vec3(1, 0, 0), kNaN).z, 0);
}

RC_GTEST_PROP(ShaderCubemapFilter, AnswersAnything, ())
{
    const vec3 dir = drawHostileVector<vec3>();
    const Real level = drawHostile();
    const vec3 color = sampleProbeCubemap(1, dir, level);
    RC_ASSERT(isFinite(color) && color.x >= 0 && color.x < 1 + kUlps && color.z >= 0 && color.z < 2 + kUlps);
    RC_ASSERT(sampleProbeCubemap(2, dir, level) == vec3(0));
}
