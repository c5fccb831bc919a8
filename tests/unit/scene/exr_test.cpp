#include "harness/base/temporary_folder.h"
#include "harness/scene/exr.h"

#include "harness/base/error.h"
#include "harness/scene/file_io.h"
#include "harness/scene/random_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <unistd.h>

using namespace crossray;

namespace {

class Exr : public testing::Test {
  protected:
    std::string messageOf(const std::string& bytes) const
    {
        const std::filesystem::path file = folder_ / "hostile.exr";
        writeWholeFile(file, bytes);
        try {
            (void)readExrChannels(file);
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind(file.string() + ": ", 0), 0U) << message;
            EXPECT_NE(message.find("allowed:"), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            return message;
        }
        return "";
    }

    TemporaryFolder temporary_{"scene"};
    const std::filesystem::path folder_ = temporary_.path();
};

Plane makeNoise(const std::string& name, int width, int height, int channels)
{
    Plane plane(name, width, height, channels);
    RandomStream random(static_cast<uint64_t>(channels));
    for (double& value : plane.values)
        value = static_cast<float>(random.next(-100.0, 100.0));
    return plane;
}

std::string sampleFile(const std::filesystem::path& folder)
{
    const std::vector<Plane> planes = {makeNoise("Color", 20, 30, 3), makeNoise("HitDepth", 20, 30, 1)};
    writeExr(folder / "sample.exr", planes);
    return readWholeFile(folder / "sample.exr");
}

void putInteger(std::string& bytes, size_t at, int32_t value)
{
    for (size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<char>((static_cast<uint32_t>(value) >> (8 * i)) & 0xff);
}

// Where the value of an attribute begins.
size_t valueOf(const std::string& bytes, const std::string& name, const std::string& type)
{
    const std::string key = name + '\0' + type + '\0';
    const size_t at = bytes.find(key);
    EXPECT_NE(at, std::string::npos);
    return at + key.size() + 4;
}

void expectSame(const Plane& actual, const Plane& expected)
{
    EXPECT_EQ(actual.name, expected.name);
    ASSERT_TRUE(actual.sameShape(expected));
    for (size_t i = 0; i < actual.values.size(); ++i) {
        if (std::isnan(expected.values[i]))
            ASSERT_TRUE(std::isnan(actual.values[i]));
        else
            ASSERT_EQ(actual.values[i], expected.values[i]);
    }
}

} // namespace

TEST_F(Exr, RoundTripOfAllShapes)
{
    std::vector<Plane> planes = {makeNoise("Zed", 7, 5, 1), makeNoise("Color", 7, 5, 3),
                                 makeNoise("PositionNDC", 7, 5, 2), makeNoise("All", 160, 120, 4),
                                 makeNoise("Pixel", 1, 1, 1)};
    planes[0].values[3] = std::numeric_limits<double>::quiet_NaN();
    planes[0].values[4] = -std::numeric_limits<double>::infinity();
    planes[0].values[5] = std::numeric_limits<float>::denorm_min();
    writeExr(folder_ / "a.exr", planes, {{"fingerprint", "driver 1.2"}});
    const std::vector<Plane> back = readExr(folder_ / "a.exr");
    ASSERT_EQ(back.size(), planes.size());
    for (size_t i = 0; i < planes.size(); ++i)
        expectSame(back[i], planes[i]);
    EXPECT_NE(readWholeFile(folder_ / "a.exr").find("driver 1.2"), std::string::npos);
    const auto channels = readExrChannels(folder_ / "a.exr");
    EXPECT_EQ(channels.size(), 11U);
    EXPECT_EQ(channels.at("Color.G").at(6, 4), planes[1].at(6, 4, 1));
    size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_))
        ++files;
    EXPECT_EQ(files, 1U); // nothing is left beside it
}

TEST_F(Exr, OnePlaneIsAFileToo)
{
    const std::vector<Plane> planes = {makeNoise("HitDepth", 64, 64, 1)};
    writeExr(folder_ / "one.exr", planes);
    const std::vector<Plane> back = readExr(folder_ / "one.exr");
    ASSERT_EQ(back.size(), 1U);
    expectSame(back[0], planes[0]);
}

