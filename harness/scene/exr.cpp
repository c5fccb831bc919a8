#include "harness/scene/exr.h"

#include "harness/base/error.h"
#include "harness/scene/exr_header.h"
#include "harness/scene/file_io.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <set>

namespace crossray {

namespace {

constexpr size_t kUncompressedValues = 1 << 16; // 256 KiB

// A file in memory: it is read once, so that what was checked is what is decoded.
class MemoryInput final : public Imf::IStream {
  public:
    MemoryInput(const std::string& name, std::string_view bytes) : Imf::IStream(name.c_str()), bytes_(bytes) {}

    bool read(char target[], int count) override
    {
        if (count < 0 || at_ > bytes_.size() || static_cast<size_t>(count) > bytes_.size() - at_)
            throw std::runtime_error("the data end too early");
        std::memcpy(target, bytes_.data() + at_, static_cast<size_t>(count));
        at_ += static_cast<size_t>(count);
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t position) override { at_ = position; }

  private:
    std::string_view bytes_;
    size_t at_ = 0;
};

// The library writes its offset tables in a destructor, where a full disk would go unnoticed: so it writes to memory.
class MemoryOutput final : public Imf::OStream {
  public:
    MemoryOutput() : Imf::OStream("memory") {}
    void write(const char source[], int count) override
    {
        const size_t end = at_ + static_cast<size_t>(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + at_, source, static_cast<size_t>(count));
        at_ = end;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t position) override { at_ = position; }
    std::string_view bytes() const { return bytes_; }

  private:
    std::string bytes_;
    size_t at_ = 0;
};

std::span<const char* const> channelNames(int channels)
{
    static constexpr std::array<const char*, 1> kOne = {"Y"};
    static constexpr std::array<const char*, 2> kTwo = {"X", "Y"};
    static constexpr std::array<const char*, 4> kColor = {"R", "G", "B", "A"};
    if (channels == 1) return kOne;
    if (channels == 2) return kTwo;
    if (channels == 3 || channels == 4) return std::span(kColor).first(static_cast<size_t>(channels));
    return {};
}

// One channel's values as the file holds them: four bytes each, a float (half is widened) or an unsigned integer.
struct RawChannel {
    std::string name;
    bool isInteger = false;
    std::vector<uint32_t> bits;

    double value(size_t i) const
    {
        return isInteger ? static_cast<double>(bits[i]) : static_cast<double>(std::bit_cast<float>(bits[i]));
    }
};

struct Part {
    std::string name; // "" where the file gives none
    int width = 0;
    int height = 0;
    std::vector<RawChannel> channels; // in alphabetic order
};

Part readPart(Imf::MultiPartInputFile& input, int number)
{
    const Imf::Header& header = input.header(number);
    const Imath::Box2i window = header.dataWindow();
    Part part;
    if (header.hasName()) part.name = header.name();
    part.width = window.max.x - window.min.x + 1;
    part.height = window.max.y - window.min.y + 1;
    const size_t count = static_cast<size_t>(part.width) * static_cast<size_t>(part.height);
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        part.channels.push_back({channel.name(), channel.channel().type == Imf::UINT, std::vector<uint32_t>(count)});
    Imf::FrameBuffer frame;
    for (RawChannel& channel : part.channels)
        frame.insert(channel.name,
                     Imf::Slice::Make(channel.isInteger ? Imf::UINT : Imf::FLOAT, channel.bits.data(), window,
                                      sizeof(uint32_t), sizeof(uint32_t) * static_cast<size_t>(part.width)));
    Imf::InputPart pixels(input, number);
    pixels.setFrameBuffer(frame);
    pixels.readPixels(window.min.y, window.max.y);
    return part;
}

std::vector<Part> readParts(const std::filesystem::path& file)
{
    const SourcePosition position{file.string(), 0, 0};
    const std::string bytes = readWholeFile(file);
    checkExrHeader(file, bytes);
    try {
        MemoryInput stream(file.string(), bytes);
        Imf::MultiPartInputFile input(stream, 0, false);
        std::vector<Part> parts;
        for (int i = 0; i < input.parts(); ++i) {
            if (!input.partComplete(i))
                throw InputError(position, "truncated: it lacks scan lines; allowed: a whole OpenEXR file");
            parts.push_back(readPart(input, i));
        }
        return parts;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) { // the library's own, of many types
        std::string reason = error.what();
        if (const size_t named = reason.find("\". "); named != std::string::npos)
            reason.erase(0, named + 3); // the file
        std::replace_if(
            reason.begin(), reason.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
        throw InputError(position, fmt::format("truncated or damaged ({}); allowed: a whole OpenEXR file", reason));
    }
}

std::string describeShape(const Plane& plane)
{
    return fmt::format("{}x{}, {} channels", plane.width, plane.height, plane.channels);
}

void checkPlanes(const std::filesystem::path& file, std::span<const Plane> planes)
{
    const auto fail = [&](const std::string& what) { throw InputError({file.string(), 0, 0}, what); };
    if (planes.empty()) fail("nothing to write; allowed: at least one plane");
    std::set<std::string> names;
    for (const Plane& plane : planes) {
        if (plane.name.empty() || !names.insert(plane.name).second)
            fail(fmt::format("two planes share the name \"{}\", or it is empty; allowed: a name for each", plane.name));
        const bool sized =
            plane.width >= 1 && plane.width <= kMaxExrSide && plane.height >= 1 && plane.height <= kMaxExrSide;
        if (!sized || channelNames(plane.channels).empty() ||
            plane.values.size() != plane.pixelCount() * static_cast<size_t>(plane.channels))
            fail(fmt::format(
                "plane \"{}\" is {} with {} values; allowed: 1 to {} pixels a side, 1 to 4 channels, a value for each",
                plane.name, describeShape(plane), plane.values.size(), kMaxExrSide));
    }
}

std::vector<Imf::Header> makeHeaders(std::span<const Plane> planes,
                                     const std::map<std::string, std::string>& attributes)
{
    // All parts must share one display window; their own sizes are the data windows.
    Imath::V2i corner(0, 0);
    for (const Plane& plane : planes)
        corner = {std::max(corner.x, plane.width - 1), std::max(corner.y, plane.height - 1)};
    std::vector<Imf::Header> headers;
    for (const Plane& plane : planes) {
        Imf::Header header(Imath::Box2i({0, 0}, corner), Imath::Box2i({0, 0}, {plane.width - 1, plane.height - 1}));
        header.setName(plane.name);
        header.setType(Imf::SCANLINEIMAGE);
        // Small planes are written once a case and backend: whole as they are they take a quarter of the time. For
        // large ones the disk is what costs, and the higher levels gain little.
        const bool large = plane.values.size() > kUncompressedValues;
        header.compression() = large ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
        header.zipCompressionLevel() = 1;
        for (const char* name : channelNames(plane.channels))
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        headers.push_back(header);
    }
    for (const auto& [name, text] : attributes)
        headers.front().insert(name, Imf::StringAttribute(text));
    return headers;
}

void writePart(Imf::MultiPartOutputFile& output, int number, const Plane& plane)
{
    const std::vector<float> values(plane.values.begin(), plane.values.end());
    const size_t pixelBytes = sizeof(float) * static_cast<size_t>(plane.channels);
    Imf::FrameBuffer frame;
    size_t channel = 0;
    for (const char* name : channelNames(plane.channels))
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data() + channel++, {0, 0}, plane.width, plane.height,
                                            pixelBytes, pixelBytes * static_cast<size_t>(plane.width)));
    Imf::OutputPart pixels(output, number);
    pixels.setFrameBuffer(frame);
    pixels.writePixels(plane.height);
}

} // namespace

