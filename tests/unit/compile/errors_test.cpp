#include "harness/compile/compile.h"

#include "harness/base/error.h"
#include "harness/compile/message.h"
#include "harness/compile/source.h"
#include "tests/unit/compile/shader_folder.h"

#include <gtest/gtest.h>

using namespace crossray;

namespace {

class CompileErrors : public testing::Test {
  protected:
    // The error with the folder's path cut off.
    std::string errorFor(const std::string& source)
    {
        folder.write("entry/a.comp", source);
        std::string text = errorOf(compiler, "entry/a.comp", folder.options());
        const std::string root = folder.options().includeRoot.string() + "/";
        for (size_t at = text.find(root); at != std::string::npos; at = text.find(root))
            text.erase(at, root.size());
        return text;
    }
    ShaderFolder folder;
    ShaderCompiler compiler{{}};
};

} // namespace

TEST(Columns, areThoseOfWholeWords)
{
    EXPECT_EQ(findColumn("float foobar = foo;", "foo"), 16);
    EXPECT_EQ(findColumn("a=b", "="), 2);
    EXPECT_EQ(findColumn("float x;", "y"), 0);
    EXPECT_EQ(findColumn("float x;", ""), 0);
}

TEST_F(CompileErrors, nameLineAndColumn)
{
    EXPECT_EQ(errorFor("#version 450\nvoid main()\n{\n    float x = missing * 2.0;\n}\n"),
              "entry/a.comp:4:15: error: 'missing': undeclared identifier");
    EXPECT_THROW(compiler.compile("entry/a.comp", folder.options()), ShaderError);
}

TEST_F(CompileErrors, countLinesThroughNestedIncludes)
{
    folder.write(
        "lib/outer.glsl",
        "#ifndef OUTER\n#define OUTER\n\n#include \"lib/inner.glsl\"\n\nfloat outer() { return inner(); }\n#endif\n");
    folder.write("lib/inner.glsl", "#ifndef INNER\n#define INNER\nfloat inner() { return 1.0; }\n#endif\n");
    const std::string head = "#version 450\n#include \"lib/outer.glsl\"\n";
    const std::string tail = "void main() { float y = outer(); }\n";
    EXPECT_EQ(errorFor(head + tail), "no error");
    EXPECT_EQ(errorFor(head + "\nvoid main() { float y = otter(); }\n"),
              "entry/a.comp:4:25: error: 'otter': no matching overloaded function found");
    folder.write("lib/inner.glsl", "#ifndef INNER\n#define INNER\n\n\nfloat inner() { return 1.0 + wrong; }\n#endif\n");
    EXPECT_EQ(errorFor(head + tail), "lib/inner.glsl:5:30: error: 'wrong': undeclared identifier");
    folder.write("lib/inner.glsl", "float inner() { return 1.0; }\n");
    folder.write("lib/outer.glsl", "#include \"lib/inner.glsl\"\n\n\nfloat outer() { return wrong(); }\n");
    EXPECT_EQ(errorFor(head + tail), "lib/outer.glsl:4:24: error: 'wrong': no matching overloaded function found");
}

TEST_F(CompileErrors, nameTheMissingInclude)
{
    folder.write("lib/outer.glsl", "// one\n  #include \"lib/absent.glsl\"\n");
    const std::string text = errorFor("#version 450\n#include \"lib/outer.glsl\"\nvoid main() {}\n");
    EXPECT_TRUE(text.starts_with("lib/outer.glsl:2:13: error: 'lib/absent.glsl': ")) << text;
    EXPECT_NE(text.find("No such file"), std::string::npos) << text;
}

TEST_F(CompileErrors, includesMayNotLeaveTheRoot)
{
    folder.write("../secret.glsl", "float secret;\n");
    for (const std::string name : {"../secret.glsl", "lib/../../secret.glsl", "/etc/passwd"}) {
        const std::string text = errorFor("#version 450\n#include \"" + name + "\"\nvoid main() {}\n");
        EXPECT_NE(text.find("may not leave it"), std::string::npos) << text;
        EXPECT_TRUE(text.starts_with("entry/a.comp:2:11: error: ")) << text;
    }
}