TEST_F(Exr, ValuesAreRoundedToFloat)
{
    std::vector<Plane> planes = {Plane("A", 2, 1, 1)};
    planes[0].values = {0.1, 1e300};
    writeExr(folder_ / "a.exr", planes);
    EXPECT_EQ(readExr(folder_ / "a.exr")[0].values[0], static_cast<double>(0.1F));
    EXPECT_EQ(readExr(folder_ / "a.exr")[0].values[1], std::numeric_limits<double>::infinity());
}

TEST_F(Exr, WriterRejectsWhatIsNoImage)
{
    const std::filesystem::path file = folder_ / "a.exr";
    EXPECT_THROW(writeExr(file, {}), InputError);
    EXPECT_THROW(writeExr(file, std::vector<Plane>{Plane("A", 2, 2, 5)}), InputError);
    EXPECT_THROW(writeExr(file, std::vector<Plane>{Plane("A", 0, 2, 1)}), InputError);
    EXPECT_THROW(writeExr(file, std::vector<Plane>{Plane("A", 2, 2, 1), Plane("A", 2, 2, 1)}), InputError);
    EXPECT_THROW(writeExr(file, std::vector<Plane>{Plane("A", 2, 2, 1)}, {{"channels", "mine"}}), InputError);
    EXPECT_THROW(writeExr(folder_ / "no" / "folder" / "a.exr", std::vector<Plane>{Plane("A", 2, 2, 1)}),
                 EnvironmentError);
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Exr, SaysWhatIsWrongWithAFile)
{
    const std::string good = sampleFile(folder_);
    EXPECT_EQ(messageOf(good), "");
    EXPECT_NE(messageOf("").find("not an OpenEXR file"), std::string::npos);
    EXPECT_NE(messageOf("{\"a\": 1, \"b\": [1, 2, 3]}").find("not an OpenEXR file"), std::string::npos);
    EXPECT_NE(messageOf(good.substr(0, 100)).find("truncated inside its header"), std::string::npos);
    EXPECT_NE(messageOf(good.substr(0, good.size() / 2)).find("truncated"), std::string::npos);
    std::string unfinished = good; // as a writer leaves it that was interrupted: no line is in the table yet
    const size_t table = good.rfind("scanlineimage") + 13 + 2; // the last attribute, the ends of part and headers
    std::fill_n(unfinished.begin() + static_cast<std::ptrdiff_t>(table), 400, '\0');
    EXPECT_NE(messageOf(unfinished).find("lacks scan lines"), std::string::npos);
    EXPECT_THROW(readExrChannels(folder_ / "missing.exr"), InputError);
    EXPECT_THROW(readExrChannels(folder_), InputError);
}

TEST_F(Exr, HugeHeadersAreRejectedBeforeAnythingIsAllocated)
{
    const std::string good = sampleFile(folder_);
    const size_t window = valueOf(good, "dataWindow", "box2i");
    const auto withWindow = [&](int32_t x0, int32_t y0, int32_t x1, int32_t y1) {
        std::string bytes = good;
        putInteger(bytes, window, x0);
        putInteger(bytes, window + 4, y0);
        putInteger(bytes, window + 8, x1);
        putInteger(bytes, window + 12, y1);
        return messageOf(bytes);
    };
    EXPECT_NE(withWindow(0, 0, 2000000000, 2000000000).find("2000000001x2000000001"), std::string::npos);
    EXPECT_NE(withWindow(-2147483647 - 1, 0, 2147483647, 10).find("4294967296x11"), std::string::npos);
    EXPECT_NE(withWindow(0, 0, 39999, 39999).find("allowed: 1 to 16384 a side"), std::string::npos);
    EXPECT_NE(withWindow(5, 5, 4, 10).find("0x6"), std::string::npos);
    EXPECT_NE(withWindow(0, 0, 16383, 16383).find("values"), std::string::npos);
    EXPECT_NE(withWindow(0, 0, 4095, 4095).find("cannot hold"), std::string::npos);
    std::string bytes = good;
    putInteger(bytes, window - 4, -1); // the attribute's own length
    EXPECT_NE(messageOf(bytes).find("truncated inside its header"), std::string::npos);
}

