#include "harness/bench/throughput.h"

#include "harness/base/error.h"

#include <gtest/gtest.h>

#include <set>

using namespace crossray;

TEST(Throughput, casesAreDistinctInSceneAndShader)
{
    const std::vector<Case> cases = makeThroughputCases(64);
    ASSERT_EQ(cases.size(), 64u);
    std::set<std::string> names;
    std::set<uint32_t> variants;
    std::set<double> eyes;
    for (const Case& made : cases) {
        names.insert(made.name);
        eyes.insert(made.camera.worldFromView[3].x);
        uint32_t mask = 0;
        for (const OutputInfo& output : made.outputs)
            mask |= 1u << output.id;
        variants.insert(mask);
        EXPECT_EQ(made.camera.width, 64);
        EXPECT_EQ(made.projection.model, ProjectionModel::kHiz);
    }
    EXPECT_EQ(names.size(), 64u);
    EXPECT_EQ(variants.size(), 64u);
    EXPECT_EQ(eyes.size(), 64u);
}

TEST(Throughput, aNumberOfCasesOutOfRangeIsRefused)
{
    EXPECT_THROW(makeThroughputCases(0), InputError);
    EXPECT_THROW(makeThroughputCases(4097), InputError);
}

TEST(Throughput, jsonHoldsEveryPoint)
{
    const std::vector<ThroughputPoint> points{{"lavapipe", 1, CacheState::kCold, 32, 27.5, 27.0, 28.0, 25.0, 0},
                                              {"osmesa", 2, CacheState::kHot, 32, 0.7, 0.6, 0.8, 0.5, 1}};
    const std::string text = formatThroughputJson(points);
    EXPECT_NE(text.find("\"crossray-throughput/1\""), std::string::npos);
    EXPECT_NE(text.find("\"cold\""), std::string::npos);
    EXPECT_NE(text.find("\"hot\""), std::string::npos);
    EXPECT_NE(text.find("27.5"), std::string::npos);
}
