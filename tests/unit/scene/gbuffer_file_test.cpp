// G-buffers and cameras from files: what is derived, what is cleared, and what every complaint says.
#include "harness/base/temporary_folder.h"
#include "harness/scene/gbuffer.h"

#include "harness/base/error.h"
#include "harness/scene/exr.h"
#include "harness/scene/file_io.h"
#include "harness/scene/random_scene.h"
#include "harness/scene/truth.h"
#include "tests/unit/scene/all_channels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <unistd.h>

using namespace crossray;

namespace {

constexpr std::array<GBufferChannel, 3> kDepths = {GBufferChannel::kDeviceDepth, GBufferChannel::kLinearDepth,
                                                   GBufferChannel::kPositionWS};

const std::filesystem::path kData = std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases/real/data";

class GBufferFile : public testing::Test {
  protected:
    GBufferFile()
    {
        file_ = folder_ / "gbuffer.exr";
        camera_ = makeRandomRoomCamera(3, 40, 30);
    }

    // The message of what `read` throws: it must be one line that begins with the file and says what is allowed.
    template <typename Read>
    std::string messageOf(const std::filesystem::path& file, const Read& read) const
    {
        try {
            read();
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind(file.string() + ":", 0), 0U) << message;
            EXPECT_NE(message.find("allowed:"), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            return message;
        }
        return "";
    }

    std::string gbufferMessage(const ChannelMap& map, std::span<const GBufferChannel> channels) const
    {
        return messageOf(file_, [&] { (void)readGBuffer(file_, camera_, map, channels); });
    }

    std::string cameraMessage(const std::string& text) const
    {
        const std::filesystem::path file = folder_ / "camera.json";
        writeWholeFile(file, text);
        return messageOf(file, [&] {
            (void)readCameraJson(file);
            (void)readSceneJson(file);
        });
    }

    TemporaryFolder temporary_{"scene"};
    const std::filesystem::path folder_ = temporary_.path();
    std::filesystem::path file_;
    Camera camera_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

const std::string kCameraJson = R"({
 "size": [40, 30],
 "camera": {"fov_y_deg": 45, "near": 0.1, "far": 100},
 "camera_to_world_rows": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
 "primitives": [{"shape": "sphere", "center": [0, 0, -4], "radius": 1, "material": "glass", "ior": 1.5}]
})";

} // namespace

TEST_F(GBufferFile, OwnFilesComeBack)
{
    for (const DepthConvention convention : {DepthConvention::kReversed, DepthConvention::kStandard}) {
        camera_.depthConvention = convention;
        Scene scene = makeRandomRoom(3);
        scene.primitives.erase(scene.primitives.begin() + 1); // some sky
        const GBuffer written = renderGBuffer(scene, camera_, kAllChannels);
        writeGBuffer(file_, written);
        const GBuffer back = readGBuffer(file_, camera_, crossrayChannelMap(), kAllChannels);
        for (const GBufferChannel channel : kAllChannels) {
            const Plane& a = written.plane(channel);
            const Plane& b = back.plane(channel);
            ASSERT_TRUE(a.sameShape(b));
            EXPECT_EQ(b.name, nameOf(channel));
            for (size_t i = 0; i < a.values.size(); ++i)
                ASSERT_EQ(b.values[i], static_cast<double>(static_cast<float>(a.values[i])));
        }
    }
}

TEST_F(GBufferFile, AnyOfTheThreeDepthsGivesTheOthers)
{
    Scene scene = makeRandomRoom(3);
    scene.primitives.erase(scene.primitives.begin() + 1);
    for (const DepthConvention convention :
         {DepthConvention::kReversed, DepthConvention::kStandard, DepthConvention::kInfiniteReversed}) {
        camera_.depthConvention = convention;
        const GBuffer full = renderGBuffer(scene, camera_, kAllChannels);
        for (const GBufferChannel only : kDepths) {
            GBuffer one{camera_, {{only, full.plane(only)}}};
            writeGBuffer(file_, one);
            const GBuffer back = readGBuffer(file_, camera_, crossrayChannelMap(), kDepths);
            // A standard depth buffer's float leaves z / near * 2^-24 of the depth.
            const double relative =
                convention == DepthConvention::kStandard && only == GBufferChannel::kDeviceDepth ? 2e-5 : 1e-6;
            int empty = 0;
            for (int y = 0; y < 30; ++y)
                for (int x = 0; x < 40; ++x) {
                    const double depth = full.plane(GBufferChannel::kLinearDepth).at(x, y);
                    ASSERT_NEAR(back.plane(GBufferChannel::kLinearDepth).at(x, y), depth, relative * depth);
                    ASSERT_NEAR(back.plane(GBufferChannel::kDeviceDepth).at(x, y),
                                full.plane(GBufferChannel::kDeviceDepth).at(x, y), relative);
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(back.plane(GBufferChannel::kPositionWS).at(x, y, c),
                                    full.plane(GBufferChannel::kPositionWS).at(x, y, c), 2.0 * relative * depth);
                    empty += depth == 0.0 ? 1 : 0;
                }
            EXPECT_GT(empty, 20);
        }
    }
}

