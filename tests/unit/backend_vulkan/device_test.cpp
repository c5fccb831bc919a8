#include "tests/unit/backend_vulkan/vulkan_fixture.h"

#include "harness/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace crossray;
using namespace crossray::test;

class VulkanDeviceTest : public VulkanTest {};
INSTANTIATE_TEST_SUITE_P(Drivers, VulkanDeviceTest, testing::Values(kLavapipe, kSwiftshader), nameOfDriver);

TEST_P(VulkanDeviceTest, fillsABuffer)
{
    const JobResult result = open()->run(makeJob("fill", kFill, 129, 3));
    ASSERT_EQ(result.readbacks.size(), 1u);
    ASSERT_EQ(result.readbacks[0].size(), 129u);
    for (size_t i = 0; i < 129; ++i)
        EXPECT_EQ(result.readbacks[0][i], static_cast<double>(i) * 0.5);
    EXPECT_EQ(joinMessages(result), "");
    EXPECT_FALSE(result.programsWereWarm);
}

TEST_P(VulkanDeviceTest, storageBuffersStartAsZerosInEachJob)
{
    const auto device = open();
    Job job = makeJob("fill", kFill, 100, 2);
    device->run(job);
    job.dispatches.clear();
    const JobResult result = device->run(job);
    EXPECT_EQ(result.readbacks[0], std::vector<double>(100, 0.0));
    EXPECT_EQ(joinMessages(result), "");
}

// The second dispatch reads a value that another invocation of the first one wrote.
TEST_P(VulkanDeviceTest, aDispatchSeesWhatTheEarlierOneWrote)
{
    constexpr const char* kReverse = R"(
layout(local_size_x = 64) in;
layout(binding = 3) readonly buffer In { float source[]; };
layout(binding = 7) writeonly buffer Out { float target[]; };
void main() { target[gl_GlobalInvocationID.x] = source[1023 - gl_GlobalInvocationID.x] + 1.0; }
)";
    Job job = makeJob("fill", kFill, 1024, 16);
    job.programs.push_back(makeProgram("reverse", kReverse));
    job.buffers.push_back(makeStorage(1024));
    job.dispatches.push_back({1, {bindBuffer(7, 1), bindBuffer(3, 0)}, 16, 1, 1});
    job.dispatches.push_back({1, {bindBuffer(3, 1), bindBuffer(7, 0)}, 16, 1, 1});
    job.readbacks = {1, 0};
    const JobResult result = open()->run(job);
    ASSERT_EQ(result.readbacks.size(), 2u);
    for (size_t i = 0; i < 1024; ++i) {
        EXPECT_EQ(result.readbacks[0][i], static_cast<double>(1023 - i) * 0.5 + 1.0);
        EXPECT_EQ(result.readbacks[1][i], static_cast<double>(i) * 0.5 + 2.0);
    }
    EXPECT_EQ(joinMessages(result), "");
}

TEST_P(VulkanDeviceTest, readsUniformsOfSeveralBlocks)
{
    constexpr const char* kUniforms = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform First { vec4 a; float b; } first;
layout(binding = 2) uniform Second { float c; };
void main() { values[0] = first.a.w; values[1] = first.b; values[2] = c; }
)";
    struct First {
        float a[4] = {1, 2, 3, 4};
        float b = 5;
    };
    Job job = makeJob("uniforms", kUniforms, 3, 1);
    job.buffers.push_back(makeUniform(First{}));
    job.buffers.push_back(makeUniform(6.0f));
    job.dispatches[0].bindings = {bindBuffer(0, 0), bindBuffer(1, 1), bindBuffer(2, 2)};
    const JobResult result = open()->run(job);
    EXPECT_EQ(result.readbacks[0], (std::vector<double>{4, 5, 6}));
    EXPECT_EQ(joinMessages(result), "");
}

TEST_P(VulkanDeviceTest, bringsBackNotANumberAndInfinityAndRoundsTexelsOnce)
{
    constexpr const char* kCopy = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform sampler2D texels;
void main() { for (int i = 0; i < 4; ++i) values[i] = texelFetch(texels, ivec2(i, 0), 0).x; }
)";
    Job job = makeJob("copy", kCopy, 4, 1);
    const double infinity = std::numeric_limits<double>::infinity();
    job.images = {{4, 1, 1, 1, ImageFilter::kNearest, {std::nan(""), -infinity, 0.1, 1e-30}}};
    job.dispatches[0].bindings.push_back(bindImage(1, 0));
    const std::vector<double> values = open()->run(job).readbacks[0];
    EXPECT_TRUE(std::isnan(values[0]));
    EXPECT_EQ(values[1], -infinity);
    EXPECT_EQ(values[2], static_cast<double>(0.1f));
    EXPECT_EQ(values[3], static_cast<double>(1e-30f));
}

