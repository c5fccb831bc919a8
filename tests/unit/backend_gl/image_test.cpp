// Images: every level, both filters, the edges.
#include "tests/unit/backend_gl/gl_test_device.h"

#include <algorithm>
#include <cmath>

using namespace crossray;

namespace {

// Every number differs: 1000 * level + 100 * channel + a running index, over 8 so that halves stay exact.
ImageDesc makeImage(int width, int height, int channels, int levels, ImageFilter filter = ImageFilter::kNearest)
{
    ImageDesc desc;
    desc.width = width;
    desc.height = height;
    desc.channels = channels;
    desc.levels = levels;
    desc.filter = filter;
    for (int level = 0; level < levels; ++level) {
        const int texels = std::max(1, width >> level) * std::max(1, height >> level);
        for (int texel = 0; texel < texels; ++texel)
            for (int channel = 0; channel < channels; ++channel)
                desc.texels.push_back((1000.0 * level + 100.0 * channel + texel) / 8.0);
    }
    return desc;
}

// Reads all texels of all levels of the image at binding 1 by texelFetch, four channels each.
const char* const kFetchAll = "int at = 0;\n"
                              "for (int level = 0; level < textureQueryLevels(image); ++level) {\n"
                              "  ivec2 size = textureSize(image, level);\n"
                              "  for (int y = 0; y < size.y; ++y) for (int x = 0; x < size.x; ++x) {\n"
                              "    vec4 v = texelFetch(image, ivec2(x, y), level);\n"
                              "    for (int c = 0; c < 4; ++c) result[at++] = v[c];\n"
                              "  }\n"
                              "}\n";

const char* const kImage = "layout(binding = 1) uniform sampler2D image;";

Job makeImageJob(const std::string& body, const ImageDesc& desc, size_t scalarCount)
{
    Job job = makeJob(makeGlsl(body, kImage), scalarCount);
    job.images.push_back(desc);
    job.dispatches[0].bindings.push_back(bindImage(1, 0));
    return job;
}

// What GL's own definition of bilinear filtering gives on level 0 of a 1-channel image.
double sampleBilinear(const ImageDesc& desc, double u, double v)
{
    const double x = u * desc.width - 0.5;
    const double y = v * desc.height - 0.5;
    const auto texel = [&](double column, double row) {
        const int i = std::clamp(static_cast<int>(column), 0, desc.width - 1);
        const int j = std::clamp(static_cast<int>(row), 0, desc.height - 1);
        return desc.texels[static_cast<size_t>(j * desc.width + i)];
    };
    const double column = std::floor(x);
    const double row = std::floor(y);
    const double a = x - column;
    const double b = y - row;
    return (1 - b) * ((1 - a) * texel(column, row) + a * texel(column + 1, row)) +
           b * ((1 - a) * texel(column, row + 1) + a * texel(column + 1, row + 1));
}

} // namespace

using GlImages = GlTest;

TEST_F(GlImages, everyTexelOfEveryLevelArrives)
{
    struct Shape {
        int width, height, channels, levels;
    };
    for (const Shape& shape : {Shape{1, 1, 1, 1}, Shape{1, 1, 4, 1}, Shape{8, 8, 1, 4}, Shape{5, 3, 4, 3},
                               Shape{5, 3, 1, 2}, Shape{1, 7, 1, 3}, Shape{13, 1, 4, 4}, Shape{6, 9, 3, 4}}) {
        const ImageDesc desc = makeImage(shape.width, shape.height, shape.channels, shape.levels);
        const size_t texels = desc.texels.size() / static_cast<size_t>(shape.channels);
        const auto values = run(makeImageJob(kFetchAll, desc, texels * 4)).readbacks[0];
        for (size_t texel = 0; texel < texels; ++texel)
            for (size_t channel = 0; channel < 4; ++channel) {
                double expected = channel == 3 ? 1.0 : 0.0; // what GL fills in
                if (channel < static_cast<size_t>(shape.channels))
                    expected = desc.texels[texel * static_cast<size_t>(shape.channels) + channel];
                ASSERT_EQ(values[texel * 4 + channel], expected)
                    << shape.width << "x" << shape.height << " texel " << texel << " channel " << channel;
            }
    }
}

TEST_F(GlImages, aPooledTextureShowsTheNewTexels)
{
    ImageDesc desc = makeImage(4, 4, 1, 3);
    run(makeImageJob(kFetchAll, desc, 84));
    for (double& texel : desc.texels)
        texel = -texel;
    const auto values = run(makeImageJob(kFetchAll, desc, 84)).readbacks[0];
    for (size_t texel = 0; texel < 21; ++texel)
        ASSERT_EQ(values[texel * 4], desc.texels[texel]);
}

TEST_F(GlImages, infinitiesAndNanArrive)
{
    ImageDesc desc = makeImage(3, 1, 1, 1);
    desc.texels = {INFINITY, -INFINITY, NAN};
    const auto values = run(makeImageJob(kFetchAll, desc, 12)).readbacks[0];
    EXPECT_EQ(values[0], INFINITY);
    EXPECT_EQ(values[4], -INFINITY);
    EXPECT_TRUE(std::isnan(values[8]));
}

