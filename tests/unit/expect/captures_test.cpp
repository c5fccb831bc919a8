#include "harness/expect/captures.h"

#include "tests/unit/expect/cases.h"

#include <filesystem>

namespace crossray::test {

namespace {

Case makeCase(SceneCapture capture)
{
    Case testCase;
    testCase.file = "cases/room.toml";
    testCase.scene.primitives = {box({0, 0, 0}, {3, 3, 3}, "diffuse")};
    testCase.scene.primitives[0].radiance.colorA = {0.25, 0.5, 0.75};
    testCase.scene.primitives.push_back(wall(-2.0, "mirror"));
    testCase.scene.primitives[1].radiance.colorA = glm::dvec3(1.0); // a float holds all of these, and their products
    testCase.scene.primitives[1].radiance.colorB = glm::dvec3(0.5);
    capture.position = {"cases/room.toml", 7, 11};
    Probe probe;
    probe.environment.content = std::move(capture);
    probe.environment.size = 8;
    testCase.probes = {probe};
    return testCase;
}

std::string messageOf(const Case& testCase)
{
    try {
        loadCubemap(testCase, testCase.probes[0].environment, &testCase.probes[0]);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(Captures, realtimeBakedAndCustomShowTheSame)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "captures_baked.exr";
    SceneCapture live;
    live.bounces = 2;
    const Case realtime = makeCase(live);
    const Probe& probe = realtime.probes[0];
    const Cubemap captured = loadCubemap(realtime, probe.environment, &probe).value();
    EXPECT_EQ(captured.at(0, 4, 3, 3), glm::dvec3(0.25, 0.5, 0.75));
    writeCubemap(file, captureProbe(realtime, probe));

    SceneCapture capture = live;
    capture.mode = SceneCapture::Mode::kBaked;
    capture.bakedFile = file;
    const Case baked = makeCase(capture);
    EXPECT_TRUE(loadCubemap(baked, baked.probes[0].environment, &baked.probes[0])->levels == captured.levels);
    const Environment own{CubemapFile{file}, 0};
    EXPECT_TRUE(loadCubemap(baked, own, nullptr)->levels == captured.levels);
    EXPECT_FALSE(loadCubemap(baked, Environment{SolidColor{}, 4}, nullptr));
}

TEST(Captures, whatWasNotBakedNamesTheCommand)
{
    SceneCapture capture;
    capture.mode = SceneCapture::Mode::kBaked;
    capture.bakedFile = std::filesystem::path(testing::TempDir()) / "captures_absent.exr";
    EXPECT_EQ(messageOf(makeCase(capture)), "cases/room.toml:7:11: the baked cubemap " + capture.bakedFile.string() +
                                                " is not there; `crossray bake cases/room.toml` writes it");
    capture.bakedFile = std::filesystem::path(testing::TempDir()) / "captures_small.exr";
    Cubemap small(4, 1);
    buildMipLevels(small);
    writeCubemap(capture.bakedFile, small);
    EXPECT_EQ(messageOf(makeCase(capture)), "cases/room.toml:7:11: the baked cubemap " + capture.bakedFile.string() +
                                                " has 4 texels a side, the case asks for 8; `crossray bake "
                                                "cases/room.toml` writes it");
}

// A mirror is read on the probe's proxy: the wall behind the eye is nearer than an endless one would have it.
TEST(Captures, mirrorsAreReadOnTheProxy)
{
    SceneCapture live;
    live.bounces = 1;
    Case testCase = makeCase(live);
    testCase.scene.primitives[0].radiance = {RadiancePattern::kGradient, {0, 0, 0}, {1, 1, 1}, 0.5, 0};
    testCase.scene.primitives[1].radiance.pattern = RadiancePattern::kSolid;
    testCase.scene.primitives[1].radiance.colorA = glm::dvec3(1.0);
    const Cubemap endless = captureProbe(testCase, testCase.probes[0]);
    Probe& probe = testCase.probes[0];
    probe.proxy = {VolumeShape::kBox, {0, 0, 0}, glm::dmat3(1.0), glm::dvec3(3.0)};
    const Cubemap projected = captureProbe(testCase, probe);
    // Face -z, the texel of slope 0.375: u runs to +x. By direction alone the mirror shows x = 3 * 0.375; on the room
    // its ray, from x = 2 * 0.375, ends at x = 7 * 0.375 of the wall z = 3, which the texel of that direction shows.
    const double slope = 0.375;
    EXPECT_NEAR(endless.at(0, 5, 5, 3).x, 0.5 - 0.5 * slope, 1e-12); // u of face -z runs to -x
    const double towards = 7.0 * slope / 3.0;                        // 0.875: the middle of a texel
    EXPECT_NEAR(projected.at(0, 5, 5, 3).x, 0.5 - 0.5 * towards, 1e-12);
}

} // namespace crossray::test
