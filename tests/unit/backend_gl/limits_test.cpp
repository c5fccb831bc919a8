// What is refused, and how the refusal reads.
#include "harness/backend/gl/gl_program.h"
#include "tests/unit/backend_gl/gl_test_device.h"

using namespace crossray;
using testing::Test;

using GlLimitsTest = GlTest;

TEST_F(GlLimitsTest, aShaderThatDoesNotCompileShowsTheDriversLog)
{
    const std::string text =
        catchError<ShaderError>([&] { device_->run(makeJob(makeGlsl("result[0] = nothing;"), 1)); });
    EXPECT_EQ(text.find("entry/test.comp: the OpenGL driver refuses to compile it:\n0:7(13): error: "), 0u) << text;
    EXPECT_NE(text.find("`nothing' undeclared"), std::string::npos) << text;
}

TEST_F(GlLimitsTest, theDeviceWorksOnAfterAnError)
{
    catchError<ShaderError>([&] { device_->run(makeJob(makeGlsl("nonsense"), 1)); });
    EXPECT_EQ(run(makeJob(makeGlsl("result[0] = 4.0;"), 1)).readbacks[0][0], 4.0);
}

TEST_F(GlLimitsTest, aProgramWithoutGlslIsRefused)
{
    const std::string text = catchError<ShaderError>([&] { device_->run(makeJob("", 1)); });
    EXPECT_EQ(text, "entry/test.comp: the program has no GLSL text, which OpenGL needs");
}

TEST_F(GlLimitsTest, aGroupThatIsTooLargeNamesTheNumbers)
{
    const std::string text =
        catchError<ShaderError>([&] { device_->run(makeJob(makeGlsl("result[0] = 1.0;", "", 128, 64), 1)); });
    EXPECT_EQ(text.find("entry/test.comp: a work group of 128x64x1 = 8192 invocations; this driver allows "), 0u)
        << text;
}

TEST_F(GlLimitsTest, tooManyGroupsNameTheNumbers)
{
    Job job = makeJob(makeGlsl("result[0] = 1.0;"), 1);
    job.dispatches[0].groupsY = 70000;
    EXPECT_EQ(catchError<ShaderError>([&] { device_->run(job); }),
              "entry/test.comp: dispatch 0 of 1x70000x1 groups; this driver allows 65535x65535x65535");
}

TEST_F(GlLimitsTest, tooManyStorageBlocksNameTheNumbers)
{
    std::string declarations, body = "result[0] = 0.0";
    for (int block = 1; block < 40; ++block) {
        declarations +=
            fmt::format("layout(binding = {}, std430) buffer B{} {{ float b{}[]; }};\n", block, block, block);
        body += fmt::format(" + b{}[0]", block);
    }
    const std::string text =
        catchError<ShaderError>([&] { device_->run(makeJob(makeGlsl(body + ";", declarations), 1)); });
    const size_t at = text.find("Too many compute shader storage blocks (40/");
    EXPECT_EQ(text.find("entry/test.comp: the OpenGL driver refuses to "), 0u) << text;
    EXPECT_NE(at, std::string::npos) << text;
}

TEST_F(GlLimitsTest, anUnboundOrWronglyBoundResourceIsRefused)
{
    const std::string declarations = "layout(binding = 4, std140) uniform Params { mat4 matrix; } params;\n"
                                     "layout(binding = 6) uniform sampler2D depth;";
    Job job = makeJob(makeGlsl("result[0] = params.matrix[0].x + texelFetch(depth, ivec2(0), 0).x;", declarations), 1);
    const auto refuse = [&] { return catchError<ShaderError>([&] { device_->run(job); }); };

    EXPECT_EQ(refuse(), "entry/test.comp: dispatch 0: the uniform block Params at binding 4 is not bound");
    job.dispatches[0].bindings.push_back(bindBuffer(4, 0));
    EXPECT_EQ(refuse(),
              "entry/test.comp: dispatch 0: the uniform block Params at binding 4 is bound to a storage block");
    BufferDesc uniform;
    uniform.kind = BufferKind::kUniform;
    uniform.bytes.resize(36);
    job.buffers.push_back(uniform);
    job.dispatches[0].bindings[1].index = 1;
    EXPECT_EQ(refuse(),
              "entry/test.comp: dispatch 0: the uniform block Params at binding 4 needs 64 bytes, and is bound to "
              "a buffer of 48");
    job.buffers[1].bytes.resize(64);
    EXPECT_EQ(refuse(), "entry/test.comp: dispatch 0: the sampler depth at binding 6 is not bound");
}

TEST_F(GlLimitsTest, aPlainUniformIsRefused)
{
    const Job job = makeJob(makeGlsl("result[0] = scale;", "uniform float scale;"), 1);
    EXPECT_NE(catchError<ShaderError>([&] { device_->run(job); }).find("the uniform scale stands outside of a block"),
              std::string::npos);
}

TEST_F(GlLimitsTest, aJobThatContradictsItselfIsRefused)
{
    Job job = makeJob(makeGlsl("result[0] = 1.0;"), 1);
    job.readbacks = {1};
    EXPECT_EQ(catchError<InputError>([&] { device_->run(job); }),
              "test: buffer 1 cannot be read back: it is no storage buffer of the job");
    job.readbacks = {0};
    job.dispatches[0].bindings[0].index = 3;
    EXPECT_EQ(catchError<InputError>([&] { device_->run(job); }), "test: binding 0 is buffer 3; the job has 1");
    job.dispatches[0].program = 1;
    EXPECT_EQ(catchError<InputError>([&] { device_->run(job); }), "test: a dispatch of program 1; the job has 1");
}

TEST(ParseLocalSize, readsWhatIsDeclared)
{
    EXPECT_EQ(parseLocalSize("layout(local_size_x = 8, local_size_y=4, local_size_z = 2) in;"),
              (std::array<int64_t, 3>{8, 4, 2}));
    EXPECT_EQ(parseLocalSize("layout(local_size_y = 64) in;"), (std::array<int64_t, 3>{1, 64, 1}));
    EXPECT_EQ(parseLocalSize("void main() {}"), (std::array<int64_t, 3>{1, 1, 1}));
    EXPECT_EQ(parseLocalSize("local_size_"), (std::array<int64_t, 3>{1, 1, 1}));
    EXPECT_EQ(parseLocalSize("local_size_x = SIZE"), (std::array<int64_t, 3>{1, 1, 1}));
}