TEST_F(GlImages, bilinearSamplingIsExactToFloat)
{
    const ImageDesc desc = makeImage(5, 3, 1, 1, ImageFilter::kLinear);
    const auto values = run(makeImageJob("for (int y = 0; y < 41; ++y) for (int x = 0; x < 41; ++x)\n"
                                         "  result[y * 41 + x] = textureLod(image, vec2(x, y) / 32.0 - 0.125, 0.0).x;",
                                         desc, 41 * 41))
                            .readbacks[0];
    double worst = 0;
    for (int y = 0; y < 41; ++y)
        for (int x = 0; x < 41; ++x) {
            const double expected = sampleBilinear(desc, x / 32.0 - 0.125, y / 32.0 - 0.125);
            worst = std::max(worst, std::abs(values[static_cast<size_t>(y * 41 + x)] - expected));
        }
    // Texels are below 2: a filter of 8-bit weights would be wrong by 1e-3.
    EXPECT_LT(worst, 2e-6);
}

TEST_F(GlImages, nearestSamplingTakesTheTexelThatHoldsThePoint)
{
    const ImageDesc desc = makeImage(4, 2, 1, 2);
    const auto values = run(makeImageJob("result[0] = textureLod(image, vec2(0.249, 0.25), 0.0).x;\n"
                                         "result[1] = textureLod(image, vec2(0.251, 0.25), 0.0).x;\n"
                                         "result[2] = textureLod(image, vec2(0.9, 0.9), 0.0).x;\n"
                                         "result[3] = textureLod(image, vec2(0.9, 0.9), 1.0).x;\n"
                                         "result[4] = textureLod(image, vec2(-3.0, -3.0), 0.0).x;\n"
                                         "result[5] = textureLod(image, vec2(3.0, -3.0), 0.0).x;",
                                         desc, 6))
                            .readbacks[0];
    EXPECT_EQ(values, (std::vector<double>{0.0, 1 / 8.0, 7 / 8.0, 1001 / 8.0, 0.0, 3 / 8.0}));
}

TEST_F(GlImages, linearSamplingBlendsLevels)
{
    ImageDesc desc = makeImage(2, 2, 1, 2, ImageFilter::kLinear);
    desc.texels = {0, 0, 0, 0, 1};
    const auto values = run(makeImageJob("for (int i = 0; i <= 16; ++i)\n"
                                         "  result[i] = textureLod(image, vec2(0.5), float(i) / 16.0).x;",
                                         desc, 17))
                            .readbacks[0];
    // Mesa can trade this for speed: a driver that does would stay at 0 up to a quarter of the way.
    for (size_t i = 0; i <= 16; ++i)
        EXPECT_NEAR(values[i], static_cast<double>(i) / 16.0, 1e-6) << i;
}

TEST_F(GlImages, severalImagesKeepTheirOwnFilters)
{
    Job job = makeImageJob("result[0] = textureLod(image, vec2(0.5), 0.0).x;\n"
                           "result[1] = textureLod(other, vec2(0.5), 0.0).x;",
                           makeImage(2, 1, 1, 1, ImageFilter::kLinear), 2);
    job.programs[0] = makeProgram(makeGlsl("result[0] = textureLod(image, vec2(0.49, 0.5), 0.0).x;\n"
                                           "result[1] = textureLod(other, vec2(0.49, 0.5), 0.0).x;",
                                           std::string(kImage) + "\nlayout(binding = 9) uniform sampler2D other;"));
    job.images[0].texels = {0, 100};
    job.images.push_back(job.images[0]);
    job.images[1].filter = ImageFilter::kNearest;
    job.dispatches[0].bindings.push_back(bindImage(9, 1));
    const auto values = run(job).readbacks[0];
    EXPECT_NEAR(values[0], 48.0, 1e-4);
    EXPECT_EQ(values[1], 0.0);
}

TEST_F(GlImages, malformedImagesAreRefusedWithTheAllowedRange)
{
    const auto refuse = [&](ImageDesc desc) {
        return catchError<InputError>([&] { device_->run(makeImageJob(kFetchAll, desc, 4)); });
    };
    EXPECT_EQ(refuse(makeImage(2, 2, 2, 1)), "an image of 2 channels: 1, 3 or 4 are allowed");
    EXPECT_EQ(refuse(makeImage(4, 4, 1, 4)), "an image of 4x4 with 4 levels: 1 to 3 are allowed");
    ImageDesc desc = makeImage(2, 2, 1, 1);
    desc.texels.pop_back();
    EXPECT_EQ(refuse(desc), "an image of 2x2 with 1 channels and 1 levels holds 4 numbers, not 3");
    desc.width = 0;
    EXPECT_EQ(refuse(desc).find("an image of 0x2 texels: this OpenGL driver allows 1x1 to "), 0u);
    desc.width = 40000;
    EXPECT_EQ(refuse(desc).find("an image of 40000x2 texels: "), 0u);
}
