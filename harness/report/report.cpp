#include "harness/report/report.h"

#include "harness/base/error.h"
#include "harness/report/page.h"
#include "harness/report/plane_data.h"
#include "harness/report/report_index.h"
#include "harness/run/plane_files.h"
#include "harness/run/run_json.h"
#include "harness/scene/exr.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace crossray {

namespace fs = std::filesystem;

namespace {

constexpr size_t kChunkBytes = 256 << 10; // of passed cases' details in one piece
constexpr size_t kMaxLeftOutLines = 40;
constexpr std::string_view kTraceSchema = "crossray-trace/1";
constexpr std::string_view kBenchSchemas[] = {"crossray-bench/1", "crossray-tracers/1", "crossray-sweep/1",
                                              "crossray-mutation/1"};

// The planes of one case that a report may hold, the most telling first.
struct PlaneSource {
    size_t caseIndex = 0;
    std::string name; // "expected", or a backend
    std::string file; // below the run's folder
};

// Where a run with --conditioning keeps what it measured of a case: beside the case's other planes.
std::string conditioningFile(const CaseResult& testCase)
{
    std::string known = testCase.expectedFile;
    for (const BackendResult& result : testCase.backends) {
        if (known.empty()) known = result.planesFile;
    }
    return known.empty() ? "" : (fs::path(known).parent_path() / "conditioning.exr").generic_string();
}

class Report {
  public:
    Report(const RunResult& run, const ReportOptions& options, const ReadPlanes& readPlanes, const WriteFile& writeFile)
        : run_(run), options_(options), readPlanes_(readPlanes), writeFile_(writeFile)
    {
        index_.cases.resize(run.cases.size());
        index_.leftOut = options.leftOut;
    }

    ReportSummary make()
    {
        addTraces();
        addBenches();
        addCubemaps();
        addDetails(true);
        addDetails(false);
        if (options_.isSingle) checkRoom();
        addAtlas();
        for (const bool ofFailures : {true, false})
            addPlanes(ofFailures);
        tellLeftOut();
        write("index.html", formatPage(title(), finishPieces()));
        summary_.leftOut = index_.leftOut;
        return std::move(summary_);
    }

  private:
    std::string title() const { return fmt::format("crossray: {}", formatCounts(countVerdicts(run_))); }

    void write(const std::string& file, const std::string& content)
    {
        writeFile_(file, content);
        ++summary_.files;
        summary_.bytes += content.size();
    }

    void add(PageData piece)
    {
        if (options_.isSingle) {
            inlinedBytes_ += sizeInPage(piece);
            inlined_.push_back(std::move(piece));
        } else {
            write("data/" + piece.name + ".js", formatDataScript(piece));
        }
    }

    static size_t sizeInPage(const PageData& piece)
    {
        constexpr size_t kTags = 80;
        return escapeForScript(piece.json).size() + piece.name.size() + kTags;
    }

    // Of the single file, with the lines about what is left out. Each piece takes a name in the index as well.
    size_t roomLeft() const
    {
        constexpr size_t kForLeftOut = 32 << 10;
        constexpr size_t kNameInIndex = 64;
        const size_t used = shellBytes_ + inlinedBytes_ + kNameInIndex * inlined_.size() + kForLeftOut;
        return used < options_.maxBytes ? options_.maxBytes - used : 0;
    }

    void measureShell()
    {
        const PageData index{"index", formatIndexJson(run_, options_, index_)};
        shellBytes_ = formatPage(title(), {}).size() + sizeInPage(index);
    }

    void addTraces()
    {
        for (const ReportInput& trace : options_.traces) {
            TracePiece piece;
            try {
                const nlohmann::json json = nlohmann::json::parse(trace.json);
                if (json.at("schema") != kTraceSchema) throw InputError("its schema is another");
                piece.caseName = json.at("case").get<std::string>();
                piece.x = json.at("pixel").at(0).get<int>();
                piece.y = json.at("pixel").at(1).get<int>();
                for (const auto& record : json.at("backends"))
                    piece.backends.push_back(record.at("backend").get<std::string>());
            } catch (const std::exception& error) {
                throw InputError({trace.name, 0, 0}, fmt::format("is no {}, which `crossray trace --json` prints: {}",
                                                                 kTraceSchema, error.what()));
            }
            piece.piece = fmt::format("trace-{}", index_.traces.size());
            PageData data{piece.piece, trace.json};
            if (!hasRoomForTrace(trace, data)) {
                index_.leftOut.push_back(fmt::format("trace of {}: pixel {}, {}", piece.caseName, piece.x, piece.y));
                continue;
            }
            add(std::move(data));
            index_.traces.push_back(std::move(piece));
        }
    }

    // Traces come first and are mostly small; one of thousands of steps shall not take the planes' place.
    bool hasRoomForTrace(const ReportInput& trace, const PageData& data) const
    {
        constexpr size_t kShare = 4;
        if (!options_.isSingle || !trace.isOfRun) return true;
        return inlinedBytes_ + sizeInPage(data) <= options_.maxBytes / kShare;
    }

