#include "tests/unit/backend_vulkan/vulkan_fixture.h"

#include "harness/base/error.h"

#include <array>

using namespace crossray;
using namespace crossray::test;

class VulkanErrorTest : public VulkanTest {
  protected:
    // Runs a job that must be refused; the error's text must name each of the words, and the device must still work
    // after it.
    template <typename Error>
    void expectRefused(const Job& job, const std::vector<std::string>& words) const
    {
        const auto device = open();
        try {
            device->run(job);
            FAIL() << "the job was accepted";
        } catch (const Error& error) {
            const std::string text = error.what();
            for (const std::string& word : words)
                EXPECT_NE(text.find(word), std::string::npos) << text << " lacks " << word;
        }
        const JobResult after = device->run(makeJob("fill", kFill, 64, 1));
        EXPECT_EQ(after.readbacks[0][63], 31.5);
        EXPECT_EQ(joinMessages(after), "");
    }
};
INSTANTIATE_TEST_SUITE_P(Drivers, VulkanErrorTest, testing::Values(kLavapipe, kSwiftshader), nameOfDriver);

TEST_P(VulkanErrorTest, aGroupThatIsTooLargeIsNamedInNumbers)
{
    const Job job = makeJob("wide", "layout(local_size_x = 32, local_size_y = 64) in; void main() {}", 4, 1);
    expectRefused<ShaderError>(job, {"wide", "2048", GetParam().backend == std::string("lavapipe") ? "1024" : "256"});
}

TEST_P(VulkanErrorTest, tooMuchSharedMemoryIsNamedInNumbers)
{
    constexpr const char* kShared = R"(
layout(local_size_x = 1) in;
layout(binding = 0) buffer Out { float values[]; };
shared vec4 scratch[100][100];
void main() { scratch[0][0] = vec4(1.0); values[0] = scratch[0][0].x; }
)";
    expectRefused<ShaderError>(makeJob("shared", kShared, 4, 1), {"shared", "160000"});
}

TEST_P(VulkanErrorTest, aMissingBindingIsNamed)
{
    Job job = makeJob("fill", kFill, 64, 1);
    job.dispatches[0].bindings.clear();
    expectRefused<ShaderError>(job, {"fill", "binding 0", "a storage buffer"});
}

TEST_P(VulkanErrorTest, aBindingOfAnotherKindIsNamed)
{
    Job job = makeJob("fill", kFill, 64, 1);
    job.buffers.push_back(makeUniform(1.0f));
    job.dispatches[0].bindings = {bindBuffer(0, 1)};
    expectRefused<ShaderError>(job, {"fill", "binding 0", "wants a storage buffer", "gives a uniform buffer"});
}

TEST_P(VulkanErrorTest, aBlockWithTooFewBytesIsNamedInNumbers)
{
    constexpr const char* kBlock = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform Params { vec4 a[4]; float last; };
void main() { values[0] = a[3].x + last; }
)";
    Job job = makeJob("block", kBlock, 1, 1);
    job.buffers.push_back(makeUniform(std::array<float, 16>{}));
    job.dispatches[0].bindings.push_back(bindBuffer(1, 1));
    expectRefused<ShaderError>(job, {"block", "binding 1 (Params)", "68", "64"});
}

TEST_P(VulkanErrorTest, whatIsNoSpirvIsRefused)
{
    Job job = makeJob("fill", kFill, 64, 1);
    job.programs[0].key = "broken";
    job.programs[0].spirv.resize(job.programs[0].spirv.size() / 2);
    expectRefused<ShaderError>(job, {"fill", "SPIR-V"});
    job.programs[0].spirv.clear();
    expectRefused<ShaderError>(job, {"fill", "SPIR-V"});
}

TEST_P(VulkanErrorTest, aJobThatContradictsItselfIsRefused)
{
    const Job good = makeJob("fill", kFill, 64, 1);
    Job job = good;
    job.dispatches[0].program = 1;
    expectRefused<InputError>(job, {"dispatch 0", "program 1 of 1"});
    job = good;
    job.readbacks = {1};
    expectRefused<InputError>(job, {"readback", "buffer 1"});
    job = good;
    job.images = {{2, 2, 1, 1, ImageFilter::kNearest, {1, 2, 3}}};
    expectRefused<InputError>(job, {"image 0", "3 values", "4"});
    job.images = {{2, 2, 3, 1, ImageFilter::kNearest, std::vector<double>(12)}};
    expectRefused<InputError>(job, {"image 0", "3 channels"});
    job.images = {{2, 2, 1, 3, ImageFilter::kNearest, std::vector<double>(6)}};
    expectRefused<InputError>(job, {"image 0", "3 levels", "1 to 2"});
    job = good;
    job.buffers[0].scalarCount = 0;
    expectRefused<InputError>(job, {"buffer 0"});
}

TEST_P(VulkanErrorTest, whatTheDeviceCannotHoldIsAnErrorOfTheEnvironment)
{
    Job job = makeJob("fill", kFill, 64, 1);
    job.buffers[0].scalarCount = size_t{1} << 40;
    expectRefused<EnvironmentError>(job, {"buffer 0", "this device allows"});
    job = makeJob("fill", kFill, 64, 1);
    job.dispatches[0].groupsX = 1u << 31;
    expectRefused<EnvironmentError>(job, {"dispatch 0", "groups in x"});
    job = makeJob("fill", kFill, 64, 1);
    job.buffers.assign(64, makeStorage(size_t{1} << 25)); // each is allowed, all together are 8 GiB
    expectRefused<EnvironmentError>(job, {"storage buffers", "8589934592"});
}

// The shader uses doubles, which the device was not asked for: the layer knows, a lenient driver does not mind.
TEST(VulkanValidation, aWrongShaderLeavesAMessageInEachJob)
{
    constexpr const char* kDouble = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform Params { float x; };
void main() { values[0] = float(double(x) * 3.0lf); }
)";
    chooseDriver(kLavapipe);
    DeviceOptions options;
    options.validation = true;
    const auto device = makeVulkanDevice("lavapipe", options);
    // A layer that falls silent after ten times the same would let the eleventh case pass.
    for (int i = 0; i < 15; ++i) {
        Job job = makeJob("double" + std::to_string(i), kDouble, 1, 1);
        job.buffers.push_back(makeUniform(2.0f));
        job.dispatches[0].bindings.push_back(bindBuffer(1, 1));
        const JobResult result = device->run(job);
        EXPECT_NE(joinMessages(result).find("Float64"), std::string::npos) << i << ": " << joinMessages(result);
    }
    EXPECT_EQ(joinMessages(device->run(makeJob("fill", kFill, 64, 1))), "");
}
