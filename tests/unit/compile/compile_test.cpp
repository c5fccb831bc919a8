#include "harness/compile/compile.h"

#include "harness/base/error.h"
#include "tests/unit/compile/shader_folder.h"
#include "tests/unit/count_of.h"

#include <gtest/gtest.h>

#include <thread>

using namespace crossray;

TEST(Compile, givesSpirvAndGlslWithTheBindingsOfTheSource)
{
    const ShaderFolder folder;
    folder.write("entry/a.comp", kVariantShader);
    ShaderCompiler compiler({});
    const CompiledShader shader = compiler.compile("entry/a.comp", folder.options());
    ASSERT_GT(shader.spirv.size(), 5u);
    EXPECT_EQ(shader.spirv[1], 0x00010300u); // SPIR-V 1.3
    EXPECT_EQ(shader.localSize, (std::array<uint32_t, 3>{8, 4, 1}));
    EXPECT_EQ(shader.glsl.substr(0, 12), "#version 450");
    EXPECT_NE(shader.glsl.find("layout(binding = 2, std140) uniform Params"), std::string::npos) << shader.glsl;
    EXPECT_NE(shader.glsl.find("layout(binding = 3, std430)"), std::string::npos) << shader.glsl;
    EXPECT_EQ(shader.glsl.find("constant_id"), std::string::npos) << shader.glsl;
    EXPECT_EQ(shader.key.size(), 32u);
    EXPECT_FALSE(shader.fromCache);
    EXPECT_EQ(shader.closure, std::vector<std::filesystem::path>{folder.options().includeRoot / "entry/a.comp"});
}

TEST(Compile, variantsDropWhatTheyDoNotUse)
{
    const ShaderFolder folder;
    folder.write("a.comp", kVariantShader);
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    const auto count = [&](std::map<std::string, double> specialization) {
        options.specialization = std::move(specialization);
        return ShaderCompiler::countInstructions(compiler.compile("a.comp", options).spirv);
    };
    const size_t full = count({{"kMode", 1}});
    const size_t plain = count({});
    const size_t fast = count({{"kFast", 1}});
    EXPECT_GT(full, plain + 10);
    EXPECT_GT(plain, fast);
    options.specialization = {{"kMode", 1}};
    EXPECT_NE(compiler.compile("a.comp", options).glsl.find("layout(binding = 5) uniform sampler2D sourceImage"),
              std::string::npos);
    options.specialization = {{"kMode", 0}};
    EXPECT_EQ(compiler.compile("a.comp", options).glsl.find("sourceImage"), std::string::npos);
}

TEST(Compile, theOptimiserRoundsAsTheSourceSays)
{
    const ShaderFolder folder;
    folder.write("a.comp",
                 "#version 450\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer B { float a[]; };\n"
                 "float scaled(float x) { return x * 3.0; }\n"
                 "void main() { a[0] = a[1] * a[2] + a[3]; a[4] = scaled(a[5] * 7.0); a[6] = (a[7] + 0.1) + 0.2; }\n");
    ShaderCompiler compiler({});
    const CompiledShader shader = compiler.compile("a.comp", folder.options());
    EXPECT_EQ(shader.glsl.find("fma"), std::string::npos) << shader.glsl;
    EXPECT_EQ(shader.glsl.find("21.0"), std::string::npos) << shader.glsl;
    EXPECT_EQ(shader.glsl.find("0.3"), std::string::npos) << shader.glsl;
    EXPECT_EQ(shader.glsl.find("precise"), std::string::npos) << shader.glsl; // for the optimiser alone
    EXPECT_EQ(compiler.disassemble(shader.spirv).find("NoContraction"), std::string::npos);
}

TEST(Compile, specializationValuesReachTheCode)
{
    const ShaderFolder folder;
    folder.write("a.comp", kVariantShader);
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    options.specialization = {{"kScale", 3.25}};
    EXPECT_NE(compiler.compile("a.comp", options).glsl.find("3.25"), std::string::npos);
    options.optimize = false;
    const CompiledShader plain = compiler.compile("a.comp", options);
    EXPECT_NE(plain.glsl.find("3.25"), std::string::npos);
    EXPECT_EQ(compiler.disassemble(plain.spirv).find("OpSpecConstant"), std::string::npos);
}

