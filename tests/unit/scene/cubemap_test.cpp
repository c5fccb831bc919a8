#include "harness/scene/cubemap.h"

#include "harness/base/error.h"
#include "harness/scene/exr.h"
#include "harness/scene/random_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace crossray {

namespace {

// The selection table of the OpenGL 4.5 specification (table 8.19), row by row, which the harness's axes do not follow.
struct TablePosition {
    int face;
    double s, t; // [0,1]
};

TablePosition lookUpTable(const glm::dvec3& r)
{
    const double ax = std::abs(r.x), ay = std::abs(r.y), az = std::abs(r.z);
    double sc, tc, ma;
    int face;
    if (az >= ax && az >= ay) {
        face = r.z > 0 ? 4 : 5, sc = r.z > 0 ? r.x : -r.x, tc = -r.y, ma = az;
    } else if (ay >= ax) {
        face = r.y > 0 ? 2 : 3, sc = r.x, tc = r.y > 0 ? r.z : -r.z, ma = ay;
    } else {
        face = r.x > 0 ? 0 : 1, sc = r.x > 0 ? -r.z : r.z, tc = -r.y, ma = ax;
    }
    return {face, 0.5 * (sc / ma + 1.0), 0.5 * (tc / ma + 1.0)};
}

std::filesystem::path temporary(const char* name)
{
    return std::filesystem::path(testing::TempDir()) / name;
}

Cubemap makeNumbered(int size)
{
    Cubemap cubemap(size, 1);
    for (int face = 0; face < kCubeFaces; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                cubemap.at(0, face, x, y) = glm::dvec3(face, x, y);
    return cubemap;
}

std::string messageOf(const std::filesystem::path& file)
{
    try {
        readCubemap(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST(Cubemap, DirectionsFollowTheSpecificationsTable)
{
    RandomStream random(7);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 dir(random.next(-1, 1), random.next(-1, 1), random.next(-1, 1));
        const TablePosition expected = lookUpTable(dir);
        const CubeFacePosition actual = findCubePosition(3.0 * dir);
        ASSERT_EQ(actual.face, expected.face);
        ASSERT_NEAR(actual.uv.x, expected.s, 1e-14);
        ASSERT_NEAR(actual.uv.y, expected.t, 1e-14);
        const glm::dvec3 back = computeCubeDirection(actual.face, actual.uv);
        ASSERT_LT(glm::length(back - glm::normalize(dir)), 1e-14);
    }
}

TEST(Cubemap, TiesGoToZThenY)
{
    EXPECT_EQ(findCubePosition({1, 1, 1}).face, 4);
    EXPECT_EQ(findCubePosition({1, 1, -1}).face, 5);
    EXPECT_EQ(findCubePosition({-1, 1, 0}).face, 2);
    EXPECT_EQ(findCubePosition({1, -1, 0.5}).face, 3);
    EXPECT_EQ(findCubePosition({-1, 0, 0}).face, 1);
}

TEST(Cubemap, SixthsOfALookAroundMeetTheirFaces)
{
    const Cubemap cubemap = makeNumbered(4);
    const std::array<glm::dvec3, 6> dirs = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    for (int face = 0; face < kCubeFaces; ++face)
        EXPECT_EQ(nearestTexel(cubemap, dirs[static_cast<size_t>(face)]).x, face);
    // Up is at row 0 of the faces at the sides; seen from inside, -z's left neighbour is -x and its right one +x.
    EXPECT_EQ(nearestTexel(cubemap, {0, 0.99, -1}), glm::dvec3(5, 2, 0));
    EXPECT_EQ(nearestTexel(cubemap, {-0.99, 0, -1}), glm::dvec3(5, 3, 2));
}

TEST(Cubemap, LevelsAreMeansWithinAFace)
{
    Cubemap cubemap = makeNumbered(8);
    buildMipLevels(cubemap);
    ASSERT_EQ(cubemap.levelCount(), 4);
    EXPECT_EQ(cubemap.sizeOf(3), 1);
    for (int face = 0; face < kCubeFaces; ++face) {
        EXPECT_EQ(cubemap.at(1, face, 2, 1), glm::dvec3(face, 4.5, 2.5));
        EXPECT_EQ(cubemap.at(3, face, 0, 0), glm::dvec3(face, 3.5, 3.5));
    }
}

TEST(Cubemap, AFileGivesBackAllLevels)
{
    const auto file = temporary("cubemap_chain.exr");
    Cubemap cubemap = makeNumbered(4);
    buildMipLevels(cubemap);
    cubemap.at(1, 2, 0, 1) = {9, 8, 7}; // a chain of one's own is kept
    writeCubemap(file, cubemap);
    const Cubemap back = readCubemap(file);
    ASSERT_EQ(back.levelCount(), 3);
    for (size_t level = 0; level < 3; ++level)
        EXPECT_EQ(back.levels[level], cubemap.levels[level]);
}

TEST(Cubemap, AStripOfOnesOwnGetsItsChain)
{
    const auto file = temporary("cubemap_strip.exr");
    const Cubemap numbered = makeNumbered(4);
    Plane strip("painted", 4, 24, 3);
    for (size_t i = 0; i < strip.values.size(); ++i)
        strip.values[i] = numbered.levels[0][i / 3][static_cast<glm::length_t>(i % 3)];
    writeExr(file, std::vector<Plane>{strip});
    const Cubemap back = readCubemap(file);
    ASSERT_EQ(back.levelCount(), 3);
    EXPECT_EQ(back.levels[0], numbered.levels[0]);
    EXPECT_EQ(back.at(2, 5, 0, 0), glm::dvec3(5, 1.5, 1.5));
    strip.name = "Level0";
    writeExr(file, std::vector<Plane>{strip});
    EXPECT_EQ(readCubemap(file).levelCount(), 3);
}

TEST(Cubemap, OtherShapesAreRefusedInOneLine)
{
    const auto file = temporary("cubemap_refused.exr");
    const auto refuse = [&](std::vector<Plane> planes, const char* what) {
        writeExr(file, planes);
        const std::string message = messageOf(file);
        EXPECT_TRUE(message.starts_with(file.string() + ": no cubemap: " + what)) << message;
        EXPECT_NE(message.find("allowed: one RGB image"), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    };
    refuse({Plane("a", 24, 4, 3)}, "an image of 24x4");
    refuse({Plane("a", 16, 12, 3)}, "an image of 16x12");
    refuse({Plane("a", 3, 18, 3)}, "an image of 3x18");
    refuse({Plane("a", 4, 24, 1)}, "no channel a.R");
    refuse({Plane("a", 4, 24, 3), Plane("b", 4, 24, 3)}, "it has several parts");
    refuse({Plane("Level0", 4, 24, 3), Plane("Level1", 2, 12, 3)}, "no channel Level2.R");
    refuse({Plane("Level0", 4, 24, 3), Plane("Level1", 1, 6, 3)}, "Level1 is 1 texels wide after 4");
    EXPECT_NE(messageOf(temporary("cubemap_missing.exr")), "accepted");
}

TEST(Cubemap, SizesArePowersOfTwo)
{
    EXPECT_THROW(requireCubeSize(0), InputError);
    EXPECT_THROW(requireCubeSize(12), InputError);
    EXPECT_THROW(requireCubeSize(4096), InputError);
    EXPECT_NO_THROW(requireCubeSize(kMaxCubeSize));
}

} // namespace crossray
