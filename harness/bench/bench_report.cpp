#include "harness/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace crossray {

namespace {

// Errors in the order in which a table shows them.
const std::vector<std::string>& errorNames(const std::string& effect)
{
    static const std::vector<std::string> reflection{"Wrong", "Missed", "False", "HitDepth", "HitPositionSS"};
    static const std::vector<std::string> refraction{"RayDirWS", "RayOriginWS", "PathLength"};
    return effect == "reflection" ? reflection : refraction;
}

double counterOr(const BenchPoint& point, const char* name, double missing)
{
    const auto found = point.counters.find(name);
    return found == point.counters.end() ? missing : found->second;
}

bool isCheaper(const BenchPoint& a, const BenchPoint& b)
{
    const double reads = counterOr(a, "Fetches", 0) - counterOr(b, "Fetches", 0);
    if (reads != 0) return reads < 0;
    return counterOr(a, "Iterations", 0) < counterOr(b, "Iterations", 0);
}

std::string idOf(const std::string& name)
{
    std::string id = name;
    for (char& c : id) {
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        if (!isPlain) c = '_';
    }
    return id;
}

const BenchPoint* findPoint(const BenchScene& scene, const std::string& method)
{
    for (const BenchPoint& point : scene.points) {
        if (point.method == method) return &point;
    }
    return nullptr;
}

void compareValues(const std::string& place, const std::map<std::string, double>& before,
                   const std::map<std::string, double>& after, double share, std::vector<BenchChange>& changes)
{
    for (const auto& [name, was] : before) {
        const auto found = after.find(name);
        if (found == after.end()) {
            changes.push_back({fmt::format("{} {}: {:.6g}, and now not measured", place, name, was), true});
            continue;
        }
        const double is = found->second;
        if (is == was) continue;
        const bool isLoss = is > was + share * std::abs(was);
        changes.push_back({fmt::format("{} {}: {:.6g} -> {:.6g}", place, name, was, is), isLoss});
    }
}

} // namespace

std::vector<BudgetTerm> parseBudget(const std::string& text)
{
    std::vector<BudgetTerm> terms;
    size_t begin = 0;
    while (begin <= text.size()) {
        const size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const size_t sign = part.find("<=");
        double bound = -1;
        const char* const last = part.data() + part.size();
        const bool hasNumber =
            sign != std::string::npos && sign > 0 && std::from_chars(part.data() + sign + 2, last, bound).ptr == last;
        if (!hasNumber || !(bound >= 0) || !std::isfinite(bound)) {
            throw InputError(
                fmt::format("budget \"{}\": allowed is ERROR<=NUMBER, several by commas, as \"HitDepth<=0.01\"", text));
        }
        terms.push_back({part.substr(0, sign), bound});
        begin = end + 1;
    }
    return terms;
}

const BenchPoint* chooseMethod(const BenchScene& scene, const std::vector<BudgetTerm>& budget)
{
    const BenchPoint* best = nullptr;
    for (const BenchPoint& point : scene.points) {
        const bool isKept = std::all_of(budget.begin(), budget.end(), [&](const BudgetTerm& term) {
            const auto found = point.errors.find(term.error);
            if (found == point.errors.end()) {
                std::string known;
                for (const auto& [name, unused] : point.errors)
                    known += known.empty() ? name : ", " + name;
                throw InputError(
                    fmt::format("budget: {} has no error \"{}\"; allowed are {}", scene.name, term.error, known));
            }
            return found->second <= term.bound;
        });
        if (isKept && (best == nullptr || isCheaper(point, *best))) best = &point;
    }
    return best;
}