TEST_F(CompileErrors, syntaxErrors)
{
    EXPECT_EQ(errorFor("#version 450\nvoid main()\n{\n    float x = 1.0\n}\n"),
              "entry/a.comp:5:1: error: syntax error, unexpected '}', expecting ',' or ';'");
    const std::string keyword = errorFor("#version 450\nvoid main()\n{\n    float x = float\n  return;\n}\n");
    EXPECT_TRUE(keyword.starts_with("entry/a.comp:5:3: error: syntax error, unexpected ")) << keyword;
}

TEST_F(CompileErrors, recursionNamesTheFunction)
{
    EXPECT_EQ(errorFor("#version 450\nfloat odd(float x);\nfloat even(float x) { return odd(x - 1.0); }\n"
                       "float odd(float x) { return even(x - 1.0); }\n"
                       "layout(binding = 0) buffer B { float a[]; };\nvoid main() { a[0] = odd(4.0); }\n"),
              "entry/a.comp:4:7: error: 'odd': recursion is not allowed");
}

TEST_F(CompileErrors, aMissingFileOrStageIsAnInputError)
{
    EXPECT_THROW(compiler.compile("entry/none.comp", folder.options()), InputError);
    folder.write("a.glsl", "float x;\n");
    EXPECT_THROW(compiler.compile("a.glsl", folder.options()), InputError);
    EXPECT_NE(errorOf(compiler, "a.glsl", folder.options()).find("allowed are .comp, .vert and .frag"),
              std::string::npos);
    std::filesystem::create_directories(folder.options().includeRoot / "folder.comp");
    EXPECT_THROW(compiler.compile("folder.comp", folder.options()), InputError);
}

TEST_F(CompileErrors, endlessIncludesEnd)
{
    folder.write("lib/self.glsl", "#include \"lib/self.glsl\"\n#include \"lib/self.glsl\"\n");
    const std::string text = errorFor("#version 450\n#include \"lib/self.glsl\"\nvoid main() {}\n");
    EXPECT_NE(text.find("includes nest deeper than 32"), std::string::npos) << text.substr(0, 400);
    EXPECT_TRUE(text.starts_with("lib/self.glsl:1:11: error: ")) << text.substr(0, 400);
    EXPECT_EQ(text.find('\n'), std::string::npos) << "one failure is one line: " << text.substr(0, 400);
    EXPECT_LT(text.size(), 20000u);
}

TEST_F(CompileErrors, includesThatDoubleAreBounded)
{
    const std::string filler(40000, '/');
    for (int i = 0; i < 30; ++i) {
        const std::string next = "#include \"lib/" + std::to_string(i + 1) + ".glsl\"\n";
        folder.write("lib/" + std::to_string(i) + ".glsl", "// " + filler + "\n" + next + next);
    }
    folder.write("lib/30.glsl", "\n");
    const std::string text = errorFor("#version 450\n#include \"lib/0.glsl\"\nvoid main() {}\n");
    EXPECT_NE(text.find("all inclusions together may have at most"), std::string::npos) << text.substr(0, 400);
    EXPECT_LT(text.size(), 20000u);
}

TEST_F(CompileErrors, hugeSourcesAreRefused)
{
    const std::string text = errorFor(std::string(10 << 20, ' ') + "void main() {}\n");
    EXPECT_NE(text.find("at most 1048576 bytes"), std::string::npos) << text;
    EXPECT_NE(errorFor(std::string("#version 450\nvoid main() {}\0 rest", 32)).find("is zero"), std::string::npos);
}