void writeExr(const std::filesystem::path& file, std::span<const Plane> planes,
              const std::map<std::string, std::string>& attributes)
{
    checkPlanes(file, planes);
    MemoryOutput stream;
    try {
        const std::vector<Imf::Header> headers = makeHeaders(planes, attributes);
        Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()), false, 0);
        for (size_t i = 0; i < planes.size(); ++i)
            writePart(output, static_cast<int>(i), planes[i]);
    } catch (const std::exception& error) { // an attribute whose name is the format's own
        throw InputError({file.string(), 0, 0}, fmt::format("cannot be written as OpenEXR: {}", error.what()));
    }
    writeWholeFile(file, stream.bytes());
}

std::vector<Plane> readExr(const std::filesystem::path& file)
{
    std::vector<Plane> planes;
    for (const Part& part : readParts(file)) {
        const auto names = channelNames(static_cast<int>(part.channels.size()));
        Plane plane(part.name, part.width, part.height, static_cast<int>(part.channels.size()));
        size_t slot = 0;
        for (const char* name : names) {
            const auto channel = std::find_if(part.channels.begin(), part.channels.end(),
                                              [&](const RawChannel& candidate) { return candidate.name == name; });
            if (channel == part.channels.end()) break;
            for (size_t i = 0; i < plane.pixelCount(); ++i)
                plane.values[i * names.size() + slot] = channel->value(i);
            ++slot;
        }
        if (part.name.empty() || names.empty() || slot != names.size())
            throw InputError(
                {file.string(), 0, 0},
                fmt::format("part \"{}\" is no plane of this program; allowed: a name and the channels Y, X Y, "
                            "R G B or R G B A",
                            part.name));
        planes.push_back(std::move(plane));
    }
    return planes;
}

std::map<std::string, Plane> readExrChannels(const std::filesystem::path& file)
{
    const std::vector<Part> parts = readParts(file);
    std::map<std::string, Plane> channels;
    for (const Part& part : parts)
        for (const RawChannel& channel : part.channels) {
            const std::string name = part.name.empty() ? channel.name : part.name + "." + channel.name;
            Plane plane(name, part.width, part.height, 1);
            for (size_t i = 0; i < plane.values.size(); ++i)
                plane.values[i] = channel.value(i);
            channels.insert_or_assign(name, std::move(plane));
        }
    return channels;
}

} // namespace crossray