    void addBenches()
    {
        for (const ReportInput& bench : options_.benches) {
            const nlohmann::json json = nlohmann::json::parse(bench.json, nullptr, false);
            const bool isNamed = json.is_object() && json.contains("schema") && json["schema"].is_string();
            const std::string schema = isNamed ? json["schema"].get<std::string>() : "";
            if (std::find(std::begin(kBenchSchemas), std::end(kBenchSchemas), schema) == std::end(kBenchSchemas)) {
                throw InputError(
                    {bench.name, 0, 0},
                    fmt::format(
                        "its schema is \"{}\"; allowed are {}: what bench, bench tracers, sweep and mutate write",
                        schema, fmt::join(kBenchSchemas, ", ")));
            }
            index_.benches.push_back(fmt::format("bench-{}", index_.benches.size()));
            add({index_.benches.back(), json.dump()});
        }
    }

    void addCubemaps()
    {
        for (const ReportCubemap& item : options_.cubemaps) {
            const std::string piece = fmt::format("cubemap-{}", index_.cubemaps.size());
            add({piece, encodeCubemap(item.cubemap)});
            index_.cubemaps.emplace_back(item.name, piece);
        }
    }

    // A hundredth of a single file, so that it comes before the planes.
    void addAtlas()
    {
        if (options_.atlas.empty()) return;
        addIfThereIsRoom(makeAtlasTexts(options_.atlas), index_.atlas, "the atlas of where methods fail");
        if (index_.atlas.empty()) return;
        index_.atlasCases = findAtlasCases(options_.atlas);
        addIfThereIsRoom(makeAtlasPictures(options_.atlas), index_.atlasPictures, "the pictures of the atlas");
    }

    void addIfThereIsRoom(PageData piece, std::string& nameInIndex, const char* what)
    {
        if (options_.isSingle && sizeInPage(piece) > roomLeft()) {
            index_.leftOut.push_back(what);
            return;
        }
        nameInIndex = piece.name;
        add(std::move(piece));
    }

    // Failures in pieces of their own, so that one is read quickly; the others many at once.
    void addDetails(bool ofFailures)
    {
        std::string json;
        const auto flush = [&] {
            if (!json.empty()) add({fmt::format("cases-{}", pieces_++), "[" + json + "]"});
            json.clear();
        };
        for (size_t i = 0; i < run_.cases.size(); ++i) {
            if (hasFailed(run_.cases[i]) != ofFailures) continue;
            const std::string text = formatCaseJson(run_.cases[i]);
            if (!json.empty() && (ofFailures || json.size() + text.size() > kChunkBytes)) flush();
            json += (json.empty() ? "" : ",\n") + text;
            index_.cases[i].details = fmt::format("cases-{}", pieces_);
        }
        flush();
    }

    // Without room for the details of what passed, the list of cases still tells.
    void checkRoom()
    {
        measureShell();
        if (roomLeft() > 0) return;
        size_t left = 0;
        for (size_t i = 0; i < run_.cases.size(); ++i) {
            if (hasFailed(run_.cases[i]) || index_.cases[i].details.empty()) continue;
            const std::string piece = index_.cases[i].details;
            const auto found = std::find_if(inlined_.begin(), inlined_.end(),
                                            [&](const PageData& data) { return data.name == piece; });
            if (found != inlined_.end()) {
                inlinedBytes_ -= sizeInPage(*found);
                inlined_.erase(found);
            }
            index_.cases[i].details.clear();
            ++left;
        }
        index_.leftOut.push_back(fmt::format("expectations of {} cases that passed", left));
        if (roomLeft() > 0) return;
        throw InputError(fmt::format("--single: the list of {} cases alone is over {} MB; allowed is a folder report",
                                     run_.cases.size(), options_.maxBytes / 1'000'000));
    }

    // Expected planes and failures come before what passed beside them.
    std::vector<PlaneSource> listSources(size_t caseIndex) const
    {
        const CaseResult& testCase = run_.cases[caseIndex];
        std::vector<PlaneSource> sources;
        if (!testCase.expectedFile.empty()) sources.push_back({caseIndex, "expected", testCase.expectedFile});
        for (const bool failed : {true, false}) {
            for (const BackendResult& result : testCase.backends) {
                if (result.planesFile.empty() || (tallyOf(result.verdict) == Tally::kFailed) != failed) continue;
                sources.push_back({caseIndex, result.backend, result.planesFile});
            }
        }
        const std::string conditioning = conditioningFile(testCase);
        if (!conditioning.empty() && options_.hasFile && options_.hasFile(conditioning))
            sources.push_back({caseIndex, "conditioning", conditioning});
        return sources;
    }

    void addPlanes(bool ofFailures)
    {
        for (size_t i = 0; i < run_.cases.size(); ++i) {
            if (hasFailed(run_.cases[i]) != ofFailures) continue;
            const std::vector<PlaneSource> sources = listSources(i);
            if (options_.isSingle && !ofFailures) {
                casesWithoutPlanes_ += sources.empty() ? 0 : 1;
                continue;
            }
            PlaneEncoder encoder;
            size_t number = 0;
            for (const PlaneSource& source : sources)
                addSource(source, number++, encoder);
        }
    }