TEST_F(CompileErrors, deepExpressionsAreRefusedOrSurvived)
{
    const auto repeat = [](const std::string& part, int count) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += part;
        return text;
    };
    const auto inMain = [](const std::string& body) {
        return "#version 450\nlayout(binding = 0) buffer B { float a[]; };\nvoid main() {\n float x = a[0];\n" + body +
               "\na[0] = x; }\n";
    };
    constexpr int kMany = 200000;
    EXPECT_EQ(errorFor(inMain("x = 1.0" + repeat("+x", kMany) + ";")),
              "entry/a.comp:5: a statement may have at most 16384 operators and commas");
    for (const std::string& body :
         {"x = " + repeat("(", kMany) + ";", "x = " + repeat("- ", kMany) + "x;", repeat("{", kMany)}) {
        EXPECT_NE(errorFor(inMain(body)), "no error");
    }
    CompileOptions options = folder.options();
    options.optimize = false;
    for (const std::string& body : {"x = 1.0" + repeat("+x", 16000) + ";", "x" + repeat(",x", 16000) + ";"}) {
        folder.write("entry/a.comp", inMain(body));
        EXPECT_EQ(errorOf(compiler, "entry/a.comp", options), "no error");
    }
}

TEST(OverlongStatements, areCountedOutsideComments)
{
    const std::string many(kMaxOperators, '+');
    EXPECT_EQ(findOverlongStatement("x = 1;\n" + many + "\n+"), 3);
    EXPECT_EQ(findOverlongStatement(many + ";" + many), 0);
    EXPECT_EQ(findOverlongStatement("//" + many + "\n" + many), 0);
    EXPECT_EQ(findOverlongStatement("/*" + many + "*/" + many), 0);
    EXPECT_EQ(findOverlongStatement("/*" + many), 0);
    EXPECT_EQ(findOverlongStatement("//"), 0);
}

TEST(DriverMessages, areMappedThroughLineDirectives)
{
    const std::string glsl =
        "#version 450\n#line 10 \"entry/a.comp\"\nvoid main()\n{\n#line 3 \"lib/b.glsl\"\n  float x = y;\n}\n";
    EXPECT_EQ(mapDriverMessage("0:6(13): error: `y' undeclared", glsl), "lib/b.glsl:3: error: `y' undeclared");
    EXPECT_EQ(mapDriverMessage("0:3(1): error: a\n0:6: b\n", glsl), "entry/a.comp:10: error: a\nlib/b.glsl:3: b\n");
    EXPECT_EQ(mapDriverMessage("\"lib/b.glsl\":3(13): error: `y' undeclared", glsl),
              "lib/b.glsl:3: error: `y' undeclared");
    EXPECT_EQ(mapDriverMessage("0:1(1): error: version", glsl), "0:1(1): error: version");
    EXPECT_EQ(mapDriverMessage("link failed", glsl), "link failed");
    EXPECT_EQ(mapDriverMessage("0:99999999999999(1): error: far", glsl), "0:99999999999999(1): error: far");
}

TEST(DriverMessages, directivesAreBlankedLineByLine)
{
    EXPECT_EQ(blankLineDirectives(
                  "#version 450\n#extension GL_GOOGLE_cpp_style_line_directive : require\n#line 1 \"a\"\nx\n"),
              "#version 450\n\n\nx\n");
}

TEST(DriverMessages, findTheLineOfARealShader)
{
    const ShaderFolder folder;
    const std::filesystem::path path = folder.write("a.comp", kVariantShader);
    ShaderCompiler compiler({});
    CompileOptions options = folder.options();
    options.debugInfo = true;
    options.specialization = {{"kMode", 1}};
    const std::string glsl = compiler.compile("a.comp", options).glsl;
    const size_t at = glsl.find("textureLod");
    ASSERT_NE(at, std::string::npos);
    const auto line = 1 + std::count(glsl.begin(), glsl.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    EXPECT_EQ(mapDriverMessage("0:" + std::to_string(line) + "(1): error: bad", glsl, options.includeRoot),
              path.string() + ":13: error: bad");
}
