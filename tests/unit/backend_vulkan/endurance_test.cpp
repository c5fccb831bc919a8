#include "tests/unit/backend_vulkan/vulkan_fixture.h"

#include <fstream>
#include <unistd.h>

using namespace crossray;
using namespace crossray::test;

namespace {

// Resident memory of this process in bytes.
size_t residentBytes()
{
    size_t total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return resident * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

constexpr const char* kSum = R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform sampler2D image;
layout(binding = 2) uniform Params { int width; float add; };
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x < width && at.y < width) values[at.y * width + at.x] = texelFetch(image, at, 0).x + add;
}
)";
struct Params {
    int width;
    float add;
};

Job makeSquareJob(int width)
{
    const auto count = static_cast<size_t>(width) * static_cast<size_t>(width);
    const auto groups = static_cast<uint32_t>((width + 7) / 8);
    Job job = makeJob("sum", kSum, count, groups, groups);
    job.images = {{width, width, 4, 1, ImageFilter::kNearest, std::vector<double>(4 * count, 2.0)}};
    job.buffers.push_back(makeUniform(Params{width, 1.0f}));
    job.dispatches[0].bindings = {bindBuffer(0, 0), bindImage(1, 0), bindBuffer(2, 1)};
    return job;
}

} // namespace

class VulkanEnduranceTest : public VulkanTest {};
INSTANTIATE_TEST_SUITE_P(Drivers, VulkanEnduranceTest, testing::Values(kLavapipe, kSwiftshader), nameOfDriver);

TEST_P(VulkanEnduranceTest, aThousandJobsDoNotGrow)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps freed memory; it looks for leaks by itself";
#endif
    const auto device = open(false);
    std::vector<Job> jobs;
    for (int i = 0; i < 40; ++i)
        jobs.push_back(makeSquareJob(17 + 3 * i)); // more shapes than the pool keeps
    const auto runAll = [&](int count) {
        for (int i = 0; i < count; ++i) {
            const Job& job = jobs[static_cast<size_t>(i) % jobs.size()];
            ASSERT_EQ(device->run(job).readbacks[0].back(), 3.0);
        }
    };
    runAll(200);
    const size_t before = residentBytes();
    runAll(1000);
    EXPECT_LT(residentBytes(), before + (size_t{4} << 20));
}

TEST_P(VulkanEnduranceTest, whatABigJobNeededIsGivenBack)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps freed memory; it looks for leaks by itself";
#endif
    const auto device = open(false);
    const Job small = makeSquareJob(16);
    device->run(small);
    const size_t before = residentBytes();
    device->run(makeSquareJob(2048)); // 64 MiB of texels, as much again for their upload, 16 MiB of results
    EXPECT_GT(residentBytes(), before + (size_t{64} << 20));
    for (int i = 0; i < 20; ++i)
        device->run(small);
    EXPECT_LT(residentBytes(), before + (size_t{48} << 20));
}

TEST_P(VulkanEnduranceTest, programsAreKeptUntilTheCapacityIsPassed)
{
    VulkanTuning tuning;
    tuning.programCapacity = 2;
    const auto device = open(true, tuning);
    const auto wasWarm = [&](const std::string& entry) {
        const JobResult result = device->run(makeJob(entry, kFill, 64, 1));
        EXPECT_EQ(result.readbacks[0][63], 31.5);
        EXPECT_EQ(joinMessages(result), "");
        return result.programsWereWarm;
    };
    EXPECT_FALSE(wasWarm("a"));
    EXPECT_FALSE(wasWarm("b"));
    EXPECT_TRUE(wasWarm("a"));
    EXPECT_FALSE(wasWarm("c")); // b is the one that was not used for longest
    EXPECT_TRUE(wasWarm("a"));
    EXPECT_FALSE(wasWarm("b"));
    EXPECT_TRUE(wasWarm("b"));
}

TEST_P(VulkanEnduranceTest, aJobMayHoldMoreProgramsThanAreKept)
{
    VulkanTuning tuning;
    tuning.programCapacity = 1;
    Job job = makeJob("first", kFill, 64, 1);
    job.programs.push_back(makeProgram("second", kFill));
    job.buffers.push_back(makeStorage(64));
    job.dispatches.push_back({1, {bindBuffer(0, 1)}, 1, 1, 1});
    job.readbacks = {0, 1};
    const auto device = open(true, tuning);
    for (int i = 0; i < 3; ++i) {
        const JobResult result = device->run(job);
        EXPECT_EQ(result.readbacks[0][63], 31.5);
        EXPECT_EQ(result.readbacks[1][63], 31.5);
    }
}