// The library reads as many bytes as a type has, whatever the file says: then it takes others for the next attribute's
// length.
TEST_F(Exr, AttributesHaveTheSizeOfTheirType)
{
    const std::string good = sampleFile(folder_);
    for (const auto& [name, type] :
         {std::pair{"displayWindow", "box2i"}, {"pixelAspectRatio", "float"}, {"lineOrder", "lineOrder"}}) {
        for (const int change : {-1, 1}) {
            std::string bytes = good;
            const size_t value = valueOf(bytes, name, type);
            putInteger(bytes, value - 4, bytes[value - 4] + change);
            if (change > 0)
                bytes.insert(value, 1, '\0');
            else
                bytes.erase(value, 1);
            EXPECT_NE(messageOf(bytes).find("which is no"), std::string::npos) << name << ": " << messageOf(bytes);
        }
    }
    std::string early = good; // bytes behind the end of the channel list
    const size_t list = valueOf(good, "channels", "chlist");
    putInteger(early, list - 4, early[list - 4] + 3);
    early.insert(list + static_cast<unsigned char>(good[list - 4]), 3, 'x');
    EXPECT_NE(messageOf(early).find("its channel list"), std::string::npos) << messageOf(early);
    early = good; // and a list that has no end, under another name
    const std::string other("others\0chlist\0\22\0\0\0R\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 36);
    early.insert(8, other);
    EXPECT_NE(messageOf(early).find("its channel list"), std::string::npos) << messageOf(early);
    std::string strings = good; // a list of strings of which one claims two gigabytes
    const std::string attribute = std::string("views\0stringvector\0\5\0\0\0\1\0\0\x7fx", 29);
    strings.insert(8, attribute);
    EXPECT_NE(messageOf(strings).find("\"views\" has 5 bytes"), std::string::npos) << messageOf(strings);
}

// A message is one line on somebody's terminal.
TEST_F(Exr, NamesWithControlCharactersAreRefused)
{
    for (const std::string name : {"R\nG", "\x1b[2J"}) {
        std::string bytes = sampleFile(folder_);
        const size_t at = bytes.find("displayWindow");
        bytes.replace(at, name.size(), name);
        EXPECT_NE(messageOf(bytes).find("a name with control characters"), std::string::npos) << messageOf(bytes);
    }
}

TEST_F(Exr, EveryTruncationIsAnError)
{
    const std::string good = sampleFile(folder_);
    for (size_t length = 0; length < good.size(); length += length < 900 ? 7 : 53)
        EXPECT_NE(messageOf(good.substr(0, length)), "") << length;
}

// Damage is found or the values are others; nothing crashes, hangs or asks for gigabytes.
TEST_F(Exr, DamagedBytesNeverCrash)
{
    const std::string good = sampleFile(folder_);
    RandomStream random(9);
    for (int i = 0; i < 600; ++i) {
        std::string bytes = good;
        const int changes = 1 + static_cast<int>(random.nextBits() % 4);
        for (int c = 0; c < changes; ++c) {
            const size_t reach =
                random.chance(0.7) ? std::min<size_t>(900, bytes.size()) : bytes.size(); // mostly the header
            const size_t at = random.nextBits() % reach;
            bytes[at] = static_cast<char>(random.nextBits() & 0xff);
        }
        (void)messageOf(bytes);
    }
}

TEST_F(Exr, ForeignPartsAreNoPlanes)
{
    const std::filesystem::path blender =
        std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases/real/data/mirror_room/gbuffer.exr";
    EXPECT_THROW(readExr(blender), InputError);
    const auto channels = readExrChannels(blender);
    EXPECT_EQ(channels.size(), 12U);
    EXPECT_EQ(channels.at("ViewLayer.Depth.Z").width, 320);
    EXPECT_EQ(channels.at("ViewLayer.Depth.Z").height, 180);
}