// Blender stores a depth of 1e10 where there is no surface, and whatever it likes in the other channels.
TEST_F(GBufferFile, BlendersNoSurfaceIsCleared)
{
    std::vector<Plane> planes = {Plane("ViewLayer", 40, 30, 1, 5.0)};
    planes[0].at(7, 8) = 1e10;
    planes[0].at(8, 8) = std::numeric_limits<double>::infinity();
    planes.push_back(Plane("Normal", 40, 30, 3, 0.5));
    writeExr(file_, planes);
    const ChannelMap map = {{GBufferChannel::kLinearDepth, {"ViewLayer.Y"}},
                            {GBufferChannel::kNormalWS, {"Normal.R", "Normal.G", "Normal.B"}}};
    const std::array<GBufferChannel, 4> wanted = {GBufferChannel::kLinearDepth, GBufferChannel::kDeviceDepth,
                                                  GBufferChannel::kPositionWS, GBufferChannel::kNormalWS};
    const GBuffer gbuffer = readGBuffer(file_, camera_, map, wanted);
    for (const int x : {7, 8}) {
        EXPECT_EQ(gbuffer.plane(GBufferChannel::kLinearDepth).at(x, 8), 0.0);
        EXPECT_EQ(gbuffer.plane(GBufferChannel::kDeviceDepth).at(x, 8), 0.0);
        EXPECT_EQ(gbuffer.plane(GBufferChannel::kPositionWS).at(x, 8, 1), 0.0);
        EXPECT_EQ(gbuffer.plane(GBufferChannel::kNormalWS).at(x, 8, 2), 0.0);
    }
    EXPECT_EQ(gbuffer.plane(GBufferChannel::kLinearDepth).at(9, 8), 5.0);
    EXPECT_EQ(gbuffer.plane(GBufferChannel::kNormalWS).at(9, 8, 2), 0.5);
}

TEST_F(GBufferFile, NamesWhatIsMissingAndWhatIsThere)
{
    writeExr(file_, std::vector<Plane>{Plane("LinearDepth", 40, 30, 1, 5.0), Plane("NormalWS", 40, 30, 2, 0.5)});
    const ChannelMap own = crossrayChannelMap();
    EXPECT_EQ(gbufferMessage(own, kDepths), "");
    const std::array<GBufferChannel, 1> color = {GBufferChannel::kColor};
    const std::string message = gbufferMessage(own, color);
    EXPECT_NE(message.find("missing Color.R, Color.G, Color.B for Color"), std::string::npos) << message;
    EXPECT_NE(message.find("LinearDepth.Y, NormalWS.X, NormalWS.Y"), std::string::npos) << message;
    const std::array<GBufferChannel, 1> normal = {GBufferChannel::kNormalWS};
    ChannelMap partly = own;
    partly[GBufferChannel::kNormalWS] = {"NormalWS.X", "NormalWS.Y", "NormalWS.Z"}; // two of three are there
    EXPECT_NE(gbufferMessage(partly, normal).find("missing"), std::string::npos);
    partly[GBufferChannel::kNormalWS] = {"NormalWS.X", "NormalWS.Y"};
    EXPECT_NE(gbufferMessage(partly, normal).find("2 names for NormalWS; allowed: 3"), std::string::npos);
    EXPECT_NE(gbufferMessage({}, color).find("not in the channel map"), std::string::npos);
    EXPECT_NE(gbufferMessage({}, kDepths).find("LinearDepth"), std::string::npos);
}

TEST_F(GBufferFile, RejectsAnotherSizeAndImpossibleDepths)
{
    writeExr(file_, std::vector<Plane>{Plane("LinearDepth", 41, 30, 1, 5.0)});
    EXPECT_NE(gbufferMessage(crossrayChannelMap(), kDepths).find("41x30; allowed: the camera's 40x30"),
              std::string::npos);
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<Plane> planes = {Plane("LinearDepth", 40, 30, 1, 5.0)};
        planes[0].at(3, 4) = bad;
        writeExr(file_, planes);
        EXPECT_NE(gbufferMessage(crossrayChannelMap(), kDepths).find("at (3, 4)"), std::string::npos);
    }
}

