// OpenEXR: our planes and anybody's channels. Planes that are read can be written, and come back as they were.
#include "tests/fuzz/targets/target.h"

#include "harness/base/temporary_folder.h"
#include "harness/scene/exr.h"

#include <bit>

using namespace crossray;

namespace {

constexpr size_t kMostRewritten = 1 << 16; // values; beyond that it is the disk that is tested

bool isSame(const Plane& a, const Plane& b)
{
    if (a.name != b.name || a.width != b.width || a.height != b.height || a.channels != b.channels) return false;
    for (size_t i = 0; i < a.values.size(); ++i) {
        const auto before = static_cast<float>(a.values[i]), after = static_cast<float>(b.values[i]);
        if (std::bit_cast<uint32_t>(before) != std::bit_cast<uint32_t>(after) && !(before != before && after != after))
            return false;
    }
    return true;
}

void checkRewritten(const std::vector<Plane>& planes)
{
    static const TemporaryFolder folder("fuzz-exr");
    size_t values = 0;
    for (const Plane& plane : planes)
        values += plane.values.size();
    if (values > kMostRewritten) return;
    const std::filesystem::path file = folder.path() / "again.exr";
    try {
        writeExr(file, planes);
    } catch (const InputError&) {
        return; // two parts of one name
    }
    const std::vector<Plane> again = readExr(file);
    fuzz::expect(again.size() == planes.size(), "as many planes come back as were written");
    for (size_t i = 0; i < planes.size(); ++i)
        fuzz::expect(isSame(planes[i], again[i]), "a plane comes back as it was written");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const fuzz::MemoryFile file(fuzz::textOf(data, size));
    const auto channels = fuzz::readOrRefuse([&] { return readExrChannels(file.path()); }, file.path().string());
    const auto planes = fuzz::readOrRefuse([&] { return readExr(file.path()); }, file.path().string());
    fuzz::expect(channels.has_value() || !planes.has_value(), "what holds our planes holds channels");
    if (planes) checkRewritten(*planes);
    return 0;
}
