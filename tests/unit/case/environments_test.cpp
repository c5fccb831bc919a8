// [environment] as a file or a capture, and [probe.mirror].
#include "tests/unit/case/case_files.h"

#include "harness/scene/cubemap.h"

using namespace crossray;

using Environments = CaseFiles;

namespace {

const std::string kHead =
    "[[probe]]\n[probe.influence]\nshape = \"box\"\ncenter = [4, 5, 6]\nhalf_extents = [1, 2, 3]\n";
const std::string kEnvironment = kHead + "[probe.environment]\n";
const std::string kPlanar = kHead + "[probe.mirror]\n";

std::string planar(const std::string& mirror)
{
    return "[[probe]]\nkind = \"planar\"\n" + kPlanar.substr(kPlanar.find('\n') + 1) + mirror;
}

} // namespace

TEST_F(Environments, aCaptureIsReadWithWhatItAsksFor)
{
    const Case live =
        readOne(withScene(kEnvironment + "capture = \"realtime\"\nbounces = 3\nface = \"-y\"\nsize = 32\n"));
    const auto& capture = std::get<SceneCapture>(live.probes.at(0).environment.content);
    EXPECT_EQ(capture.mode, SceneCapture::Mode::kRealtime);
    EXPECT_EQ(capture.bounces, 3);
    EXPECT_EQ(capture.face, 3);
    EXPECT_EQ(live.probes[0].environment.size, 32);

    const Case baked = readOne(withScene(kEnvironment + "capture = \"baked\"\n"));
    const auto& plain = std::get<SceneCapture>(baked.probes.at(0).environment.content);
    EXPECT_EQ(plain.mode, SceneCapture::Mode::kBaked);
    EXPECT_FALSE(plain.bounces);
    EXPECT_FALSE(plain.face);
    EXPECT_EQ(plain.bakedFile, folder_ / "a.probe1.exr");
    const Case placed = readOne(withScene(kEnvironment + "capture = \"baked\"\nfile = \"baked/room.exr\"\n"));
    EXPECT_EQ(std::get<SceneCapture>(placed.probes.at(0).environment.content).bakedFile.filename(), "room.exr");
}

TEST_F(Environments, aFileOfOnesOwnHasItsSize)
{
    Cubemap cubemap(4, 1);
    buildMipLevels(cubemap);
    writeCubemap(folder_ / "own.exr", cubemap);
    const Case own = readOne(withScene(kEnvironment + "file = \"own.exr\"\n"));
    EXPECT_EQ(std::get<CubemapFile>(own.probes.at(0).environment.content).file.filename(), "own.exr");
    const Case sky = readOne(withScene("[sky]\nmodel = \"cubemap\"\nenvironment = { file = \"own.exr\" }\n"));
    EXPECT_TRUE(std::holds_alternative<CubemapFile>(sky.sky.environment->content));
    EXPECT_EQ(refusal(withScene(kEnvironment + "file = \"own.exr\"\nsize = 4\n")),
              "a.toml:17:8: \"size\" is not allowed beside \"file\", which has its own");
    EXPECT_OPENS(refusal(withScene(kEnvironment + "file = \"other.exr\"\n")),
                 "a.toml:16:8: \"file\" is \"other.exr\", and there is no such file");
    EXPECT_OPENS(refusal(withScene(kEnvironment + "file = \"../own.exr\"\n")),
                 "a.toml:16:8: \"file\" is \"../own.exr\"");
}