TEST_F(GBufferFile, TruthOfAnotherSizeOrWithoutItsChannels)
{
    const Camera camera = readCameraJson(kData / "mirror_room/camera.json");
    const Scene scene = readSceneJson(kData / "mirror_room/camera.json");
    const GBuffer gbuffer = readGBuffer(kData / "mirror_room/gbuffer.exr", camera, blenderChannelMap(), kAllChannels);
    const std::filesystem::path other = kData / "glass_sphere/truth.exr";
    const std::string size =
        messageOf(other, [&] { (void)readTruth(other, gbuffer, scene, TraceEffect::kReflection, 1); });
    EXPECT_NE(size.find("256x192 pixels; allowed: the camera's 320x180"), std::string::npos) << size;
    writeExr(file_, std::vector<Plane>{Plane("Color", 320, 180, 3, 1.0)});
    const std::string missing =
        messageOf(file_, [&] { (void)readTruth(file_, gbuffer, scene, TraceEffect::kReflection, 1); });
    EXPECT_NE(missing.find("missing channel ViewLayer.Combined.R"), std::string::npos) << missing;
    const std::filesystem::path good = kData / "mirror_room/truth.exr";
    EXPECT_THROW(readTruth(good, gbuffer, scene, TraceEffect::kRefraction, 1), InputError); // no glass in this room
}

TEST_F(GBufferFile, CameraJson)
{
    EXPECT_NE(cameraMessage(replaced(kCameraJson, "\"far\": 100", "\"far\": 1e999")).find("beyond what a double holds"),
              std::string::npos);
    EXPECT_EQ(cameraMessage(kCameraJson), "");
    const Camera camera = readCameraJson(folder_ / "camera.json");
    EXPECT_EQ(camera.width, 40);
    EXPECT_EQ(camera.fovYDegrees, 45.0);
    const Scene scene = readSceneJson(folder_ / "camera.json");
    ASSERT_EQ(scene.primitives.size(), 1U);
    EXPECT_EQ(scene.primitives[0].material, "glass");
    EXPECT_EQ(scene.upWS, glm::dvec3(0, 0, 1));
}

TEST_F(GBufferFile, RecordedPlanesLieAsDescribed)
{
    const Scene scene = readSceneJson(kData / "mirror_room/camera.json");
    const Primitive& left = scene.primitives[2]; // the wall x = -6: 6 m to each side along y, 3 m up and down
    EXPECT_EQ(left.worldFromLocal[2], glm::dvec3(1, 0, 0));
    const auto met = [&](double y, double z) { return !intersectPrimitive(left, {{0, y, z}, {-1, 0, 0}}).empty(); };
    EXPECT_TRUE(met(5.9, 5.9));
    EXPECT_TRUE(met(-5.9, 0.1));
    EXPECT_FALSE(met(6.1, 1.0));
    EXPECT_FALSE(met(0.0, 6.1));
}

TEST_F(GBufferFile, BrokenCameraJson)
{
    const std::array<std::array<const char*, 3>, 14> cases = {{
        {"\"size\": [40, 30],", "", "size is missing"},
        {"[40, 30]", "[40]", "a list of 2"},
        {"[40, 30]", "[40.5, 30]", "size[0] is 40.5"},
        {"[40, 30]", "[0, 30]", "1 to 16384"},
        {"[40, 30]", "[1e300, 30]", "a whole number of pixels"},
        {"45", "\"wide\"", "camera.fov_y_deg is \"wide\""},
        {"45", "200", "degrees in (0, 180)"},
        {"\"near\": 0.1", "\"near\": 1000", "metres beyond near"},
        {"[[1, 0, 0, 0]", "[[2, 0, 0, 0]", "a rotation and a position"},
        {"[[1, 0, 0, 0]", "[[-1, 0, 0, 0]", "a rotation and a position"},
        {"\"sphere\"", "\"torus\"", "plane, box, sphere"},
        {"\"radius\": 1,", "\"radius\": -1,", "metres above 0"},
        {"\"ior\": 1.5", "\"ior\": null", "a finite number"},
        {"\"glass\"", "\"gold\"", "diffuse, mirror, glass"},
    }};
    for (const auto& [from, to, message] : cases) {
        const std::string actual = cameraMessage(replaced(kCameraJson, from, to));
        EXPECT_NE(actual.find(message), std::string::npos) << from << " -> " << to << ": " << actual;
    }
    const std::string syntax = cameraMessage(replaced(kCameraJson, "\"near\": 0.1,", "\"near\" 0.1,"));
    EXPECT_NE(syntax.find("camera.json:3: not valid JSON"), std::string::npos) << syntax;
    EXPECT_NE(cameraMessage("").find("not valid JSON"), std::string::npos);
    EXPECT_NE(cameraMessage("[]").find("a table"), std::string::npos);
    EXPECT_NE(cameraMessage(std::string(100000, '[')).find("not valid JSON"), std::string::npos);
}
