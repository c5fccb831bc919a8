// Buffers, dispatches and what they hand on to each other.
#include "tests/unit/backend_gl/gl_test_device.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

using namespace crossray;

namespace {

// Writes 2 * index + 1 into all of `result` by 8x8 groups over a square.
const char* const kFill = "uvec2 p = gl_GlobalInvocationID.xy;\n"
                          "uint index = p.y * gl_NumWorkGroups.x * 8u + p.x;\n"
                          "if (index < uint(result.length())) result[index] = 2.0 * float(index) + 1.0;";

BufferDesc makeUniform(const std::vector<float>& values)
{
    BufferDesc desc;
    desc.kind = BufferKind::kUniform;
    desc.bytes.resize(values.size() * sizeof(float));
    std::memcpy(desc.bytes.data(), values.data(), desc.bytes.size());
    return desc;
}

} // namespace

using GlDispatch = GlTest;

TEST_F(GlDispatch, fillsABuffer)
{
    Job job = makeJob(makeGlsl(kFill, "", 8, 8), 64 * 64);
    job.dispatches[0].groupsX = 8;
    job.dispatches[0].groupsY = 8;
    const JobResult result = run(job);
    ASSERT_EQ(result.readbacks.size(), 1u);
    ASSERT_EQ(result.readbacks[0].size(), 4096u);
    for (size_t index = 0; index < 4096; ++index)
        ASSERT_EQ(result.readbacks[0][index], 2.0 * static_cast<double>(index) + 1.0);
}

TEST_F(GlDispatch, takesOddSizes)
{
    for (const size_t count : {1u, 2u, 7u, 61u, 4093u}) {
        Job job = makeJob(makeGlsl(kFill, "", 8, 8), count);
        job.dispatches[0].groupsX = 8;
        job.dispatches[0].groupsY = 8;
        const JobResult result = run(job);
        ASSERT_EQ(result.readbacks[0].size(), count);
        EXPECT_EQ(result.readbacks[0].back(), 2.0 * static_cast<double>(count) - 1.0) << count;
    }
}

TEST_F(GlDispatch, takesAnEmptyBuffer)
{
    EXPECT_TRUE(run(makeJob(makeGlsl("if (result.length() > 1) result[0] = 1.0;"), 0)).readbacks[0].empty());
}

TEST_F(GlDispatch, startsFromZerosWhateverAJobBeforeLeft)
{
    Job job = makeJob(makeGlsl("result[gl_GlobalInvocationID.x] += 1.0;"), 100);
    job.dispatches[0].groupsX = 100;
    for (int round = 0; round < 3; ++round)
        EXPECT_EQ(run(job).readbacks[0], std::vector<double>(100, 1.0)) << round;
}

