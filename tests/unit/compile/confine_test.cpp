// A person's own tracer: what it may reach, how its loops are gated, and what is said when it is wrong.
#include "harness/compile/confine.h"

#include "harness/compile/frontend.h"
#include "harness/compile/spirv_module.h"
#include "tests/unit/compile/shader_folder.h"

#include <gtest/gtest.h>
#include <spirv_cross/spirv.hpp>

#include <map>

using namespace crossray;

namespace {

const std::filesystem::path kShaders = std::filesystem::path(CROSSRAY_SOURCE_DIR) / "shaders";
constexpr const char* kEnd = "return ownEnd(kHitReasonSky, vec2(0.0)); }\n";

class OwnTracer : public testing::Test {
  protected:
    // Compiled by the pass itself; the tracer's first line stands before `body`.
    std::string errorOfBody(const std::string& body) { return errorOfFile("OwnHit traceOwn(OwnRay ray) {\n" + body); }
    std::string errorOfFile(const std::string& text) { return errorOf(compiler, "entry/own_trace.comp", write(text)); }
    CompileOptions write(const std::string& text)
    {
        CompileOptions options;
        options.includeRoot = kShaders;
        options.ownTracer = folder.write("mine.glsl", text);
        options.specialization = {{"kProjectionModel", 8}};
        return options;
    }
    std::string file() const { return (folder.root() / "shaders/mine.glsl").string(); }

    ShaderFolder folder;
    ShaderCompiler compiler{{}};
};

} // namespace

TEST_F(OwnTracer, mayUseTheInterfaceAndPureCode)
{
    EXPECT_EQ(errorOfBody("float x = ownLinearDepth(ray.pixel) + saturate(2.0) + ownPathDepth(ownPath(ray), 0.5);\n"
                          "return ownHit(vec2(x), x + ownNormalWS(ray.pixel).x + ownDepthRange(ivec2(0), 1).y); }\n"),
              "no error");
}

