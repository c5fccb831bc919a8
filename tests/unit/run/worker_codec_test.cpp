#include "harness/run/job_codec.h"

#include "harness/base/error.h"
#include "harness/run/worker_pool.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <random>

using namespace crossray;

namespace {

Job makeJob()
{
    Job job;
    job.label = "case backend";
    job.programs = {{"entry/a.comp", {{"kMode", 2}, {"kScale", 0.1}}, {1, 2, 3}, "#version 450", "key a"},
                    {"entry/b.comp", {}, {4, 5}, "#version 450\n", "key b"}};
    job.images = {{2, 1, 1, 1, ImageFilter::kNearest, {0.1, -1e30}}, {1, 1, 4, 1, ImageFilter::kLinear, {1, 2, 3, 4}}};
    job.buffers = {{BufferKind::kUniform, {std::byte{1}, std::byte{255}}, 0}, {BufferKind::kStorage, {}, 77}};
    job.dispatches = {{1, {{3, Binding::What::kImage, 1}, {0, Binding::What::kBuffer, 1}}, 4, 5, 6}};
    job.readbacks = {1, 1};
    return job;
}

void expectSame(const Job& a, const Job& b)
{
    EXPECT_EQ(a.label, b.label);
    ASSERT_EQ(a.programs.size(), b.programs.size());
    for (size_t i = 0; i < a.programs.size(); ++i) {
        EXPECT_EQ(a.programs[i].entry, b.programs[i].entry);
        EXPECT_EQ(a.programs[i].specialization, b.programs[i].specialization);
        EXPECT_EQ(a.programs[i].spirv, b.programs[i].spirv);
        EXPECT_EQ(a.programs[i].glsl, b.programs[i].glsl);
        EXPECT_EQ(a.programs[i].key, b.programs[i].key);
    }
    ASSERT_EQ(a.images.size(), b.images.size());
    for (size_t i = 0; i < a.images.size(); ++i) {
        EXPECT_EQ(a.images[i].width, b.images[i].width);
        EXPECT_EQ(a.images[i].height, b.images[i].height);
        EXPECT_EQ(a.images[i].channels, b.images[i].channels);
        EXPECT_EQ(a.images[i].levels, b.images[i].levels);
        EXPECT_EQ(a.images[i].filter, b.images[i].filter);
        EXPECT_EQ(a.images[i].texels, b.images[i].texels);
    }
    ASSERT_EQ(a.buffers.size(), b.buffers.size());
    for (size_t i = 0; i < a.buffers.size(); ++i) {
        EXPECT_EQ(a.buffers[i].kind, b.buffers[i].kind);
        EXPECT_EQ(a.buffers[i].bytes, b.buffers[i].bytes);
        EXPECT_EQ(a.buffers[i].scalarCount, b.buffers[i].scalarCount);
    }
    ASSERT_EQ(a.dispatches.size(), b.dispatches.size());
    for (size_t i = 0; i < a.dispatches.size(); ++i) {
        EXPECT_EQ(a.dispatches[i].program, b.dispatches[i].program);
        EXPECT_EQ(a.dispatches[i].groupsX, b.dispatches[i].groupsX);
        EXPECT_EQ(a.dispatches[i].groupsY, b.dispatches[i].groupsY);
        EXPECT_EQ(a.dispatches[i].groupsZ, b.dispatches[i].groupsZ);
        ASSERT_EQ(a.dispatches[i].bindings.size(), b.dispatches[i].bindings.size());
        for (size_t k = 0; k < a.dispatches[i].bindings.size(); ++k) {
            EXPECT_EQ(a.dispatches[i].bindings[k].binding, b.dispatches[i].bindings[k].binding);
            EXPECT_EQ(a.dispatches[i].bindings[k].what, b.dispatches[i].bindings[k].what);
            EXPECT_EQ(a.dispatches[i].bindings[k].index, b.dispatches[i].bindings[k].index);
        }
    }
    EXPECT_EQ(a.readbacks, b.readbacks);
}

} // namespace

TEST(JobCodec, roundTrip)
{
    expectSame(decodeJob(encodeJob(makeJob())), makeJob());
    expectSame(decodeJob(encodeJob(Job{})), Job{});
}