TEST_F(Environments, whatDoesNotGoWithACaptureIsRefused)
{
    EXPECT_EQ(refusal(withScene(kEnvironment + "capture = \"realtime\"\nsize = 48\n")),
              "a.toml:17:8: \"size\" is 48; a power of two is allowed");
    EXPECT_EQ(refusal(withScene(kEnvironment + "capture = \"realtime\"\nfile = \"a.exr\"\n")),
              "a.toml:17:8: \"file\" is not allowed beside capture = \"realtime\"");
    EXPECT_EQ(refusal(withScene(kEnvironment + "solid = [1, 1, 1]\nbounces = 1\n")),
              "a.toml:17:11: \"bounces\" is not allowed without \"capture\"");
    EXPECT_EQ(refusal(withScene("[sky]\nmodel = \"cubemap\"\nenvironment = { capture = \"realtime\" }\n")),
              "a.toml:12:27: a sky has no position to capture from; \"file\" is allowed");
    EXPECT_OPENS(refusal(withScene(kEnvironment + "capture = \"realtime\"\nbounces = 17\n")),
                 "a.toml:17:11: \"bounces\"");
}

TEST_F(Environments, aMirrorStandsWhereItsInfluenceDoes)
{
    const Case testCase = readOne(withScene(planar("")));
    const Probe& probe = testCase.probes.at(0);
    EXPECT_EQ(probe.kind, ProbeKind::kPlanar);
    EXPECT_EQ(probe.mirror.position, glm::dvec3(4, 5, 6));
    EXPECT_EQ(probe.mirror.normal, glm::dvec3(0, 0, 1));
    EXPECT_FALSE(probe.mirror.fovYDegrees);
    EXPECT_EQ(probe.mirror.width, testCase.camera.width);
    EXPECT_EQ(probe.mirror.height, testCase.camera.height);
    EXPECT_TRUE(probe.mirror.linearFilter);

    const Probe other = readOne(withScene(planar("position = [1, 2, 3]\nnormal = [0, 2, 0]\nfov = 0\nsize = [8, 4]\n"
                                                 "filter = \"nearest\"\n")))
                            .probes.at(0);
    EXPECT_EQ(other.mirror.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(other.mirror.normal, glm::dvec3(0, 1, 0));
    EXPECT_EQ(other.mirror.fovYDegrees, 0.0);
    EXPECT_EQ(other.mirror.width, 8);
    EXPECT_EQ(other.mirror.height, 4);
    EXPECT_FALSE(other.mirror.linearFilter);
    const Probe turned = readOne(withScene(planar("rotation = [-90, 0, 0]\n"))).probes.at(0);
    EXPECT_LT(glm::length(turned.mirror.normal - glm::dvec3(0, 1, 0)), 1e-15);
}

TEST_F(Environments, eachKindOfProbeSeesInItsOwnWay)
{
    EXPECT_EQ(refusal(withScene(kHead)), "a.toml:10:1: \"environment\" is missing; kind reflection requires it");
    EXPECT_EQ(refusal(withScene(kPlanar + "[probe.environment]\nsolid = [1, 1, 1]\n")),
              "a.toml:15:1: \"mirror\" is not allowed where \"kind\" is \"reflection\"; \"environment\" is");
    EXPECT_EQ(refusal(withScene("[[probe]]\nkind = \"planar\"\n" + kHead.substr(kHead.find('\n') + 1))),
              "a.toml:11:8: \"mirror\" is missing; kind planar requires it");
    EXPECT_EQ(refusal(withScene(planar("normal = [0, 0, 0]\n"))),
              "a.toml:17:10: \"normal\" has length 0; any other length is allowed");
    EXPECT_EQ(refusal(withScene(planar("normal = [0, 0, 1]\nrotation = [0, 0, 0]\n"))),
              "a.toml:17:10: \"normal\" and \"rotation\" are both given; one of them is allowed");
    EXPECT_EQ(refusal(withScene("[camera]\nprojection = \"orthographic\"\n" + planar("fov = 60\n"))),
              "a.toml:19:7: \"fov\" is not allowed with an orthographic camera");
    EXPECT_OPENS(refusal(complete("[scene]\n" + planar(""), "probe_profile = \"urp_doc\"")),
                 "a.toml:4:17: \"probe_profile\" is \"urp_doc\" and a probe is planar; hdrp is allowed");
}
