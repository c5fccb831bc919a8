#include "harness/scene/exr_header.h"

#include "harness/base/error.h"
#include "harness/scene/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace crossray {

namespace {

constexpr uint32_t kMagic = 20000630;
constexpr uint32_t kTiledFlag = 0x200;
constexpr uint32_t kDeepFlag = 0x800;
constexpr uint32_t kMultiPartFlag = 0x1000;
constexpr size_t kMaxName = 255;
// Bytes of pixels that one byte of a file can stand for: zlib ends near 1000, nothing real comes near this.
constexpr long long kMaxCompression = 4096;

// Bytes of the types of one size. The library reads as many whatever the attribute says that it has: where the two
// differ, it would take for sizes what was not held against any bound here.
constexpr std::array<std::pair<std::string_view, uint32_t>, 24> kFixedSizes = {{
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
}};

bool isPrintable(std::string_view text)
{
    return std::none_of(text.begin(), text.end(),
                        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

struct PartHeader {
    long long width = 0;
    long long height = 0;
    int channels = 0;
    bool windowSeen = false;
    bool flat = true;
};

class HeaderReader {
  public:
    HeaderReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

    [[noreturn]] void fail(const std::string& what) const { throw InputError({file_.string(), 0, 0}, what); }

    std::string_view take(size_t count)
    {
        if (count > bytes_.size() - at_) fail("truncated inside its header; allowed: a whole OpenEXR file");
        const std::string_view taken = bytes_.substr(at_, count);
        at_ += count;
        return taken;
    }

    uint32_t takeInteger() { return integerAt(take(4), 0); }

    std::string_view takeName()
    {
        const size_t end = bytes_.find('\0', at_);
        if (end == std::string_view::npos) fail("truncated inside its header; allowed: a whole OpenEXR file");
        if (end - at_ > kMaxName) fail("damaged header: a name of more than 255 bytes; allowed: a whole OpenEXR file");
        const std::string_view name = bytes_.substr(at_, end - at_);
        checkName(name);
        at_ = end + 1;
        return name;
    }

    // One part's attributes, up to the empty name that ends them. False when that comes first: there is no part.
    bool takePart(PartHeader& part)
    {
        for (bool first = true;; first = false) {
            const std::string_view name = takeName();
            if (name.empty()) return !first;
            const std::string_view type = takeName();
            const std::string_view value = take(takeInteger());
            checkSize(name, type, value);
            if (name == "dataWindow" && type == "box2i") readWindow(value, part);
            if (type == "chlist") countChannels(value, part); // under any name: its end is where the library stops
            if (name == "name") checkName(value);
            if (name == "type") part.flat = value == "scanlineimage";
        }
    }

    static uint32_t integerAt(std::string_view bytes, size_t at)
    {
        uint32_t result = 0;
        for (size_t i = 4; i-- > 0;)
            result = (result << 8) | static_cast<unsigned char>(bytes[at + i]);
        return result;
    }

  private:
    // Names are told in messages.
    void checkName(std::string_view name) const
    {
        if (!isPrintable(name)) fail("damaged header: a name with control characters; allowed: a whole OpenEXR file");
    }

    // Whether the library reads just these bytes of the attribute.
    void checkSize(std::string_view name, std::string_view type, std::string_view value) const
    {
        const auto fixed = std::find_if(kFixedSizes.begin(), kFixedSizes.end(),
                                        [&](const auto& entry) { return entry.first == type; });
        bool isWhole = fixed == kFixedSizes.end() || value.size() == fixed->second;
        if (type == "floatvector") isWhole = value.size() % 4 == 0;
        if (type == "stringvector") isWhole = holdsStrings(value);
        if (type == "preview") {
            const uint64_t pixels = value.size() < 8 ? 0 : uint64_t{integerAt(value, 0)} * integerAt(value, 4);
            isWhole = value.size() >= 8 && pixels <= value.size() && value.size() == 8 + 4 * pixels;
        }
        // Packed, and of any size once it is unpacked.
        if (type == "idmanifest") fail("an ID manifest, as deep images have them; allowed: flat scan lines");
        if (!isWhole)
            fail(fmt::format("damaged header: \"{}\" has {} bytes, which is no {}; allowed: a whole OpenEXR file", name,
                             value.size(), type));
    }

    // Each behind its length.
    static bool holdsStrings(std::string_view value)
    {
        while (!value.empty()) {
            if (value.size() < 4 || integerAt(value, 0) > value.size() - 4) return false;
            value.remove_prefix(4 + size_t{integerAt(value, 0)});
        }
        return true;
    }

    void readWindow(std::string_view value, PartHeader& part)
    {
        if (value.size() != 16) fail("damaged header: its data window is no box; allowed: a whole OpenEXR file");
        const auto coordinate = [&](size_t i) {
            return static_cast<long long>(static_cast<int32_t>(integerAt(value, 4 * i)));
        };
        part.width = coordinate(2) - coordinate(0) + 1;
        part.height = coordinate(3) - coordinate(1) + 1;
        part.windowSeen = true;
        if (part.width < 1 || part.height < 1 || part.width > kMaxExrSide || part.height > kMaxExrSide)
            fail(
                fmt::format("an image of {}x{} pixels; allowed: 1 to {} a side", part.width, part.height, kMaxExrSide));
    }

    // A list of name, pixel type, flags and samplings (16 bytes), ended by an empty name.
    void countChannels(std::string_view value, PartHeader& part)
    {
        size_t at = 0;
        while (at < value.size() && value[at] != '\0') {
            const size_t end = value.find('\0', at);
            if (end == std::string_view::npos || value.size() - end < 17)
                fail("damaged header: its channel list has no end; allowed: a whole OpenEXR file");
            checkName(value.substr(at, end - at));
            if (integerAt(value, end + 9) != 1 || integerAt(value, end + 13) != 1)
                fail(fmt::format("channel \"{}\" is subsampled; allowed: one value a pixel",
                                 value.substr(at, end - at)));
            if (++part.channels > kMaxExrChannels)
                fail(fmt::format("more than {0} channels; allowed: 1 to {0}", kMaxExrChannels));
            at = end + 17;
        }
        if (at + 1 != value.size())
            fail("damaged header: its channel list has no end, or ends early; allowed: a whole OpenEXR file");
    }

    const std::filesystem::path& file_;
    std::string_view bytes_;
    size_t at_ = 0;
};

} // namespace

void checkExrHeader(const std::filesystem::path& file, std::string_view bytes)
{
    HeaderReader reader(file, bytes);
    if (bytes.size() < 8 || reader.takeInteger() != kMagic) reader.fail("not an OpenEXR file; allowed: OpenEXR 2");
    const uint32_t version = reader.takeInteger();
    if ((version & 0xff) != 2) reader.fail(fmt::format("OpenEXR version {}; allowed: 2", version & 0xff));
    if ((version & (kTiledFlag | kDeepFlag)) != 0) reader.fail("a tiled or deep image; allowed: flat scan lines");
    long long values = 0;
    int channels = 0;
    const bool multiPart = (version & kMultiPartFlag) != 0;
    for (int parts = 0;; ++parts) {
        PartHeader part;
        if (!reader.takePart(part)) {
            if (parts == 0) reader.fail("its header is empty; allowed: a whole OpenEXR file");
            break;
        }
        if (!part.flat) reader.fail("a tiled or deep image; allowed: flat scan lines");
        if (!part.windowSeen || part.channels == 0)
            reader.fail("its header names no image size or no channel; allowed: a whole OpenEXR file");
        channels += part.channels;
        values += part.width * part.height * part.channels;
        if (channels > kMaxExrChannels)
            reader.fail(fmt::format("more than {0} channels; allowed: 1 to {0}", kMaxExrChannels));
        if (values > kMaxExrValues)
            reader.fail(
                fmt::format("{} values (pixels times channels) or more; allowed: up to {}", values, kMaxExrValues));
        if (!multiPart) break;
    }
    if (2 * values / kMaxCompression > static_cast<long long>(bytes.size()))
        reader.fail(fmt::format("truncated: {} bytes cannot hold {} values; allowed: a whole OpenEXR file",
                                bytes.size(), values));
}

} // namespace crossray
