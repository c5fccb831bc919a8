#include "tests/unit/backend_vulkan/vulkan_fixture.h"

#include <algorithm>
#include <cmath>

using namespace crossray;
using namespace crossray::test;

namespace {

// A number that tells texel, level and channel.
double texelValue(int x, int y, int level, int channel)
{
    return 1000.0 * level + 100.0 * channel + 10.0 * y + x + 0.25;
}

ImageDesc makeImage(int width, int height, int channels, int levels, ImageFilter filter = ImageFilter::kNearest)
{
    ImageDesc image{width, height, channels, levels, filter, {}};
    for (int level = 0; level < levels; ++level)
        for (int y = 0; y < std::max(1, height >> level); ++y)
            for (int x = 0; x < std::max(1, width >> level); ++x)
                for (int channel = 0; channel < channels; ++channel)
                    image.texels.push_back(texelValue(x, y, level, channel));
    return image;
}

// Reads all texels of one level by texelFetch, four scalars a texel.
constexpr const char* kFetchLevel = R"(
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly buffer Out { vec4 values[]; };
layout(binding = 1) uniform sampler2D image;
layout(binding = 2) uniform Params { int level; };
void main()
{
    ivec2 size = textureSize(image, level);
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x < size.x && at.y < size.y) values[at.y * size.x + at.x] = texelFetch(image, at, level);
}
)";

// One dispatch and one storage buffer a level.
Job makeFetchJob(const ImageDesc& image)
{
    Job job;
    job.programs = {makeProgram("fetch", kFetchLevel)};
    job.images = {image};
    for (int level = 0; level < image.levels; ++level) {
        const auto width = static_cast<uint32_t>(std::max(1, image.width >> level));
        const auto height = static_cast<uint32_t>(std::max(1, image.height >> level));
        job.readbacks.push_back(job.buffers.size());
        job.buffers.push_back(makeStorage(size_t{4} * width * height));
        job.buffers.push_back(makeUniform(level));
        job.dispatches.push_back(
            {0,
             {bindBuffer(0, job.buffers.size() - 2), bindImage(1, 0), bindBuffer(2, job.buffers.size() - 1)},
             (width + 7) / 8,
             (height + 7) / 8,
             1});
    }
    return job;
}

void expectAllTexels(const ImageDesc& image, const JobResult& result)
{
    ASSERT_EQ(result.readbacks.size(), static_cast<size_t>(image.levels));
    for (int level = 0; level < image.levels; ++level) {
        const int width = std::max(1, image.width >> level), height = std::max(1, image.height >> level);
        const std::vector<double>& values = result.readbacks[static_cast<size_t>(level)];
        ASSERT_EQ(values.size(), static_cast<size_t>(4 * width * height));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int channel = 0; channel < 4; ++channel) {
                    const double missing =
                        channel == 3 ? 1.0 : 0.0; // what a sampler gives for channels that are not there
                    const double expected = channel < image.channels ? texelValue(x, y, level, channel) : missing;
                    ASSERT_EQ(values[static_cast<size_t>(4 * (y * width + x) + channel)], expected)
                        << "level " << level << " texel " << x << ", " << y << " channel " << channel;
                }
    }
    EXPECT_EQ(joinMessages(result), "");
}

constexpr const char* kSample = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 1) uniform sampler2D image;
layout(binding = 2) uniform Params { vec4 at[8]; };
void main() { for (int i = 0; i < 8; ++i) values[i] = textureLod(image, at[i].xy, at[i].z).x; }
)";
struct SamplePoints {
    float at[8][4] = {}; // u, v, level
};

} // namespace

class VulkanImageTest : public VulkanTest {};
INSTANTIATE_TEST_SUITE_P(Drivers, VulkanImageTest, testing::Values(kLavapipe, kSwiftshader), nameOfDriver);

TEST_P(VulkanImageTest, fetchesEachTexelOfEachLevel)
{
    const auto device = open();
    for (const int channels : {1, 4}) {
        const ImageDesc image = makeImage(64, 32, channels, 7);
        expectAllTexels(image, device->run(makeFetchJob(image)));
    }
}

