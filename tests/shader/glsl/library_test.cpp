// The shader library as GLSL: each file compiles alone, keeps to the rules of shaders/README.md, and costs nothing for
// the hooks that a release leaves empty.
#include "harness/base/temporary_folder.h"
#include "harness/base/error.h"
#include "harness/compile/compile.h"
#include "tests/shader/glsl/glsl_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <unistd.h>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

// Bodies for every hook of the tracers, on a texture; recordHizStep is left to the caller.
constexpr const char* kTracerHooks = R"(
layout(binding = 0) uniform sampler2D pyramid;
vec2 fetchDepthPyramid(ivec2 cell, int level) { return texelFetch(pyramid, cell, level).xy; }
ivec2 depthPyramidSize(int level) { return textureSize(pyramid, level); }
int depthPyramidLevelCount() { return textureQueryLevels(pyramid); }
)";

std::vector<fs::path> libraryFiles()
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(kShaders / "crossray")) {
        if (entry.path().extension() == ".glsl") files.push_back(fs::relative(entry.path(), kShaders));
    }
    std::sort(files.begin(), files.end());
    return files;
}

// Code without comments, so that prose does not count.
std::string stripComments(const std::string& text)
{
    return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

class ShaderLibrary : public testing::Test {
  protected:
    CompiledShader compile(const std::string& text, const fs::path& root = kShaders)
    {
        const fs::path file = folder_ / "wrapper.comp";
        std::ofstream(file) << "#version 450\n" << text;
        CompileOptions options;
        options.includeRoot = root;
        return compiler_.compile(file, options);
    }
    CompiledShader compileTracer(const std::string& recordHook, const fs::path& root = kShaders)
    {
        return compile("#include \"crossray/project/hiz.glsl\"\n" + std::string(kTracerHooks) + recordHook +
                           "layout(local_size_x = 1) in;\n"
                           "layout(binding = 1) uniform P { View view; vec4 originWS; vec4 dirWS; ivec4 levels; };\n"
                           "layout(binding = 2) buffer O { float hit[]; };\n"
                           "void main() {\n"
                           "  HizSettings settings = HizSettings(levels.x, levels.y, levels.z, dirWS.w);\n"
                           "  TraceResult r = traceHiz(view, originWS.xyz, dirWS.xyz, settings);\n"
                           "  hit[0] = r.linearDepth + r.positionSS.x + float(r.hitClass + r.reason);\n}\n",
                       root);
    }

    TemporaryFolder temporary_{"library"};
    const fs::path folder_ = temporary_.path();
    ShaderCompiler compiler_{fs::path()};
};

} // namespace

TEST_F(ShaderLibrary, EachFileCompilesAlone)
{
    const std::vector<fs::path> files = libraryFiles();
    ASSERT_GE(files.size(), 10u);
    for (const fs::path& file : files) {
        const std::string include = "#include \"" + file.generic_string() + "\"\n";
        // Twice: the guard holds.
        EXPECT_NO_THROW(compile(include + include + "layout(local_size_x = 1) in;\nvoid main() {}\n")) << file;
    }
}

TEST_F(ShaderLibrary, AMissingHookIsACompileError)
{
    EXPECT_THROW(compileTracer(""), ShaderError);
}

TEST_F(ShaderLibrary, AnEmptyRecordCostsNoInstruction)
{
    // The same library with the call taken out.
    const fs::path copy = folder_ / "shaders";
    fs::create_directories(copy);
    fs::copy(kShaders / "crossray", copy / "crossray", fs::copy_options::recursive);
    const fs::path hiz = copy / "crossray/project/hiz.glsl";
    const std::string text = readSource(hiz);
    const std::string without = std::regex_replace(text, std::regex("\n +recordHizStep\\([^;]*\\);"), "\n");
    ASSERT_NE(text, without);
    std::ofstream(hiz) << without;

    const std::string empty = "void recordHizStep(HizStep step) {}\n";
    const std::string store = "layout(binding = 3) buffer R { float record[]; };\n"
                              "void recordHizStep(HizStep step) { record[step.iteration] = step.rayLinearDepth; }\n";
    const size_t recording = ShaderCompiler::countInstructions(compileTracer(store).spirv);
    const size_t release = ShaderCompiler::countInstructions(compileTracer(empty).spirv);
    const size_t stripped = ShaderCompiler::countInstructions(compileTracer(empty, copy).spirv);
    EXPECT_EQ(release, stripped);
    EXPECT_GT(recording, release);
}

TEST_F(ShaderLibrary, KeepsToItsRules)
{
    const std::vector<std::pair<std::regex, std::string>> forbidden{
        {std::regex("#pragma once"), "glslang has no #pragma once: use #ifndef guards"},
        {std::regex("[(,]\\s*(out|inout)\\s"), "functions return structs"},
        {std::regex("\\.[xyzwrgba]{2,4}\\s*[-+*/]?=[^=]"), "no swizzle is written"},
        {std::regex("[0-9.][fF]\\b"), "no f suffix: in double it would be a float"},
        {std::regex("\\bdiscard\\b|\\bgl_|\\blayout\\b|\\bsampler|\\bimage2D|\\bshared\\s"),
         "no resource, no built-in variable"},
        {std::regex("#version|#extension"), "entry shaders set versions and extensions"},
    };
    for (const fs::path& file : libraryFiles()) {
        const std::string text = readSource(kShaders / file);
        EXPECT_TRUE(text.starts_with("// ")) << file << " opens with what it computes";
        if (file.parent_path().filename() != "shared") { // no algorithms there
            EXPECT_NE(text.find("\n// Hooks"), std::string::npos) << file << " names its hooks";
            EXPECT_NE(text.find("Source: "), std::string::npos) << file << " names its source";
        }
        std::string guard = file.generic_string();
        std::transform(guard.begin(), guard.end(), guard.begin(),
                       [](unsigned char c) { return std::isalnum(c) ? static_cast<char>(std::toupper(c)) : '_'; });
        EXPECT_NE(text.find("#ifndef " + guard + "\n#define " + guard + "\n"), std::string::npos)
            << file << ": " << guard;
        const std::string code = stripComments(text);
        for (const auto& [pattern, rule] : forbidden) {
            std::smatch match;
            EXPECT_FALSE(std::regex_search(code, match, pattern)) << file << ": '" << match.str() << "': " << rule;
        }
    }
}

TEST_F(ShaderLibrary, IncludesNeverPointUp)
{
    const auto layerOf = [](const std::string& file) {
        const std::string folder = fs::path(file).parent_path().filename().string();
        return folder == "core" || folder == "shared" ? 0 : folder == "debug" ? 2 : 1;
    };
    for (const fs::path& file : libraryFiles()) {
        const std::string text = readSource(kShaders / file);
        const std::regex include("#include \"([^\"]*)\"");
        for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
            const std::string target = (*it)[1];
            EXPECT_TRUE(target.starts_with("crossray/")) << file << " includes " << target;
            EXPECT_LE(layerOf(target), layerOf(file.generic_string())) << file << " includes " << target;
        }
    }
}
