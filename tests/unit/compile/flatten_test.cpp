#include "harness/compile/flatten.h"

#include "harness/base/error.h"
#include "harness/compile/optimize.h"
#include "harness/compile/spirv_function.h"
#include "tests/unit/compile/shader_folder.h"

#include <gtest/gtest.h>

using namespace crossray;

namespace {

class Flatten : public testing::Test {
  protected:
    // SPIR-V of a main() with `a`, the storage, `x`, a number of it, and the uniforms `u`, after the optimiser.
    std::vector<uint32_t> compileBody(const std::string& body)
    {
        folder.write("a.comp",
                     "#version 450\nlayout(local_size_x = 8) in;\nlayout(binding = 0) buffer B { float a[]; };\n"
                     "layout(binding = 1) uniform U { vec4 u; };\nlayout(binding = 2) uniform sampler2D t;\n"
                     "void main() { uint i = gl_GlobalInvocationID.x; float x = a[i];\n" +
                         body + "\na[i] = x; }\n");
        return compiler.compile("a.comp", folder.options()).spirv;
    }
    size_t branchesOf(const std::string& body) { return countBranches(compileBody(body)); }
    ShaderFolder folder;
    ShaderCompiler compiler{{}};
};

} // namespace

TEST_F(Flatten, cheapBranchesBecomeSelects)
{
    EXPECT_EQ(branchesOf("x = x > 1.0 ? x * 2.0 : sin(x);"), 0u);
    EXPECT_EQ(branchesOf("if (x > 1.0) x += 1.0;"), 0u);
    EXPECT_EQ(branchesOf("if (x > 1.0) { x += 1.0; } else { x = u.x / x; }"), 0u);
    EXPECT_EQ(branchesOf("if (x > 1.0 && x < 3.0 || x == 5.0) x = 2.0;"), 0u);
    EXPECT_EQ(branchesOf("vec3 v = vec3(x); v = x > 1.0 ? v * 2.0 : vec3(u.y); x = v.x + v.y;"), 0u);
}

TEST_F(Flatten, nestedBranchesBecomeSelectsFromTheInside)
{
    EXPECT_EQ(
        branchesOf("if (x > 1.0) { x = x > 2.0 ? x : -x; if (x < 0.0) x = 1.0; } else { x = x < -1.0 ? 0.5 : 0.25; }"),
        0u);
}

TEST_F(Flatten, whatMayTrapWriteReadOrTakeLongStays)
{
    EXPECT_GE(branchesOf("int k = int(x); if (k != 0) x = float(7 / k);"), 1u);
    EXPECT_GE(branchesOf("if (x > 1.0) a[i + 1u] = 2.0;"), 1u);
    EXPECT_GE(branchesOf("if (x > 1.0) x = a[i + 1u];"), 1u);
    EXPECT_GE(branchesOf("if (x > 1.0) x = texelFetch(t, ivec2(x), 0).x;"), 1u);
    EXPECT_GE(branchesOf("if (x > 1.0) for (int k = 0; k < int(x); ++k) x = x * 0.5;"), 1u);
    std::string much;
    for (int k = 0; k < 60; ++k)
        much += "x = sin(x);";
    EXPECT_EQ(branchesOf("if (x > 1.0) {" + much + "}"), 1u);
}

TEST_F(Flatten, loopsKeepTheirControl)
{
    const std::vector<uint32_t> spirv =
        compileBody("for (int k = 0; k < int(u.x); ++k) { if (x > 9.0) break; if (x > float(k)) x += 1.0;"
                    " x = x < 2.0 ? x * 3.0 : x; if (x == 4.0) continue; x -= 0.5; }");
    EXPECT_GE(countBranches(spirv), 2u); // the loop's end and its break
    EXPECT_LE(countBranches(spirv), 3u);
    EXPECT_NO_THROW(validate(spirv));
}

TEST_F(Flatten, manyBranchesInALoopAllGo)
{
    std::string body = "for (int k = 0; k < int(u.x); ++k) {";
    for (int i = 0; i < 40; ++i)
        body += "if (x > " + std::to_string(i) + ".0) { x = x * 1.5; } else { x = x - 1.0; }\n";
    EXPECT_EQ(branchesOf(body + "}"), 1u);
}

TEST_F(Flatten, aModuleSurvivesReadingAndWriting)
{
    const std::vector<uint32_t> spirv = compileBody("for (int k = 0; k < 9; ++k) if (x > 1.0) a[k] = x;");
    EXPECT_EQ(writeSpirvModule(readSpirvModule(spirv)), spirv);
    EXPECT_THROW(readSpirvModule({1, 2, 3}), ShaderError);
    std::vector<uint32_t> truncated = spirv;
    truncated.pop_back();
    EXPECT_THROW(readSpirvModule(truncated), ShaderError);
}