std::string formatBenchTable(const BenchScene& scene)
{
    std::string text = fmt::format("{}: {:.0f} rays at {}x{}", scene.name, scene.rays, scene.width, scene.height);
    if (scene.effect == "reflection") {
        text += fmt::format("; no screen shows where {:.1f} % of them end; the best reader of the depth buffer answers "
                            "{:.2f} % wrongly",
                            100 * scene.unknowable, 100 * scene.oracleWrong);
    }
    text += fmt::format("; reading and writing alone takes {:.3f} ms\n\n", scene.baselineMs);
    text += fmt::format("{:<40}", "method");
    for (const std::string& name : errorNames(scene.effect))
        text += fmt::format(" {:>13}", name);
    const bool counts = scene.effect == "reflection";
    if (counts) text += fmt::format(" {:>8} {:>6} {:>8} {:>6}", "reads", "of 32", "steps", "of 32");
    text += fmt::format(" {:>9} {:>19} {:>7}\n", "ms", "fastest to slowest", "ratio");
    for (const BenchPoint& point : scene.points) {
        text += fmt::format("{:<40}", point.method);
        for (const std::string& name : errorNames(scene.effect))
            text += fmt::format(" {:>13.6g}", point.errors.at(name));
        for (const char* name : {"Fetches", "FetchesOf32", "Iterations", "IterationsOf32"}) {
            if (!counts) continue;
            const bool isWide = std::string_view(name).size() < 11;
            const double value = counterOr(point, name, -1);
            const std::string shown = value < 0 ? "-" : fmt::format("{:.1f}", value);
            text += isWide ? fmt::format(" {:>8}", shown) : fmt::format(" {:>6}", shown);
        }
        text += fmt::format(" {:>9.3f} {:>8.3f} to {:>7.3f} {:>7.2f}\n", point.time.median, point.time.fastest,
                            point.time.slowest, point.time.ratio);
    }
    return text;
}

std::vector<Chart> makeBenchCharts(const BenchResult& result)
{
    std::vector<Chart> charts;
    const std::string device = result.fingerprint.device;
    for (const BenchScene& scene : result.scenes) {
        const std::string time =
            fmt::format("time over that of reading the G-buffer and writing the outputs ({})", device);
        if (scene.effect == "reflection") {
            Chart wrong{"projection_" + idOf(scene.name),
                        "Projection: " + scene.name,
                        time,
                        "share of all rays that are answered wrongly",
                        {}};
            Chart reads{"projection_reads_" + idOf(scene.name),
                        "Projection: " + scene.name,
                        "reads of the depth buffer or its pyramid, a ray",
                        "share of all rays that are answered wrongly",
                        {}};
            for (const BenchPoint& point : scene.points) {
                wrong.points.push_back({point.method, point.time.ratio, point.errors.at("Wrong")});
                if (point.counters.contains("Fetches"))
                    reads.points.push_back({point.method, point.counters.at("Fetches"), point.errors.at("Wrong")});
            }
            reads.points.push_back({"what the depth buffer shows", 1, scene.oracleWrong, true});
            charts.insert(charts.end(), {wrong, reads});
            continue;
        }
        const std::pair<const char*, const char*> axes[] = {{"RayDirWS", "exit direction, mean error in degrees"},
                                                            {"RayOriginWS", "exit position, mean error in metres"}};
        for (const auto& [name, label] : axes) {
            Chart chart{fmt::format("refraction_{}_{}", idOf(scene.name), name),
                        "Refraction model: " + scene.name,
                        time,
                        label,
                        {}};
            for (const BenchPoint& point : scene.points)
                chart.points.push_back({point.method, point.time.ratio, point.errors.at(name)});
            charts.push_back(std::move(chart));
        }
    }
    return charts;
}

std::vector<BenchChange> compareBenches(const BenchResult& before, const BenchResult& after, double share)
{
    std::vector<BenchChange> changes;
    const Fingerprint& a = before.fingerprint;
    const Fingerprint& b = after.fingerprint;
    const bool isSameDevice = a.backend == b.backend && a.device == b.device && a.driver == b.driver && a.cpu == b.cpu;
    if (!isSameDevice) changes.push_back({"other device, driver or processor: times are not compared", false});
    for (const BenchScene& old : before.scenes) {
        const auto scene = std::find_if(after.scenes.begin(), after.scenes.end(),
                                        [&](const BenchScene& other) { return other.name == old.name; });
        if (scene == after.scenes.end()) {
            changes.push_back({fmt::format("{}: not measured any more", old.name), true});
            continue;
        }
        for (const BenchPoint& was : old.points) {
            const std::string place = old.name + ", " + was.method + ":";
            const BenchPoint* const is = findPoint(*scene, was.method);
            if (is == nullptr) {
                changes.push_back({place + " not measured any more", true});
                continue;
            }
            compareValues(place, was.errors, is->errors, share, changes);
            compareValues(place, was.counters, is->counters, share, changes);
            const bool isSlower = is->time.ratio > was.time.ratio * (1 + share);
            const bool isApart = is->time.fastest > was.time.slowest;
            if (isSameDevice && isSlower && isApart) {
                changes.push_back({fmt::format("{} {:.3f} ms ({:.2f} of the baseline) -> {:.3f} ms ({:.2f})", place,
                                               was.time.median, was.time.ratio, is->time.median, is->time.ratio),
                                   true});
            }
        }
    }
    return changes;
}

} // namespace crossray
