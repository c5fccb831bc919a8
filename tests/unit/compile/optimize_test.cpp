#include "harness/compile/optimize.h"

#include "harness/compile/spirv_module.h"
#include "tests/unit/compile/shader_folder.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace crossray;

namespace {

class Optimize : public testing::Test {
  protected:
    // A main() with `a` and `b`, numbers in storage, and `i`, the invocation's.
    std::vector<uint32_t> compileBody(const std::string& body, bool optimize = true)
    {
        folder.write(
            "a.comp",
            "#version 450\nlayout(local_size_x = 8) in;\nlayout(binding = 0) buffer A { float a[]; };\n"
            "layout(binding = 1) readonly buffer B { float b[]; };\n"
            "float level(float r) { const float levels[3] = float[3](1.0, 2.5, 7.0); return levels[int(r)]; }\n"
            "void main() { uint i = gl_GlobalInvocationID.x; float x = b[i];\n" +
                body + "\na[i] = x; }\n");
        CompileOptions options = folder.options();
        options.optimize = optimize;
        return compiler.compile("a.comp", options).spirv;
    }
    // Number of the first line of the module's text that has all the words; -1 for none.
    static int lineOf(const std::vector<uint32_t>& spirv, const std::vector<std::string>& words)
    {
        std::istringstream text(disassembleSpirv(spirv));
        std::string line;
        for (int number = 0; std::getline(text, line); ++number) {
            if (std::all_of(words.begin(), words.end(),
                            [&](const std::string& word) { return line.find(word) != line.npos; }))
                return number;
        }
        return -1;
    }
    ShaderFolder folder;
    ShaderCompiler compiler{{}};
};

} // namespace

// SPIRV-Tools 2023.1 hoisted the load and left the store where it was: every driver read 0 from such a table.
TEST_F(Optimize, aTableIsFilledBeforeItIsReadInALoop)
{
    const std::vector<uint32_t> spirv =
        compileBody("float r = x; for (int k = 0; k < int(b[0]); ++k) { if (b[k] > 0.5) x += min(level(r), b[k]); }");
    EXPECT_NO_THROW(validate(spirv));
    const int label = lineOf(spirv, {"OpLoopMerge"}), store = lineOf(spirv, {"OpStore", "%"});
    ASSERT_GT(label, 0);
    ASSERT_GT(store, label) << disassembleSpirv(spirv); // else this is no longer what it tests
    const std::string assembly = disassembleSpirv(spirv);
    const size_t variable = assembly.find("OpVariable %_ptr_Function");
    ASSERT_NE(variable, std::string::npos) << assembly;
    const size_t start = assembly.rfind('%', assembly.rfind('=', variable));
    const std::string name = assembly.substr(start, assembly.find(' ', start) - start);
    const int chain = lineOf(spirv, {"AccessChain", name + " "}), filled = lineOf(spirv, {"OpStore " + name + " "});
    ASSERT_GE(chain, 0) << assembly;
    EXPECT_GT(filled, label) << assembly;
    EXPECT_GT(chain, filled) << assembly;
}

TEST_F(Optimize, storageThatALoopWritesIsReadInIt)
{
    const std::vector<uint32_t> spirv = compileBody("for (int k = 0; k < 9; ++k) { a[3] = b[k]; x += a[3]; }");
    const std::string assembly = disassembleSpirv(spirv);
    const size_t loop = assembly.find("OpLoopMerge");
    ASSERT_NE(loop, std::string::npos);
    EXPECT_NE(assembly.find("OpStore", loop), std::string::npos);
    EXPECT_TRUE(loadsWhatItStores(spirv));
    // One load before the loop, of b[i], and those of b[k] and a[3] in it.
    size_t loads = 0;
    for (size_t at = assembly.find("OpLoad %float", loop); at != assembly.npos;
         at = assembly.find("OpLoad %float", at + 1))
        ++loads;
    EXPECT_EQ(loads, 2u) << assembly;
}

TEST_F(Optimize, whatIsOnlyReadLeavesTheLoop)
{
    const std::vector<uint32_t> spirv = compileBody("for (int k = 0; k < int(x); ++k) x += sin(b[5]);");
    EXPECT_FALSE(loadsWhatItStores(spirv));
    const std::string assembly = disassembleSpirv(spirv);
    EXPECT_EQ(assembly.find("OpLoad", assembly.find("OpLoopMerge")), assembly.npos) << assembly;
}

TEST_F(Optimize, loadsAndStoresAreFoundThroughChainsAndCalls)
{
    EXPECT_FALSE(loadsWhatItStores(compileBody("x *= 2.0;")));
    EXPECT_TRUE(loadsWhatItStores(compileBody("x += a[i + 1u];")));
    EXPECT_TRUE(loadsWhatItStores(compileBody("float t[3]; t[int(x)] = 1.0; x = t[int(b[2])];")));
    EXPECT_TRUE(loadsWhatItStores(compileBody("x = level(x);", false)));
}
