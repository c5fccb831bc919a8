// The library and the passes in the languages of other engines: each library file is OpenGL GLSL 4.50 and ESSL 3.10 as
// it stands, and each pass becomes ESSL, HLSL and MSL.
#include "harness/base/temporary_folder.h"
#include "harness/compile/compile.h"
#include "tests/shader/glsl/glsl_code.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> filesBelow(const fs::path& folder, const std::string& extension)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == extension) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class Translations : public testing::Test {
  protected:
    // What glslangValidator says to a compute shader that includes the file; empty when it is content.
    std::string validate(const fs::path& file, const std::string& version, const std::string& body = "")
    {
        const fs::path wrapper = folder_ / "wrapper.comp";
        const fs::path flat = folder_ / "flat.comp";
        const fs::path log = folder_ / "log";
        std::ofstream(wrapper) << "#version " << version << "\n#extension GL_GOOGLE_include_directive : require\n"
                               << "#include \"" << fs::relative(file, kShaders).generic_string() << "\"\n"
                               << "layout(local_size_x = 1) in;\nvoid main() {" << body << "}\n";
        // Flattened first: without a binary to make, glslangValidator reads no includes.
        const std::string flatten = "glslangValidator -E -I'" + kShaders.string() + "' '" + wrapper.string() + "' >'" +
                                    flat.string() + ".all' 2>'" + log.string() + "'";
        const std::string strip =
            "grep -v -e '^#line' -e GL_GOOGLE '" + flat.string() + ".all' >'" + flat.string() + "'";
        const std::string check = "glslangValidator '" + flat.string() + "' >'" + log.string() + "' 2>&1";
        if (std::system((flatten + " && " + strip + " && " + check).c_str()) == 0) return "";
        std::ifstream stream(log);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    TemporaryFolder temporary_{"translations"};
    const fs::path folder_ = temporary_.path();
};

} // namespace

TEST_F(Translations, EachLibraryFileIsOpenGlslAndEssl)
{
    const std::vector<fs::path> files = filesBelow(kShaders / "crossray", ".glsl");
    ASSERT_GE(files.size(), 30u);
    for (const fs::path& file : files) {
        EXPECT_EQ(validate(file, "450 core"), "") << file;
        EXPECT_EQ(validate(file, "310 es"), "") << file;
    }
}

TEST_F(Translations, TheCheckSeesWhatAnotherLanguageRefuses)
{
    const fs::path file = kShaders / "crossray/core/math.glsl";
    const std::string implicitConversion = "float x = 1;";
    EXPECT_EQ(validate(file, "450 core", implicitConversion), "");
    EXPECT_NE(validate(file, "310 es", implicitConversion), "");
    EXPECT_NE(validate(file, "450 core", "float x = nowhere;"), "");
}

TEST_F(Translations, EachPassBecomesEsslHlslAndMsl)
{
    const std::vector<fs::path> entries = filesBelow(kShaders / "entry", ".comp");
    ASSERT_GE(entries.size(), 2u);
    ShaderCompiler compiler{fs::path()};
    CompileOptions options;
    options.includeRoot = kShaders;
    options.debugInfo = true;
    for (const fs::path& entry : entries) {
        options.ownTracer =
            entry.stem() == "own_trace" ? kShaders.parent_path() / "cases/own/pixel_walk.glsl" : fs::path();
        const CompiledShader shader = compiler.compile(entry, options);
        const std::string essl = compiler.translate(shader.spirv, CompileTarget::kEssl);
        EXPECT_TRUE(essl.starts_with("#version 310 es")) << entry;
        std::ofstream(folder_ / "essl.comp") << essl;
        const std::string check = "glslangValidator '" + (folder_ / "essl.comp").string() + "' >/dev/null 2>&1";
        EXPECT_EQ(std::system(check.c_str()), 0) << entry << ": what it became is no ESSL";
        EXPECT_NE(compiler.translate(shader.spirv, CompileTarget::kHlsl).find("[numthreads("), std::string::npos)
            << entry;
        EXPECT_NE(compiler.translate(shader.spirv, CompileTarget::kMsl).find("kernel void main0("), std::string::npos)
            << entry;
    }
}
