#include "harness/cli/failure_text.h"
#include "harness/cli/verbs.h"
#include "harness/run/diff.h"
#include "harness/run/run_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <cmath>

namespace crossray {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string nameOrAbsent(const std::optional<Verdict>& verdict)
{
    return verdict ? std::string(nameOf(*verdict)) : "absent";
}

std::string formatPlaneChange(const PlaneChange& change)
{
    if (!change.note.empty()) return fmt::format("{:<16} {}", change.name, change.note);
    const Comparison& comparison = change.comparison;
    if (comparison.passed) return fmt::format("{:<16} the same", change.name);
    std::string text = fmt::format("{:<16} {} of {} px differ", change.name, comparison.failed, comparison.compared);
    if (comparison.worst) {
        const PixelDifference& worst = *comparison.worst;
        const std::string size =
            std::isfinite(worst.error) ? fmt::format(" {:.4g} {}", worst.error, comparison.unit) : "";
        text += fmt::format(", worst{} at ({}, {}): {} -> {}", size, worst.x, worst.y, formatValues(worst.expected, 9),
                            formatValues(worst.actual, 9));
    }
    for (const auto& [kind, count] : comparison.census)
        text += fmt::format("; {} {}", count, kind);
    return text;
}

Json planeChangeToJson(const PlaneChange& change)
{
    Json json{{"plane", change.name}, {"same", change.note.empty() && change.comparison.passed}, {"note", change.note}};
    const Comparison& comparison = change.comparison;
    if (change.note.empty()) {
        json["differ"] = comparison.failed;
        json["compared"] = comparison.compared;
        json["unit"] = comparison.unit;
        json["max"] = comparison.max;
        json["census"] = comparison.census;
        if (comparison.worst) json["worst"] = {{"x", comparison.worst->x}, {"y", comparison.worst->y}};
    }
    return json;
}

int diffPlaneFiles(const fs::path& before, const fs::path& after, bool json)
{
    const std::vector<PlaneChange> changes = comparePlaneFiles(before, after);
    bool same = true;
    Json list = Json::array();
    for (const PlaneChange& change : changes) {
        same = same && change.note.empty() && change.comparison.passed;
        list.push_back(planeChangeToJson(change));
        if (!json) fmt::print("{}\n", formatPlaneChange(change));
    }
    if (json) fmt::print("{}\n", list.dump(1));
    return static_cast<int>(same ? ExitCode::kAsExpected : ExitCode::kFailed);
}

bool isPlaneFile(const std::string& path)
{
    return fs::path(path).extension() == ".exr";
}

RunFolder openRun(const std::string& path)
{
    return {findRunJson(path).parent_path(), readRun(path)};
}

} // namespace

int diffRuns(const GlobalOptions& global, const std::string& before, const std::string& after, bool json)
{
    if (isPlaneFile(before) != isPlaneFile(after)) {
        throw InputError(fmt::format("diff {} {}: allowed are two runs or two .exr files", before, after));
    }
    if (isPlaneFile(before)) return diffPlaneFiles(before, after, json);

    const RunFolder first = openRun(before), second = openRun(after);
    const std::vector<std::string> surroundings = compareFingerprints(first.run, second.run);
    const std::vector<ResultChange> changes = compareRuns(first, second);
    const Style style = Style::choose(global.color, STDOUT_FILENO);
    Json list = Json::array();
    bool verdictChanged = false, planesChanged = false;
    for (const ResultChange& change : changes) {
        verdictChanged = verdictChanged || change.before != change.after;
        planesChanged = planesChanged || !change.planes.empty();
        Json planes = Json::array();
        std::string text = fmt::format("{}  {}  {}", style.paint(Ink::kBold, change.caseName), change.backend,
                                       nameOrAbsent(change.before));
        if (change.before != change.after) text += " -> " + style.paint(Ink::kYellow, nameOrAbsent(change.after));
        text += "\n";
        for (const PlaneChange& plane : change.planes) {
            planes.push_back(planeChangeToJson(plane));
            text += "      " + formatPlaneChange(plane) + "\n";
        }
        list.push_back({{"case", change.caseName},
                        {"backend", change.backend},
                        {"before", nameOrAbsent(change.before)},
                        {"after", nameOrAbsent(change.after)},
                        {"planes", std::move(planes)}});
        if (!json) fmt::print("{}", text);
    }
    if (json) {
        fmt::print("{}\n", Json{{"surroundings", surroundings}, {"changes", std::move(list)}}.dump(1));
    } else {
        for (const std::string& line : surroundings)
            fmt::print("{}\n", style.paint(Ink::kDim, line));
        if (changes.empty()) fmt::print("no verdict and no kept plane differs\n");
    }
    return static_cast<int>(verdictChanged || planesChanged ? ExitCode::kFailed : ExitCode::kAsExpected);
}

} // namespace crossray