TEST_P(VulkanImageTest, oddAndTinySizesAreRight)
{
    const auto device = open();
    for (const auto& [width, height, levels] :
         {std::array{1, 1, 1}, {3, 5, 3}, {7, 1, 3}, {1, 13, 4}, {65, 33, 7}, {127, 1, 7}, {2, 2, 1}})
        for (const int channels : {1, 4}) {
            const ImageDesc image = makeImage(width, height, channels, levels);
            expectAllTexels(image, device->run(makeFetchJob(image)));
        }
}

// An image of the pool comes back with the content of another job; what the shader reads must be its own.
TEST_P(VulkanImageTest, reusedImagesHoldTheNewTexels)
{
    const auto device = open();
    ImageDesc image = makeImage(16, 16, 4, 5);
    device->run(makeFetchJob(image));
    std::fill(image.texels.begin(), image.texels.end(), 42.0);
    for (const std::vector<double>& level : device->run(makeFetchJob(image)).readbacks)
        EXPECT_TRUE(std::all_of(level.begin(), level.end(), [](double value) { return value == 42.0; }));
}

TEST_P(VulkanImageTest, linearFilterBlendsTexelsAndLevelsAndClampsAtTheEdge)
{
    ImageDesc image{4, 1, 1, 2, ImageFilter::kLinear, {0, 1, 2, 3, /* level 1 */ 10, 20}};
    Job job = makeJob("sample", kSample, 8, 1);
    job.images = {image};
    SamplePoints points;
    const float us[8] = {0.125f, 0.25f, 0.375f, 0.5f, -1.0f, 2.0f, 0.5f, 0.375f};
    const float levels[8] = {0, 0, 0, 0, 0, 0, 1, 0.5f};
    for (int i = 0; i < 8; ++i) {
        points.at[i][0] = us[i];
        points.at[i][1] = 0.5f;
        points.at[i][2] = levels[i];
    }
    job.buffers.push_back(makeUniform(points));
    job.dispatches[0].bindings = {bindBuffer(0, 0), bindImage(1, 0), bindBuffer(2, 1)};
    const auto device = open();
    const JobResult linear = device->run(job);
    // u = 0.375 on level 1 lies a quarter past the first texel's centre: 12.5. Half way between levels: (1 + 12.5) / 2.
    const std::vector<double> expected{0, 0.5, 1, 1.5, 0, 3, 15, 6.75};
    for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(linear.readbacks[0][i], expected[i], 0.03) << i;
    EXPECT_EQ(joinMessages(linear), "");

    job.images[0].filter = ImageFilter::kNearest;
    const JobResult nearest = device->run(job);
    EXPECT_EQ(nearest.readbacks[0][0], 0);
    EXPECT_EQ(nearest.readbacks[0][2], 1);
    EXPECT_EQ(nearest.readbacks[0][4], 0);
    EXPECT_EQ(nearest.readbacks[0][5], 3);
    EXPECT_EQ(nearest.readbacks[0][6], 20);
    EXPECT_EQ(joinMessages(nearest), "");
}

TEST_P(VulkanImageTest, twoImagesWithDifferentFiltersStandSideBySide)
{
    constexpr const char* kTwo = R"(
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 4) uniform sampler2D smooth_;
layout(binding = 2) uniform sampler2D sharp;
void main() { values[0] = textureLod(smooth_, vec2(0.4, 0.5), 0.0).x; values[1] = textureLod(sharp, vec2(0.4, 0.5), 0.0).x; }
)";
    Job job = makeJob("two", kTwo, 2, 1);
    job.images = {{2, 1, 1, 1, ImageFilter::kLinear, {0, 1}}, {2, 1, 1, 1, ImageFilter::kNearest, {5, 6}}};
    job.dispatches[0].bindings = {bindImage(2, 1), bindImage(4, 0), bindBuffer(0, 0)};
    const JobResult result = open()->run(job);
    EXPECT_NEAR(result.readbacks[0][0], 0.3, 0.005);
    EXPECT_EQ(result.readbacks[0][1], 5);
    EXPECT_EQ(joinMessages(result), "");
}
