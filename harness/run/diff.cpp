#include "harness/run/diff.h"

#include "harness/scene/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace crossray {

namespace fs = std::filesystem;

namespace {

// The tightest bound that each type knows, so that every difference is counted.
Tolerance exactTolerance(OutputType type)
{
    Tolerance tolerance;
    if (type == OutputType::kDirection) {
        tolerance.degrees = 0;
    } else if (type != OutputType::kHitClass && type != OutputType::kCount) {
        tolerance.absolute = 0;
    }
    return tolerance;
}

const Plane* findPlane(const std::vector<Plane>& planes, const std::string& name)
{
    const auto found =
        std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

PlaneChange comparePlanes(const Plane& before, const Plane& after)
{
    PlaneChange change{before.name, {}, {}};
    if (!before.sameShape(after)) {
        change.note = fmt::format("{}x{}x{} became {}x{}x{}", before.width, before.height, before.channels, after.width,
                                  after.height, after.channels);
        return change;
    }
    if (before.values == after.values) { // NaNs differ from themselves and are looked at below
        change.comparison.passed = true;
        change.comparison.compared = before.pixelCount();
        return change;
    }
    const auto output = findOutput(before.name.substr(0, before.name.find('@')));
    const OutputType type = output ? output->type : OutputType::kScalar;
    change.comparison = compare(type, before, after, Mask{}, exactTolerance(type));
    return change;
}

struct ResultKey {
    std::string caseName, backend;
    auto operator<=>(const ResultKey&) const = default;
};

std::map<ResultKey, const BackendResult*> indexResults(const RunResult& run)
{
    std::map<ResultKey, const BackendResult*> index;
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends)
            index[{testCase.name, result.backend}] = &result;
    }
    return index;
}

} // namespace

std::vector<PlaneChange> comparePlaneFiles(const fs::path& before, const fs::path& after)
{
    const std::vector<Plane> first = readExr(before), second = readExr(after);
    std::vector<PlaneChange> changes;
    for (const Plane& plane : first) {
        const Plane* other = findPlane(second, plane.name);
        changes.push_back(other != nullptr ? comparePlanes(plane, *other)
                                           : PlaneChange{plane.name, "only in the first", {}});
    }
    for (const Plane& plane : second) {
        if (findPlane(first, plane.name) == nullptr) changes.push_back({plane.name, "only in the second", {}});
    }
    return changes;
}

std::vector<ResultChange> compareRuns(const RunFolder& before, const RunFolder& after)
{
    const auto first = indexResults(before.run), second = indexResults(after.run);
    std::map<ResultKey, ResultChange> changes;
    for (const auto& [key, result] : first)
        changes[key].before = result->verdict;
    for (const auto& [key, result] : second)
        changes[key].after = result->verdict;
    std::vector<ResultChange> list;
    for (auto& [key, change] : changes) {
        change.caseName = key.caseName;
        change.backend = key.backend;
        const auto a = first.find(key), b = second.find(key);
        if (a != first.end() && b != second.end() && !a->second->planesFile.empty() && !b->second->planesFile.empty()) {
            change.planes =
                comparePlaneFiles(before.folder / a->second->planesFile, after.folder / b->second->planesFile);
            std::erase_if(change.planes,
                          [](const PlaneChange& plane) { return plane.note.empty() && plane.comparison.passed; });
        }
        if (change.before != change.after || !change.planes.empty()) list.push_back(std::move(change));
    }
    return list;
}

std::vector<std::string> compareFingerprints(const RunResult& before, const RunResult& after)
{
    std::vector<std::string> lines;
    auto note = [&](const std::string& what, const std::string& a, const std::string& b) {
        if (a != b) lines.push_back(fmt::format("{}: {} -> {}", what, a, b));
    };
    for (const auto& [name, record] : before.backends) {
        const auto other = after.backends.find(name);
        if (other == after.backends.end()) continue;
        const Fingerprint &a = record.fingerprint, &b = other->second.fingerprint;
        note(name + " device", a.device, b.device);
        note(name + " driver", a.driver, b.driver);
        note(name + " cpu", a.cpu, b.cpu);
    }
    for (const auto& [name, version] : before.compilers) {
        const auto other = after.compilers.find(name);
        if (other != after.compilers.end()) note(name, version, other->second);
    }
    note("commit", before.commit, after.commit);
    return lines;
}

} // namespace crossray