TEST(Compile, unknownAndUnfitSpecializationIsAnInputError)
{
    const ShaderFolder folder;
    folder.write("a.comp", kVariantShader);
    folder.write("none.comp", "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    options.specialization = {{"kMood", 1}};
    EXPECT_THROW(compiler.compile("a.comp", options), InputError);
    EXPECT_EQ(errorOf(compiler, "a.comp", options),
              "unknown specialization constant \"kMood\"; the shader has kFast, kMode, kScale");
    EXPECT_EQ(errorOf(compiler, "none.comp", options),
              "unknown specialization constant \"kMood\"; the shader has none");
    options.specialization = {{"kMode", 0.5}};
    EXPECT_EQ(errorOf(compiler, "a.comp", options),
              "specialization constant kMode = 0.5: allowed is a whole number of 32 bits");
    options.specialization = {{"kFast", 2}};
    EXPECT_EQ(errorOf(compiler, "a.comp", options), "specialization constant kFast = 2: allowed is 0 or 1");
}

TEST(Compile, listsSpecializationWithDefaultsEvenWhenUnused)
{
    const ShaderFolder folder;
    folder.write("a.comp", "#version 450\nlayout(local_size_x = 1) in;\n"
                           "layout(constant_id = 4) const uint kUnused = 9u;\n"
                           "layout(constant_id = 5) const bool kFlag = true;\n"
                           "layout(constant_id = 6) const float kFloat = -0.5;\n"
                           "layout(constant_id = 8) const int kInt = -3;\nvoid main() {}\n");
    ShaderCompiler compiler({});
    EXPECT_EQ(compiler.listSpecialization("a.comp", folder.options()),
              (std::map<std::string, double>{{"kFlag", 1}, {"kFloat", -0.5}, {"kInt", -3}, {"kUnused", 9}}));
}

TEST(Compile, localSizeMayHangOnSpecialization)
{
    const ShaderFolder folder;
    folder.write("a.comp", "#version 450\nlayout(local_size_x_id = 0, local_size_y = 2) in;\n"
                           "layout(constant_id = 0) const int kWidth = 4;\n"
                           "layout(binding = 0) buffer B { uint a[]; };\n"
                           "void main() { a[gl_LocalInvocationIndex] = gl_WorkGroupSize.x; }\n");
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    // A size by id is 1 until it is set, whatever the constant of the same id defaults to.
    EXPECT_EQ(compiler.compile("a.comp", options).localSize, (std::array<uint32_t, 3>{1, 2, 1}));
    options.specialization = {{"kWidth", 16}};
    const CompiledShader shader = compiler.compile("a.comp", options);
    EXPECT_EQ(shader.localSize, (std::array<uint32_t, 3>{16, 2, 1}));
    EXPECT_NE(shader.glsl.find("local_size_x = 16"), std::string::npos) << shader.glsl;
}

TEST(Compile, translatesToEveryTarget)
{
    const ShaderFolder folder;
    folder.write("a.comp", kVariantShader);
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    options.debugInfo = true;
    options.specialization = {{"kMode", 1}};
    const std::vector<uint32_t> spirv = compiler.compile("a.comp", options).spirv;
    const auto text = [&](const char* target) { return compiler.translate(spirv, *findCompileTarget(target)); };
    EXPECT_NE(text("spirv").find("OpEntryPoint GLCompute %main \"main\""), std::string::npos);
    EXPECT_NE(text("glsl").find("#version 450"), std::string::npos);
    EXPECT_EQ(text("glsl").find("#line"), std::string::npos);
    EXPECT_NE(text("essl").find("#version 310 es"), std::string::npos);
    EXPECT_NE(text("essl").find("binding = 5"), std::string::npos);
    EXPECT_NE(text("hlsl").find("register(u3, space0)"), std::string::npos) << text("hlsl");
    EXPECT_NE(text("hlsl").find("register(t5, space0)"), std::string::npos);
    EXPECT_NE(text("hlsl").find("[numthreads(8, 4, 1)]"), std::string::npos);
    EXPECT_NE(text("msl").find("[[buffer(3)]]"), std::string::npos) << text("msl");
    EXPECT_NE(text("msl").find("kernel void main0"), std::string::npos);
    EXPECT_FALSE(findCompileTarget("wgsl").has_value());
}

TEST(Compile, debugInfoKeepsLinesAndTheReleaseHasNone)
{
    const ShaderFolder folder;
    folder.write("a.comp", kVariantShader);
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    const CompiledShader release = compiler.compile("a.comp", options);
    EXPECT_EQ(countOf(compiler.disassemble(release.spirv), "OpName"), 0u);
    EXPECT_EQ(release.glsl.find("#line"), std::string::npos);
    options.debugInfo = true;
    const CompiledShader debug = compiler.compile("a.comp", options);
    EXPECT_GT(countOf(compiler.disassemble(debug.spirv), "OpName"), 3u);
    EXPECT_NE(debug.glsl.find("#line 23 \"a.comp\""), std::string::npos) << debug.glsl;
}

TEST(Compile, resolvesFilesBelowTheRootAndAnywhereElse)
{
    const ShaderFolder folder;
    folder.write("lib/one.glsl", "float one() { return 1.0; }\n");
    const std::string source = "#version 450\n#include \"lib/one.glsl\"\nlayout(local_size_x = 1) in;\n"
                               "layout(binding = 0) buffer B { float a[]; };\nvoid main() { a[0] = one(); }\n";
    folder.write("entry/a.comp", source);
    const std::filesystem::path outside = folder.write("../elsewhere/b.comp", source);
    ShaderCompiler compiler({});
    const CompiledShader inside = compiler.compile("entry/a.comp", folder.options());
    EXPECT_EQ(inside.closure.size(), 2u);
    EXPECT_EQ(inside.closure[1], folder.options().includeRoot / "lib/one.glsl");
    EXPECT_EQ(compiler.compile(outside, folder.options()).spirv, inside.spirv);
    EXPECT_EQ(compiler.compile(folder.options().includeRoot / "entry/a.comp", folder.options()).key, inside.key);
}

TEST(Compile, namesItsCompilers)
{
    const std::map<std::string, std::string> versions = ShaderCompiler::versions();
    ASSERT_EQ(versions.size(), 3u);
    for (const auto& [name, version] : versions)
        EXPECT_NE(version.find('.'), std::string::npos) << name;
}

TEST(Compile, worksFromFourThreads)
{
    const ShaderFolder folder;
    folder.write("a.comp", kVariantShader);
    folder.write("bad.comp", "#version 450\nvoid main() { x = 1; }\n");
    ShaderCompiler compiler(folder.cache());
    ShaderCompiler reference({});
    std::vector<CompiledShader> expected;
    for (int i = 0; i < 8; ++i) {
        CompileOptions options = folder.options();
        options.specialization = {{"kScale", i}, {"kMode", i % 2}};
        expected.push_back(reference.compile("a.comp", options));
    }
    std::vector<std::thread> threads;
    std::atomic<int> wrong{0};
    for (int thread = 0; thread < 4; ++thread) {
        threads.emplace_back([&, thread] {
            for (int turn = 0; turn < 16; ++turn) {
                const int i = (turn + thread) % 8;
                CompileOptions options = folder.options();
                options.specialization = {{"kScale", i}, {"kMode", i % 2}};
                const CompiledShader shader = compiler.compile("a.comp", options);
                const CompiledShader& right = expected[static_cast<size_t>(i)];
                if (shader.spirv != right.spirv || shader.glsl != right.glsl || shader.key != right.key) ++wrong;
                if (errorOf(compiler, "bad.comp", folder.options()).find(":2:15: error: 'x'") == std::string::npos)
                    ++wrong;
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(wrong, 0);
}
