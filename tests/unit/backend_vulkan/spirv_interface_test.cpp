#include "harness/backend/vulkan/spirv_interface.h"

#include "harness/backend/vulkan/context.h"
#include "harness/base/error.h"
#include "tests/unit/backend_vulkan/vulkan_fixture.h"

#include <rapidcheck/gtest.h>

using namespace crossray;
using namespace crossray::test;
using namespace crossray::vulkan;

namespace {

SpirvInterface readGlsl(const std::string& glsl)
{
    return readSpirvInterface(compileGlsl("#version 450\n" + glsl));
}

void expectRefused(const std::string& glsl, const std::string& word)
{
    try {
        readGlsl(glsl);
        FAIL() << "accepted";
    } catch (const ShaderError& error) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

constexpr const char* kAllKinds = R"(
layout(local_size_x = 4, local_size_y = 2, local_size_z = 3) in;
layout(binding = 9) buffer Out { float values[]; };
layout(binding = 2) uniform sampler2D image;
layout(binding = 5) uniform Params { vec4 a; } params;
layout(binding = 6) uniform Unused { vec4 b; } unused;
shared float scratch[10];
vec4 look(sampler2D which) { return texelFetch(which, ivec2(0), 0); }
void main() { scratch[0] = look(image).x; values[values.length() - 1] = params.a.x + scratch[0]; }
)";

} // namespace

TEST(SpirvInterface, listsTheBindingsInUseByKind)
{
    const SpirvInterface interface = readGlsl(kAllKinds);
    ASSERT_EQ(interface.bindings.size(), 3u);
    EXPECT_EQ(interface.bindings[0].binding, 2u);
    EXPECT_EQ(interface.bindings[0].kind, DescriptorKind::kSampledImage);
    EXPECT_EQ(interface.bindings[0].name, "image");
    EXPECT_EQ(interface.bindings[1].binding, 5u);
    EXPECT_EQ(interface.bindings[1].kind, DescriptorKind::kUniformBuffer);
    EXPECT_EQ(interface.bindings[1].name, "params");
    EXPECT_EQ(interface.bindings[2].binding, 9u);
    EXPECT_EQ(interface.bindings[2].kind, DescriptorKind::kStorageBuffer);
    EXPECT_EQ(interface.bindings[2].name, "Out");
    EXPECT_EQ(interface.localSize, (std::array<uint32_t, 3>{4, 2, 3}));
    EXPECT_EQ(interface.sharedBytes, 40u);
}

TEST(SpirvInterface, readsAGroupSizeFromConstants)
{
    const SpirvInterface interface = readGlsl("layout(local_size_x_id = 1, local_size_y = 3) in; void main() {}");
    EXPECT_EQ(interface.localSize, (std::array<uint32_t, 3>{1, 3, 1}));
}

// std140 by hand: a matrix takes a vec4 a column, an array element a multiple of 16 bytes, a vec3 leaves room for one
// float.
TEST(SpirvInterface, measuresUniformBlocks)
{
    const auto measure = [](const std::string& members, const std::string& use) {
        const SpirvInterface interface = readGlsl("struct Inner { vec3 p; float q; mat3 m; };"
                                                  "layout(binding = 0) buffer Out { float result; };"
                                                  "layout(binding = 1) uniform Block { " +
                                                  members + " } block; void main() { result = float(" + use + "); }");
        return interface.bindings.at(1).bytes;
    };
    EXPECT_EQ(measure("float a;", "block.a"), 4u);
    EXPECT_EQ(measure("vec3 a; float b;", "block.b"), 16u);
    EXPECT_EQ(measure("float a; mat4 b; int c;", "block.c"), 84u);
    EXPECT_EQ(measure("layout(row_major) mat2x4 a;", "block.a[0].x"), 64u);
    EXPECT_EQ(measure("float a[5];", "block.a[1]"), 80u);
    EXPECT_EQ(measure("int n; Inner inner[3]; vec2 last;", "block.n"), 16u + 3 * 64u + 8u);
}

TEST(SpirvInterface, refusesWhatTheDevicesDoNotOffer)
{
    expectRefused(
        "layout(push_constant) uniform P { int i; }; layout(binding = 0) buffer O { int v; }; void main() { v = i; }",
        "push constant");
    expectRefused("layout(set = 1, binding = 0) buffer O { int v; }; void main() { v = 1; }", "descriptor set 1");
    expectRefused(
        "layout(binding = 0) buffer O { int v; }; layout(binding = 0) buffer Q { int w; }; void main() { v = w; }",
        "both at binding 0");
    expectRefused("layout(binding = 1) uniform sampler2D many[2]; layout(binding = 0) buffer O { float v; };"
                  "void main() { v = texelFetch(many[1], ivec2(0), 0).x; }",
                  "\"many\" is an array");
    expectRefused("layout(binding = 1) uniform sampler3D cube; layout(binding = 0) buffer O { float v; };"
                  "void main() { v = texelFetch(cube, ivec3(0), 0).x; }",
                  "other than sampler2D");
    expectRefused(
        "layout(binding = 1, r32f) uniform image2D store; void main() { imageStore(store, ivec2(0), vec4(1)); }",
        "neither");
}

TEST(SpirvInterface, codeThatIsCutOffIsRefused)
{
    std::vector<uint32_t> words = compileGlsl(std::string("#version 450\n") + kAllKinds);
    EXPECT_THROW(readSpirvInterface({}), ShaderError);
    EXPECT_THROW(readSpirvInterface(std::span(words).first(5)), ShaderError); // a header alone has no entry point
    words.back() = 0;
    EXPECT_THROW(readSpirvInterface(words), ShaderError);
}

// Whatever a word is changed to, reading ends with a description or a ShaderError.
RC_GTEST_PROP(SpirvInterface, damagedCodeNeverCrashes, ())
{
    static const std::vector<uint32_t> kGood = compileGlsl(std::string("#version 450\n") + kAllKinds);
    std::vector<uint32_t> words = kGood;
    const int changes = *rc::gen::inRange(1, 5);
    for (int i = 0; i < changes; ++i)
        words[*rc::gen::inRange<size_t>(0, words.size())] =
            *rc::gen::oneOf(rc::gen::arbitrary<uint32_t>(), rc::gen::inRange<uint32_t>(0, 100));
    try {
        readSpirvInterface(words);
    } catch (const ShaderError&) {
    }
}

TEST(Context, readsTheLlvmVersionFromTheDevicesName)
{
    EXPECT_EQ(parseLlvmVersion("llvmpipe (LLVM 15.0.6, 256 bits)"), "15.0.6");
    EXPECT_EQ(parseLlvmVersion("SwiftShader Device (LLVM 10.0.0)"), "10.0.0");
    EXPECT_EQ(parseLlvmVersion("LLVM 17"), "17");
    EXPECT_EQ(parseLlvmVersion("Some GPU"), "");
}