TEST_F(GlDispatch, bringsBackEveryKindOfFloat)
{
    const Job job =
        makeJob(makeGlsl("result[0] = uintBitsToFloat(0x7f800000u);\nresult[1] = uintBitsToFloat(0xff800000u);\n"
                         "result[2] = uintBitsToFloat(0x7fc00000u);\nresult[3] = uintBitsToFloat(0x80000000u);\n"
                         "result[4] = uintBitsToFloat(0x7f7fffffu);\nresult[5] = uintBitsToFloat(0x3f800001u);"),
                6);
    const auto values = run(job).readbacks[0];
    EXPECT_EQ(values[0], std::numeric_limits<double>::infinity());
    EXPECT_EQ(values[1], -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_TRUE(values[3] == 0.0 && std::signbit(values[3]));
    EXPECT_EQ(values[4], static_cast<double>(std::numeric_limits<float>::max()));
    EXPECT_EQ(values[5], static_cast<double>(std::nextafter(1.0f, 2.0f)));
}

TEST_F(GlDispatch, aDispatchSeesWhatTheOneBeforeWrote)
{
    Job job = makeJob(makeGlsl(kFill, "", 8, 8), 64 * 64);
    job.programs.push_back(
        makeProgram(makeGlsl("uint index = gl_GlobalInvocationID.x;\n"
                             "uint next = (index + 1u) % uint(source.length());\n"
                             "result[index] = source[index] + 10.0 * source[next];",
                             "layout(binding = 5, std430) readonly buffer Source { float source[]; };", 64)));
    job.buffers.push_back(makeStorage(64 * 64));
    job.buffers.push_back(makeStorage(64 * 64));
    job.dispatches[0].groupsX = job.dispatches[0].groupsY = 8;
    DispatchDesc second;
    second.program = 1;
    second.groupsX = 64;
    second.bindings = {bindBuffer(0, 1), bindBuffer(5, 0)};
    DispatchDesc third = second;
    third.bindings = {bindBuffer(0, 2), bindBuffer(5, 1)};
    job.dispatches.push_back(second);
    job.dispatches.push_back(third);
    job.readbacks = {2, 1};
    const JobResult result = run(job);
    ASSERT_EQ(result.readbacks.size(), 2u);
    const auto first = [](size_t index) { return 2.0 * static_cast<double>(index % 4096) + 1.0; };
    for (size_t index = 0; index < 4096; ++index) {
        const double once = first(index) + 10.0 * first(index + 1);
        ASSERT_EQ(result.readbacks[1][index], once) << index;
        ASSERT_EQ(result.readbacks[0][index], once + 10.0 * (first(index + 1) + 10.0 * first(index + 2))) << index;
    }
}

TEST_F(GlDispatch, readsAUniformBlockByStd140)
{
    Job job =
        makeJob(makeGlsl("result[0] = params.scale;\nresult[1] = params.direction.z;\nresult[2] = params.bias;\n"
                         "result[3] = (params.matrix * vec4(0.0, 1.0, 0.0, 0.0)).w;\nresult[4] = params.weights[1];",
                         "layout(binding = 3, std140) uniform Params { float scale; vec3 direction; float bias;\n"
                         "mat4 matrix; float weights[2]; float last; } params;"),
                5);
    std::vector<float> values(4 * 3 + 16 + 8 + 1, 0.0f); // the block's own tail of three floats is left out
    values[0] = 2.5f;
    values[6] = -3.0f;
    values[7] = 0.125f;
    values[8 + 7] = 42.0f;
    values[24 + 4] = 7.0f;
    job.buffers.push_back(makeUniform(values));
    job.dispatches[0].bindings.push_back(bindBuffer(3, 1));
    EXPECT_EQ(run(job).readbacks[0], (std::vector<double>{2.5, -3.0, 0.125, 42.0, 7.0}));
}

TEST_F(GlDispatch, runsNothingForNoGroups)
{
    Job job = makeJob(makeGlsl("result[0] = 1.0;"), 1);
    job.dispatches[0].groupsY = 0;
    EXPECT_EQ(run(job).readbacks[0][0], 0.0);
}

TEST_F(GlDispatch, countsTheTimesAndTheWarmPrograms)
{
    const Job job = makeJob(makeGlsl("result[0] = 1.0;"), 1);
    const JobResult cold = run(job);
    const JobResult warm = run(job);
    EXPECT_FALSE(cold.programsWereWarm);
    EXPECT_TRUE(warm.programsWereWarm);
    EXPECT_GT(cold.times.program, warm.times.program);
    for (const JobTimes& times : {cold.times, warm.times}) {
        EXPECT_GT(times.upload, 0.0);
        EXPECT_GT(times.dispatch, 0.0);
        EXPECT_GT(times.readback, 0.0);
        EXPECT_EQ(times.device, -1.0);
    }
}

// The driver's own compile belongs to the program's time, although it happens as late as a dispatch. Best of three,
// since the machine may be busy; new numbers each time, so that no cache on disk knows the program.
TEST_F(GlDispatch, aFirstDispatchIsMuchFasterThanTheProgramsMaking)
{
    if (!isRenderer("llvmpipe")) GTEST_SKIP() << "only llvmpipe compiles late";
    const auto seed = std::chrono::steady_clock::now().time_since_epoch().count() % 1000000;
    double least = 1e9;
    for (int round = 0; round < 3; ++round) {
        std::string body = fmt::format("float x = float(gl_GlobalInvocationID.x) + {}.{};\n", seed, round);
        for (int step = 0; step < 100; ++step)
            body += fmt::format("x = fract(x * {}.7 + sin(x));\n", step);
        const JobResult cold = run(makeJob(makeGlsl(body + "result[0] = x;"), 1));
        least = std::min(least, cold.times.dispatch / cold.times.program);
    }
    EXPECT_LT(least, 0.1);
}