TEST_F(OwnTracer, reachesNoResourcePastTheInterface)
{
    const std::map<std::string, std::string> bodies{
        {"float x = fetchDeviceDepth(ray.pixel);\n", "deviceDepthImage"},
        {"float x = params.tracing.x;\n", "PassParamsBlock"},
        {"fetchCount = 0;\n", "fetchCount"},
        {"ownRounds = 0;\n", "ownRounds"},
        {"storeOutputValue(0, vec4(1.0));\n", ""},
        {"View view = loadView();\n", ""},
        {"vec2 x = texelFetch(normalImage, ray.pixel, 0).xy;\n", "normalImage"},
    };
    for (const auto& [body, name] : bodies) {
        const std::string error = errorOfBody(body + kEnd);
        EXPECT_TRUE(error.starts_with(file() + ":2: error: reaches '" + name)) << body << error;
        EXPECT_NE(error.find("past the interface"), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST_F(OwnTracer, namesItsOwnLineHoweverFarItReaches)
{
    const std::string text = "float depthAt(ivec2 pixel)\n{\n    return traceHiz(loadView(), vec3(0.0), vec3(1.0), "
                             "HizSettings(0, 1, 2, 0.1)).linearDepth;\n}\nOwnHit traceOwn(OwnRay ray) {\n"
                             "float x = depthAt(ray.pixel);\n";
    EXPECT_TRUE(errorOfFile(text + kEnd).starts_with(file() + ":3: error: reaches '")) << errorOfFile(text + kEnd);
    // First values of global variables are code, too.
    const std::string global = "float x = fetchLinearDepth(ivec2(0));\nOwnHit traceOwn(OwnRay ray) {\n";
    EXPECT_TRUE(errorOfFile(global + kEnd).starts_with(file() + ":1: error: reaches '")) << errorOfFile(global + kEnd);
    const std::string own = "layout(binding = 1) uniform sampler2D mine;\nOwnHit traceOwn(OwnRay ray) {\n"
                            "vec2 x = texelFetch(mine, ray.pixel, 0).xy;\n";
    EXPECT_TRUE(errorOfFile(own + kEnd).starts_with(file() + ":3: error: reaches 'mine'")) << errorOfFile(own + kEnd);
}

TEST_F(OwnTracer, whatIsWrongIsSaidOfItsOwnFile)
{
    EXPECT_EQ(errorOfFile(""), file() + ": error: it does not define OwnHit traceOwn(OwnRay ray)");
    EXPECT_EQ(errorOfBody("    float x = ;\n"), file() + ":2:15: error: syntax error, unexpected ';'");
    EXPECT_EQ(errorOfBody("    return nothing; }\n"), file() + ":2:12: error: 'nothing': undeclared identifier");
    EXPECT_EQ(errorOfFile(std::string("float saturate(float x) { return x; }\nOwnHit traceOwn(OwnRay ray) {\n") + kEnd),
              file() + ":1:7: error: 'saturate': function already has a body");
    EXPECT_EQ(errorOfBody(std::string("#line 7\n") + kEnd), file() + ":2:1: error: #line is not allowed in a tracer");
    const std::string open = errorOfBody("return ownEnd(kHitReasonSky, vec2(0.0));\n");
    EXPECT_TRUE(open.starts_with(file() + ": error: the harness's own code does not compile with it: ")) << open;
    CompileOptions missing = write("");
    missing.ownTracer = folder.root() / "none.glsl";
    EXPECT_NE(errorOf(compiler, "entry/own_trace.comp", missing).find("none.glsl: cannot read"), std::string::npos);
}

// The gate's comparison is the only one with the bound.
TEST_F(OwnTracer, eachOfItsLoopsHasOneGate)
{
    const std::string text = "int count(int n) { int k = 0; while (k < n) ++k; return k; }\n"
                             "OwnHit traceOwn(OwnRay ray) {\n"
                             "for (;;) { if (count(3) > 2) break; }\n"
                             "int k = 0; do { ++k; if (k == 2) continue; } while (k < 4);\n"
                             "for (int i = 0; i < 3 && k > 0; ++i) { if (i == 1) continue; }\n";
    const CompileOptions options = write(text + kEnd);
    const FrontendResult parsed =
        parseShader(locateShader("entry/own_trace.comp", kShaders), kShaders, true, options.ownTracer);
    const auto countGates = [](const std::vector<uint32_t>& spirv) {
        uint32_t bound = 0;
        int gates = 0;
        forEachSpirvInstruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> operands) {
            if (opcode == spv::OpConstant && operands.size() == 3 && operands[2] == kMostOwnRounds) bound = operands[1];
            if (opcode == spv::OpSLessThan && bound != 0 && operands[3] == bound) ++gates;
        });
        return gates;
    };
    EXPECT_EQ(countGates(parsed.spirv), 0);
    EXPECT_EQ(countGates(confineOwnTracer(parsed.spirv, "mine.glsl")), 4);
    EXPECT_EQ(errorOf(compiler, "entry/own_trace.comp", options), "no error"); // valid, and translated
}

TEST_F(OwnTracer, cacheKnowsTheFileByItsContent)
{
    ShaderFolder cache;
    const auto compileAnew = [&](const CompileOptions& options) {
        return ShaderCompiler(cache.cache()).compile("entry/own_trace.comp", options);
    };
    const std::string head = "OwnHit traceOwn(OwnRay ray) { float x = ";
    const CompiledShader first = compileAnew(write(head + "1.0;" + kEnd));
    EXPECT_FALSE(first.fromCache);
    EXPECT_TRUE(compileAnew(write(head + "1.0;" + kEnd)).fromCache);
    const CompiledShader changed =
        compileAnew(write(head + "2.0; if (x > ray.dirWS.x) return ownHit(vec2(x), x);" + kEnd));
    EXPECT_FALSE(changed.fromCache);
    EXPECT_NE(changed.key, first.key);
    CompileOptions moved = write(head + "1.0;" + kEnd);
    moved.ownTracer = folder.write("elsewhere.glsl", head + "1.0;" + kEnd);
    EXPECT_EQ(compileAnew(moved).key, first.key); // the same program, wherever it lies
}