TEST(JobCodec, floatDevicesGetFloatsAndOnlyTheirForm)
{
    const DecodedJob vulkan =
        decodeJob(encodeJob(makeJob(), {Precision::kFloat, ProgramForm::kSpirv, nullptr}), nullptr);
    EXPECT_TRUE(vulkan.complete);
    EXPECT_EQ(vulkan.job.images[0].texels, (std::vector<double>{double{0.1f}, double{-1e30f}}));
    EXPECT_EQ(vulkan.job.programs[0].spirv.size(), 3u);
    EXPECT_EQ(vulkan.job.programs[0].glsl, "");
    const DecodedJob gl = decodeJob(encodeJob(makeJob(), {Precision::kFloat, ProgramForm::kGlsl, nullptr}), nullptr);
    EXPECT_EQ(gl.job.programs[0].spirv.size(), 0u);
    EXPECT_EQ(gl.job.programs[0].glsl, "#version 450");
    const DecodedJob cpu = decodeJob(encodeJob(makeJob(), {Precision::kDouble, ProgramForm::kEntry, nullptr}), nullptr);
    EXPECT_EQ(cpu.job.programs[0].glsl + cpu.job.programs[0].entry, "entry/a.comp");
    EXPECT_EQ(cpu.job.images[0].texels[0], 0.1);
}

TEST(JobCodec, knownProgramsAreLookedUp)
{
    const Job job = makeJob();
    const std::set<std::string> known{"key a"};
    const std::vector<std::byte> bytes = encodeJob(job, {Precision::kDouble, ProgramForm::kAll, &known});
    EXPECT_LT(bytes.size(), encodeJob(job).size());
    const DecodedJob whole =
        decodeJob(bytes, [&](const std::string& key) { return key == "key a" ? &job.programs[0] : nullptr; });
    EXPECT_TRUE(whole.complete);
    expectSame(whole.job, job);
    EXPECT_FALSE(decodeJob(bytes, [](const std::string&) { return nullptr; }).complete);
    EXPECT_THROW(decodeJob(bytes), InputError);
}

TEST(JobCodec, truncationAndNoiseAreInputErrors)
{
    const std::vector<std::byte> bytes = encodeJob(makeJob());
    for (size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THROW(decodeJob(std::span<const std::byte>(bytes).first(size)), InputError) << size;
    }
    std::mt19937 random(7);
    int refused = 0;
    for (int turn = 0; turn < 20000; ++turn) {
        std::vector<std::byte> noisy = bytes;
        for (int flips = 0; flips < 3; ++flips)
            noisy[random() % noisy.size()] = static_cast<std::byte>(random());
        try {
            decodeJob(noisy);
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000);
}

TEST(JobCodec, indicesOutOfRangeAreInputErrors)
{
    for (const auto& spoil : std::vector<void (*)(Job&)>{
             [](Job& job) { job.dispatches[0].program = 2; }, [](Job& job) { job.dispatches[0].bindings[0].index = 2; },
             [](Job& job) { job.dispatches[0].bindings[1].index = 2; }, [](Job& job) { job.readbacks[0] = 2; }}) {
        Job job = makeJob();
        spoil(job);
        EXPECT_THROW(decodeJob(encodeJob(job)), InputError);
    }
}

TEST(ResultCodec, roundTripWithNanAndTruncation)
{
    JobResult result;
    result.readbacks = {{1.5, std::nan(""), -0.0}, {}};
    result.times = {1, 2, 3, 4, -1};
    result.programsWereWarm = false;
    result.messages = {"one", ""};
    for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
        const std::vector<std::byte> bytes = encodeResult(result, precision);
        const JobResult copy = decodeResult(bytes);
        ASSERT_EQ(copy.readbacks.size(), 2u);
        EXPECT_EQ(copy.readbacks[0][0], 1.5);
        EXPECT_TRUE(std::isnan(copy.readbacks[0][1]));
        EXPECT_TRUE(std::signbit(copy.readbacks[0][2]));
        EXPECT_EQ(copy.times.readback, 4);
        EXPECT_EQ(copy.times.device, -1);
        EXPECT_FALSE(copy.programsWereWarm);
        EXPECT_EQ(copy.messages, result.messages);
        for (size_t size = 0; size < bytes.size(); ++size) {
            EXPECT_THROW(decodeResult(std::span<const std::byte>(bytes).first(size)), InputError);
        }
    }
    EXPECT_THROW(decodeResult(encodeJob(Job{})), InputError);
    EXPECT_THROW(decodeGreeting(encodeJob(Job{})), InputError);
}
