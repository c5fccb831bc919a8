#include "harness/bench/own_tracers.h"
#include "harness/bench/tracer_report.h"
#include "harness/cli/verbs.h"
#include "harness/run/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>

namespace crossray {

namespace {

// "A<separator>B" as two whole numbers.
template <typename Number>
bool readPair(const std::string& text, char separator, Number& first, Number& second)
{
    const char* const end = text.data() + text.size();
    const auto [middle, error] = std::from_chars(text.data(), end, first);
    if (error != std::errc() || middle == end || *middle != separator) return false;
    const auto [stop, secondError] = std::from_chars(middle + 1, end, second);
    return secondError == std::errc() && stop == end;
}

YardstickOptions readOptions(const TracersVerbOptions& options)
{
    YardstickOptions read;
    if (!readPair(options.seeds, '-', read.firstSeed, read.lastSeed) || read.firstSeed > read.lastSeed ||
        read.lastSeed - read.firstSeed >= 10000) {
        throw InputError(fmt::format("--seeds {}: allowed is FIRST-LAST, at most 10000 seeds", options.seeds));
    }
    if (!readPair(options.size, 'x', read.width, read.height) || std::min(read.width, read.height) < 1 ||
        std::max(read.width, read.height) > 16384) {
        throw InputError(fmt::format("--size {}: allowed is WIDTHxHEIGHT, 1 to 16384 each", options.size));
    }
    const auto family = findSceneFamily(options.family);
    if (!family) {
        std::string allowed;
        for (const SceneFamily known : allSceneFamilies())
            allowed += fmt::format("{}{}", allowed.empty() ? "" : "|", nameOf(known));
        throw InputError(fmt::format("--family {}: allowed is {}", options.family, allowed));
    }
    const auto disturbance = findDisturbance(options.disturbance);
    if (!disturbance) {
        std::string allowed;
        for (const Disturbance known : allDisturbances())
            allowed += fmt::format("{}{}", allowed.empty() ? "" : "|", nameOf(known));
        throw InputError(fmt::format("--disturb {}: allowed is {}", options.disturbance, allowed));
    }
    read.family = *family;
    read.disturbance = *disturbance;
    read.stride = options.stride;
    read.threads = options.threads;
    return read;
}

// The protocol's: 0.2 m at 1080 lines, 0.05 m at 360.
double chooseThickness(const TracersVerbOptions& options, int height)
{
    if (options.thickness > 0) return options.thickness;
    return height >= 720 ? 0.2 : 0.05;
}

// The device that tracers of the person's own run on; opened where there is one.
class OwnDevice {
  public:
    OwnDevice(const GlobalOptions& global, const TracersVerbOptions& options)
        : folders_(findFolders(global.shaders, global.cases, global.cache)), compiler_(folders_.cache / "spirv")
    {
        for (const std::string& method : options.methods)
            methods_.push_back(makeOwnMethod(method));
        if (methods_.empty()) return;
        if (options.disturbance != "none") {
            throw InputError(fmt::format(
                "--disturb {}: --method traces what the scene shows; allowed beside it is none", options.disturbance));
        }
        backend_ = chooseBackends(std::vector<std::string>{options.backend}, listBackends()).names.front();
        WorkerOptions workers;
        workers.mesaCacheFolder = folders_.cache / "mesa";
        pool_ = std::make_unique<WorkerPool>(workers);
    }

    // The rows of the person's own tracers.
    std::vector<TracerMethod> makeTracers(double thickness, const std::function<Case(const YardstickScene&)>& caseOf)
    {
        std::vector<TracerMethod> made;
        for (const BenchMethod& method : methods_)
            made.push_back(makeDeviceTracer(method, caseOf, {backend_, *pool_, compiler_, folders_, thickness}));
        return made;
    }

    std::vector<std::string> names() const
    {
        std::vector<std::string> names;
        for (const BenchMethod& method : methods_)
            names.push_back(method.name);
        return names;
    }

  private:
    Folders folders_;
    ShaderCompiler compiler_;
    std::unique_ptr<WorkerPool> pool_;
    std::string backend_;
    std::vector<BenchMethod> methods_;
};

std::vector<TracerMethod> makeMethods(double thickness, const std::string& filter, std::vector<TracerMethod> own)
{
    std::vector<TracerMethod> methods;
    for (auto& group : {libraryTracers(thickness), referenceTracers(thickness)}) {
        for (const TracerMethod& method : group) {
            if (filter.empty() || method.name.find(filter) != std::string::npos) methods.push_back(method);
        }
    }
    for (TracerMethod& method : own) {
        const auto hasName = [&](const TracerMethod& other) { return other.name == method.name; };
        if (std::any_of(methods.begin(), methods.end(), hasName))
            throw InputError(fmt::format("--method {}: the name is taken; names are unique", method.name));
        methods.push_back(std::move(method));
    }
    if (methods.empty()) throw InputError(fmt::format("-k {}: no tracer's name has this in it", filter));
    return methods;
}

} // namespace

int benchTracers(const GlobalOptions& global, const TracersVerbOptions& options)
{
    TracerReportHead head;
    std::vector<MeasuredTracer> rows;
    OwnDevice device(global, options);
    head.own = device.names();
    if (options.testCase.empty()) {
        head.options = readOptions(options);
        head.thickness = chooseThickness(options, head.options.height);
        const uint64_t scenes = head.options.lastSeed - head.options.firstSeed + 1;
        uint64_t done = 0;
        const auto caseOf = [&](const YardstickScene& scene) { return makeFamilyCase(head.options.family, scene); };
        const std::vector<TracerMethod> methods =
            makeMethods(head.thickness, options.filter, device.makeTracers(head.thickness, caseOf));
        rows = measureTracers(methods, head.options, [&](uint64_t seed) {
            fmt::print(stderr, "crossray: {} of {}: seed {}\n", ++done, scenes, seed);
        });
        fmt::print("{}, {}, seeds {}, {}, every {}th pixel both ways, thickness {} m\n\n", options.family,
                   options.disturbance == "none" ? "undisturbed" : options.disturbance, options.seeds, options.size,
                   head.options.stride, head.thickness);
    } else {
        const Folders folders = findFolders(global.shaders, global.cases, global.cache);
        SelectionOptions selection;
        selection.arguments = {options.testCase};
        const SelectedCases selected = selectCases(selection, folders.cases, "", false);
        if (selected.exitCode) return static_cast<int>(*selected.exitCode);
        const CaseData data(selected.cases.front());
        head.scene = selected.cases.front().name;
        head.thickness = chooseThickness(options, data.gbuffer().camera.height);
        const auto caseOf = [&](const YardstickScene&) { return selected.cases.front(); };
        rows = measureTracers(makeMethods(head.thickness, options.filter, device.makeTracers(head.thickness, caseOf)),
                              makeYardstickScene(data));
        fmt::print("{}, thickness {} m\n\n", head.scene, head.thickness);
    }
    fmt::print("{}", formatTracerTable(rows));
    if (!options.json.empty()) writeTextFile(options.json, formatTracerJson(head, rows));
    if (!options.csv.empty()) writeTextFile(options.csv, formatTracerCsv(rows));
    if (!options.charts.empty()) {
        const std::vector<Chart> charts = makeTracerCharts(head, rows);
        writeCharts(options.charts, charts);
        writeTextFile(options.charts + "/reliability_" + charts[0].id.substr(8) + ".svg",
                      formatTracerReliability(head, rows));
    }
    fmt::print("\n{} tracers, {} scenes\n", rows.size(), rows.front().row.scenes);
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
