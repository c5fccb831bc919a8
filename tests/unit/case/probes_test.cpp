// [[probe]], [sky] and hierarchy: what they become, what stands where nothing is said, and what is refused.
#include "tests/unit/case/case_files.h"

using namespace crossray;

using Probes = CaseFiles;

namespace {

const std::string kBox = "[probe.influence]\nshape = \"box\"\nhalf_extents = [1, 2, 3]\n";
const std::string kSolid = "[probe.environment]\nsolid = [1, 0.5, 0.25]\n";

} // namespace

TEST_F(Probes, leftOutKeysComeFromTheInfluence)
{
    const Case testCase = readOne(
        withScene("[[probe]]\n[probe.influence]\nshape = \"box\"\ncenter = [4, 5, 6]\nhalf_extents = [1, 2, 3]\n"
                  "rotation = [0, 90, 0]\nblend = 0.25\nblend_positive = [0.1, 0.2, 0.3]\nblend_normal = 0.5\n"
                  "[probe.proxy]\nshape = \"box\"\nhalf_extents = [7, 8, 9]\n" +
                  kSolid));
    ASSERT_EQ(testCase.probes.size(), 1u);
    const Probe& probe = testCase.probes[0];
    EXPECT_EQ(probe.influence.halfExtents, glm::dvec3(1, 2, 3));
    EXPECT_EQ(probe.blend.positive, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(probe.blend.negative, glm::dvec3(0.25));
    EXPECT_EQ(probe.blendNormal.positive, glm::dvec3(0.5));
    EXPECT_EQ(probe.facePositive, glm::dvec3(1));
    EXPECT_EQ(probe.capturePosition, glm::dvec3(4, 5, 6));
    EXPECT_EQ(probe.proxy.center, glm::dvec3(4, 5, 6));
    EXPECT_EQ(probe.proxy.halfExtents, glm::dvec3(7, 8, 9));
    EXPECT_EQ(probe.proxy.worldFromVolume, probe.influence.worldFromVolume);
    EXPECT_EQ(std::get<SolidColor>(probe.environment.content).color, glm::dvec3(1, 0.5, 0.25));
    EXPECT_EQ(testCase.hierarchy, 0u);
    EXPECT_EQ(testCase.sky.model, SkyModel::kGradient);
}

TEST_F(Probes, aProbeWithoutProxyIsInfinite)
{
    const Probe probe = readOne(withScene("[[probe]]\n" + kBox + kSolid)).probes.at(0);
    EXPECT_EQ(probe.proxy.shape, VolumeShape::kInfinite);
    EXPECT_EQ(probe.minProjectionDistance, 0.0);
}

TEST_F(Probes, tiersAndSkyAreRead)
{
    const Case testCase =
        readOne(complete("[scene]\n[sky]\nmodel = \"cubemap\"\n[sky.environment]\nsize = 4\nfaces = [[1,0,"
                         "0],[2,0,0],[3,0,0],[4,0,0],[5,0,0],[6,0,0]]\n",
                         "hierarchy = [\"screen\", \"sky\"]"));
    EXPECT_EQ(testCase.hierarchy, unsigned{kTierScreen} | unsigned{kTierSky});
    ASSERT_TRUE(testCase.sky.environment);
    EXPECT_EQ(testCase.sky.environment->size, 4);
    EXPECT_EQ(std::get<FaceColors>(testCase.sky.environment->content).colors[5], glm::dvec3(6, 0, 0));
    const Case scenes = readOne(withScene("sky = { zenith = [9, 9, 9] }\n"));
    EXPECT_EQ(scenes.sky.gradient.zenith, glm::dvec3(9));
}

// Claim 11: influence and proxy volume must have the same shape.
TEST_F(Probes, unequalShapesAreRefused)
{
    EXPECT_EQ(
        refusal(withScene("[[probe]]\n" + kBox + "[probe.proxy]\nshape = \"sphere\"\nradius = 2\n" + kSolid)),
        "a.toml:15:9: \"shape\" of the proxy is \"sphere\" and that of the influence is \"box\"; the same shape is "
        "allowed, or infinite");
    EXPECT_EQ(
        refusal(withScene("[[probe]]\n[probe.influence]\nshape = \"sphere\"\nradius = 1\n[probe.proxy]\n"
                          "shape = \"box\"\nhalf_extents = [1, 1, 1]\n" +
                          kSolid)),
        "a.toml:15:9: \"shape\" of the proxy is \"box\" and that of the influence is \"sphere\"; the same shape is "
        "allowed, or infinite");
    EXPECT_EQ(readOne(withScene("[[probe]]\n" + kBox + "[probe.proxy]\nshape = \"infinite\"\n" + kSolid)).probes.size(),
              1u);
}

TEST_F(Probes, keysOfAnotherShapeAreRefused)
{
    EXPECT_EQ(refusal(withScene("[[probe]]\n" + kBox + "radius = 1\n" + kSolid)),
              "a.toml:14:10: \"radius\" is not allowed where \"shape\" is \"box\"");
    EXPECT_EQ(refusal(withScene("[[probe]]\n[probe.influence]\nshape = \"sphere\"\nradius = 1\nblend_positive = [1, 1, "
                                "1]\n" +
                                kSolid)),
              "a.toml:14:18: \"blend_positive\" is not allowed where \"shape\" is \"sphere\"");
    EXPECT_EQ(refusal(withScene("[[probe]]\n[probe.influence]\nshape = \"box\"\n" + kSolid)),
              "a.toml:12:9: \"half_extents\" is missing; a box requires it");
    EXPECT_EQ(
        refusal(withScene("[[probe]]\n" + kBox + "[probe.proxy]\nshape = \"infinite\"\ncenter = [0, 0, 0]\n" + kSolid)),
        "a.toml:16:10: \"center\" is not allowed where \"shape\" is \"infinite\"");
}

TEST_F(Probes, anEnvironmentHasOneContent)
{
    const std::string probe = "[[probe]]\n" + kBox + "[probe.environment]\n";
    EXPECT_EQ(refusal(withScene(probe)),
              "a.toml:14:1: no content; exactly one of solid, faces, levels, gradient, file, capture is "
              "required");
    EXPECT_EQ(refusal(withScene(probe + "solid = [1, 1, 1]\nlevels = [[1, 1, 1]]\n")),
              "a.toml:16:10: two contents, \"solid\" and \"levels\"; exactly one of solid, faces, levels, gradient, "
              "file, capture is "
              "allowed");
    EXPECT_EQ(refusal(withScene(probe + "levels = []\n")),
              "a.toml:15:10: \"levels\" is empty; 1 colour or more is allowed");
    EXPECT_EQ(refusal(withScene(probe + "faces = [[1, 1, 1]]\n")),
              "a.toml:15:9: \"faces\" has 1 colours; 6 are allowed: +x, -x, +y, -y, +z, -z");
    EXPECT_OPENS(refusal(withScene(probe + "faces = [1, 1, 1]\n")), "a.toml:15:10: \"faces\" is an integer;");
    EXPECT_OPENS(refusal(withScene(probe + "faces = [[1, 1]]\n")), "a.toml:15:10: \"faces\" has 2 values;");
}

TEST_F(Probes, tiersNeedWhatTheyAsk)
{
    EXPECT_EQ(refusal(complete("[scene]\n", "hierarchy = [\"probes\"]")),
              "a.toml:4:13: \"hierarchy\" has probes, and there is no [[probe]]; one is required");
    EXPECT_EQ(refusal(withScene("[sky]\nmodel = \"cubemap\"\n")),
              "a.toml:11:9: \"environment\" is missing in [sky]; cubemap requires it");
    std::string nine;
    for (int i = 0; i < 9; ++i)
        nine += "[[probe]]\n" + kBox + kSolid;
    EXPECT_EQ(refusal(withScene(nine)), "a.toml:58:1: [[probe]] stands here once more; at most 8 are allowed");
}