TEST_P(VulkanDeviceTest, stagingGivesTheSameAsMapping)
{
    Job job = makeJob("fill", kFill, 70, 2);
    job.buffers.push_back(makeStorage(33));
    job.dispatches.push_back({0, {bindBuffer(0, 1)}, 1, 1, 1});
    job.readbacks = {1, 0};
    VulkanTuning staging;
    staging.alwaysStage = true;
    const JobResult direct = open()->run(job);
    const JobResult staged = open(true, staging)->run(job);
    EXPECT_EQ(staged.readbacks, direct.readbacks);
    EXPECT_EQ(staged.readbacks[0].back(), 16.0);
    EXPECT_EQ(joinMessages(direct), "");
    EXPECT_EQ(joinMessages(staged), "");
}

TEST_P(VulkanDeviceTest, aWriteBeyondABufferDoesNotReachItsNeighbour)
{
    constexpr const char* kStray = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform Where { int count; };
void main() { for (int i = 0; i < count; ++i) values[i] = 7.0; }
)";
    Job job = makeJob("stray", kStray, 64, 1);
    job.buffers.push_back(makeStorage(4096));
    job.buffers.push_back(makeUniform(4096));
    job.dispatches[0].bindings.push_back(bindBuffer(1, 2));
    job.readbacks = {0, 1};
    const JobResult result = open(false)->run(job);
    EXPECT_EQ(result.readbacks[0], std::vector<double>(64, 7.0));
    EXPECT_EQ(result.readbacks[1], std::vector<double>(4096, 0.0));
}

TEST_P(VulkanDeviceTest, tellsWhatItIs)
{
    const Fingerprint print = open(false)->fingerprint();
    EXPECT_EQ(print.backend, GetParam().backend);
    EXPECT_EQ(print.api.rfind("Vulkan 1.", 0), 0u) << print.api;
    EXPECT_NE(print.driver, "");
    EXPECT_NE(print.cpu, "");
    const bool isLavapipe = print.backend == "lavapipe";
    EXPECT_NE(print.device.find(isLavapipe ? "llvmpipe" : "SwiftShader"), std::string::npos) << print.device;
    if (isLavapipe) {
        EXPECT_NE(print.driver.find("Mesa"), std::string::npos) << print.driver;
        EXPECT_NE(print.llvm, "");
    }
}

TEST_P(VulkanDeviceTest, timesAreThereAndTheDeviceTakesNoLongerThanTheWait)
{
    const auto device = open(false);
    const Job job = makeJob("fill", kFill, 1 << 20, 1 << 14);
    device->run(job);
    const JobTimes times = device->run(job).times;
    EXPECT_GT(times.program, 0);
    EXPECT_GT(times.upload, 0);
    EXPECT_GT(times.dispatch, 0);
    EXPECT_GT(times.readback, 0);
    EXPECT_GT(times.device, 0);
    EXPECT_LE(times.device, times.dispatch);
}

TEST_P(VulkanDeviceTest, refusesAnUnknownDeviceAndListsThoseFound)
{
    DeviceOptions options;
    options.vulkanDeviceName = "Voodoo 2";
    try {
        makeVulkanDevice(GetParam().backend, options);
        FAIL() << "a device that does not exist was opened";
    } catch (const EnvironmentError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("Voodoo 2"), std::string::npos) << text;
        EXPECT_NE(text.find(GetParam().backend == std::string("lavapipe") ? "llvmpipe" : "SwiftShader"),
                  std::string::npos)
            << text;
    }
}

TEST_P(VulkanDeviceTest, picksADeviceByThePrefixedBackendName)
{
    const std::string backend = GetParam().backend == std::string("lavapipe") ? "vulkan:llvm" : "vulkan:Swift";
    EXPECT_EQ(makeVulkanDevice(backend, {})->fingerprint().backend, backend);
}
