// The display encodings are those of the documents, by numbers worked out by hand.
#include "harness/inspect/debug_mode.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

using namespace crossray;

namespace {

void expectColor(const char* name, std::vector<double> value, std::vector<double> expected, int maximum = 0)
{
    const EncodedColor color = encodeForDisplay(findDebugMode(name).encoding, value.data(), maximum);
    EXPECT_NEAR(color.r, expected[0], 1e-6) << name;
    EXPECT_NEAR(color.g, expected[1], 1e-6) << name;
    EXPECT_NEAR(color.b, expected[2], 1e-6) << name;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

} // namespace

TEST(DebugMode, areNineteenWithNamesOfTheirOwn)
{
    std::set<std::string_view> names;
    for (const DebugMode& mode : debugModes()) {
        EXPECT_TRUE(names.insert(mode.name).second) << mode.name;
        EXPECT_TRUE(mode.output.empty() || findOutput(mode.output)) << mode.name;
    }
    EXPECT_EQ(names.size(), 19u);
    EXPECT_THROW(findDebugMode("hitdepth"), InputError);
}

TEST(DebugMode, directionsAndDepths)
{
    expectColor("RayDirWS", {1, 0, -1}, {1, 0.5, 0});
    expectColor("RayDirWS", {0.6, -0.8, 0}, {0.8, 0.1, 0.5});
    expectColor("HitDepth", {12.5}, {0.25, 0.25, 0.25}); // fract(1.25)
    expectColor("HitDepth", {7}, {0.7, 0.7, 0.7});
}

TEST(DebugMode, hitsAreGreenFailuresBlueAndNoRaycastNeither)
{
    expectColor("HitSuccess", {1}, {0.5, 1, 0.5});
    expectColor("HitSuccess", {2}, {0.5, 0.5, 1});
    expectColor("HitSuccess", {3}, {0.5, 0.5, 1}); // unknown: it failed to find one
    expectColor("HitSuccess", {0}, {0, 0, 0});
}

TEST(DebugMode, indicesHaveColoursOfTheirOwn)
{
    for (const char* name : {"TracingModel", "HiZIntersectionKind", "HitReason"}) {
        std::set<std::vector<double>> colors;
        for (double index = 0; index <= 6; ++index) {
            const EncodedColor color = encodeForDisplay(findDebugMode(name).encoding, &index, 0);
            EXPECT_TRUE(colors.insert({color.r, color.g, color.b}).second) << name << " " << index;
        }
        expectColor(name, {0}, {0, 0, 0});
    }
}

TEST(DebugMode, screenPlacesAndDirections)
{
    for (const std::string march : {"HiZ", "Linear"}) {
        expectColor((march + "PositionNDC").c_str(), {0.25, 0.75}, {0.25, 0.75, 0});
        // (0.6, -0.8) and 0.1/0.4 = 0.25; 0.1/0.08 = 1.25, of which the fraction is 0.25
        expectColor((march + "RayDirNDC").c_str(), {0.6, -0.8, 0.4}, {0.8, 0.1, 0.25});
        expectColor((march + "RayDirNDC").c_str(), {0.6, -0.8, 0.08}, {0.8, 0.1, 0.25});
        expectColor((march + "RayDirNDC").c_str(), {0, 0, 0}, {0.5, 0.5, 0}); // along the line of sight: no 1/0
    }
}

TEST(DebugMode, countsAreSharesOfTheirMaximum)
{
    expectColor("HiZIterationCount", {8}, {0.25, 0.25, 0.25}, 32);
    expectColor("LinearIterationCount", {32}, {1, 1, 1}, 32);
    expectColor("HiZMaxUsedMipLevel", {3}, {0.5, 0.5, 0.5}, 6);
    expectColor("HiZMaxUsedMipLevel", {0}, {0, 0, 0}, 0);
    Case testCase;
    testCase.projection.model = ProjectionModel::kHiz;
    testCase.projection.hiz = {1, 5, 48, 1.0};
    EXPECT_EQ(maximumOf(findDebugMode("HiZIterationCount"), testCase), 48);
    EXPECT_EQ(maximumOf(findDebugMode("HiZMaxUsedMipLevel"), testCase), 5);
    testCase.projection.model = ProjectionModel::kLinear;
    testCase.projection.linear.maxIterations = 77;
    EXPECT_EQ(maximumOf(findDebugMode("LinearIterationCount"), testCase), 77);
}

TEST(DebugMode, weightsAndColoursAreAsTheyAre)
{
    for (const std::string march : {"HiZ", "Linear"}) {
        expectColor((march + "HitWeight").c_str(), {0.3}, {0.3, 0.3, 0.3});
        expectColor((march + "SampledColor").c_str(), {0.1, 2.5, 0}, {0.1, 2.5, 0});
    }
    expectColor("Color", {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3});
}

TEST(DebugMode, whatIsNoNumberIsMagenta)
{
    for (const char* name : {"Color", "RayDirWS", "HitDepth", "HiZPositionNDC", "HiZRayDirNDC", "HiZHitWeight"})
        expectColor(name, {kNan, kNan, kNan}, {1, 0, 1});
}

TEST(DebugMode, aPlaneIsEncodedPixelAfterPixel)
{
    Plane plane("HitDepth", 2, 1, 1);
    plane.values = {1, 12};
    const auto colors = encodePlane(findDebugMode("HitDepth"), plane, Case());
    ASSERT_EQ(colors.size(), 2u);
    EXPECT_NEAR(colors[0].g, 0.1, 1e-6);
    EXPECT_NEAR(colors[1].g, 0.2, 1e-6);
}

TEST(DebugMode, aMarchThatTheCaseDoesNotRunIsRefused)
{
    Case testCase;
    testCase.projection.model = ProjectionModel::kHiz;
    EXPECT_NO_THROW(requireRecorded(findDebugMode("HiZHitWeight"), testCase));
    EXPECT_THROW(requireRecorded(findDebugMode("LinearHitWeight"), testCase), InputError);
    testCase.projection.model = ProjectionModel::kPatches;
    EXPECT_NO_THROW(requireRecorded(findDebugMode("HiZHitWeight"), testCase));
    testCase.projection.model = ProjectionModel::kProxyBox;
    EXPECT_THROW(requireRecorded(findDebugMode("HiZHitWeight"), testCase), InputError);
    EXPECT_NO_THROW(requireRecorded(findDebugMode("HitDepth"), testCase));
    testCase.projection.model = ProjectionModel::kNone;
    EXPECT_THROW(requireRecorded(findDebugMode("HitDepth"), testCase), InputError);
    EXPECT_NO_THROW(requireRecorded(findDebugMode("RayDirWS"), testCase));
    EXPECT_NO_THROW(requireRecorded(findDebugMode("None"), testCase));
}