    void addSource(const PlaneSource& source, size_t number, PlaneEncoder& encoder)
    {
        PageData piece{fmt::format("planes-{}-{}", source.caseIndex, number),
                       encoder.encode(source.name, readPlanes_(source.file))};
        if (options_.isSingle && sizeInPage(piece) > roomLeft()) {
            encoder.forget(source.name);
            leftOutPlanes_.push_back(fmt::format("planes of {}: {}", run_.cases[source.caseIndex].name, source.name));
            return;
        }
        index_.cases[source.caseIndex].planes[source.name] = piece.name;
        add(std::move(piece));
    }

    void tellLeftOut()
    {
        const size_t told = std::min(leftOutPlanes_.size(), kMaxLeftOutLines);
        index_.leftOut.insert(index_.leftOut.end(), leftOutPlanes_.begin(),
                              leftOutPlanes_.begin() + static_cast<std::ptrdiff_t>(told));
        if (told < leftOutPlanes_.size()) {
            index_.leftOut.push_back(fmt::format("planes of {} more", leftOutPlanes_.size() - told));
        }
        if (casesWithoutPlanes_ > 0) {
            index_.leftOut.push_back(fmt::format("planes of {} cases without a failure", casesWithoutPlanes_));
        }
    }

    std::vector<PageData> finishPieces()
    {
        std::vector<PageData> pieces{{"index", formatIndexJson(run_, options_, index_)}};
        std::move(inlined_.begin(), inlined_.end(), std::back_inserter(pieces));
        return pieces;
    }

    const RunResult& run_;
    const ReportOptions& options_;
    const ReadPlanes& readPlanes_;
    const WriteFile& writeFile_;
    ReportIndex index_;
    ReportSummary summary_;
    std::vector<PageData> inlined_;
    size_t inlinedBytes_ = 0, shellBytes_ = 0;
    size_t pieces_ = 0;
    std::vector<std::string> leftOutPlanes_;
    size_t casesWithoutPlanes_ = 0;
};

void makeFolder(const fs::path& folder)
{
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) {
        throw EnvironmentError(fmt::format("{}: the folder cannot be made: {}", folder.string(), failure.message()));
    }
}

// Data of an earlier report, and nothing else.
void removeOldData(const fs::path& folder)
{
    const fs::path data = folder / "data";
    std::error_code failure;
    if (!fs::exists(data, failure)) return;
    for (const auto& entry : fs::directory_iterator(data)) {
        const std::string name = entry.path().filename().string();
        const bool isOurs = entry.is_regular_file() && name.ends_with(".js") &&
                            (name.starts_with("cases-") || name.starts_with("planes-") || name.starts_with("trace-") ||
                             name.starts_with("bench-") || name.starts_with("cubemap-") || name.starts_with("atlas"));
        if (!isOurs) {
            throw InputError(
                fmt::format("{}: holds {}, which no report has written; choose another --output", data.string(), name));
        }
    }
    fs::remove_all(data, failure);
    if (failure) {
        throw EnvironmentError(fmt::format("{}: cannot be removed: {}", data.string(), failure.message()));
    }
}

// Those that a person gave come first, and so are shown where both are of a pixel.
void addTracesOfRun(const RunResult& run, const fs::path& runFolder, ReportOptions& options)
{
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends) {
            if (result.traceFile.empty()) continue;
            const fs::path file = runFolder / result.traceFile;
            std::ifstream stream(file, std::ios::binary);
            if (!stream) throw InputError({file.string(), 0, 0}, "there is no such file, and run.json names it");
            std::ostringstream content;
            content << stream.rdbuf();
            options.traces.push_back({file.string(), content.str(), true});
        }
    }
}

} // namespace

ReportSummary makeReport(const RunResult& run, const ReportOptions& options, const ReadPlanes& readPlanes,
                         const WriteFile& writeFile)
{
    return Report(run, options, readPlanes, writeFile).make();
}

ReportSummary writeReport(const RunResult& run, const fs::path& runFolder, const fs::path& target,
                          const ReportOptions& given)
{
    ReportOptions options = given;
    addTracesOfRun(run, runFolder, options);
    options.atlas = atlasFiles();
    options.hasFile = [&](const std::string& file) { return fs::exists(runFolder / file); };
    const auto read = [&](const std::string& file) { return readExr(runFolder / file); };
    if (options.isSingle) {
        if (target.has_parent_path()) makeFolder(target.parent_path());
        return makeReport(run, options, read,
                          [&](const std::string&, std::string_view content) { writeFileWhole(target, content); });
    }
    makeFolder(target);
    removeOldData(target);
    makeFolder(target / "data");
    return makeReport(run, options, read, [&](const std::string& file, std::string_view content) {
        writeFileWhole(target / file, content);
    });
}

} // namespace crossray
