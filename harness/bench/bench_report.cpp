#include "harness/bench/bench_report.h"

#include "harness/bench/family.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace crossray {

namespace {

// Errors in the order in which a table shows them.
const std::vector<std::string>& errorNames(const std::string& effect)
{
    static const std::vector<std::string> reflection{"Wrong", "Missed", "False", "HitDepth", "HitPositionSS", "Flips"};
    static const std::vector<std::string> refraction{"RayDirWS", "RayOriginWS", "PathLength"};
    if (const BenchFamily* family = findBenchFamily(effect)) return family->errors;
    return effect == "reflection" ? reflection : refraction;
}

struct CounterColumn {
    const char* name;
    const char* title;
    int width;
};

// Counters in the order in which a table shows them.
std::vector<CounterColumn> counterColumns(const std::string& effect)
{
    if (effect == "reflection")
        return {{"Fetches", "reads", 8},
                {"FetchesOf32", "of 32", 6},
                {"Iterations", "steps", 8},
                {"IterationsOf32", "of 32", 6}};
    const BenchFamily* const family = findBenchFamily(effect);
    if (family == nullptr) return {{"Instructions", "Instructions", 12}};
    std::vector<CounterColumn> columns;
    for (const std::string& name : family->counters)
        columns.push_back({name.c_str(), name.c_str(), std::max(8, static_cast<int>(name.size()))});
    return columns;
}

double counterOr(const BenchPoint& point, const char* name, double missing)
{
    const auto found = point.counters.find(name);
    return found == point.counters.end() ? missing : found->second;
}

bool isCheaper(const BenchPoint& a, const BenchPoint& b, const std::string& effect)
{
    std::vector<std::string> costs{"Fetches", "Iterations"};
    if (const BenchFamily* family = findBenchFamily(effect)) costs = family->costs;
    for (const std::string& cost : costs) {
        const double more = counterOr(a, cost.c_str(), 0) - counterOr(b, cost.c_str(), 0);
        if (more != 0) return more < 0;
    }
    return false;
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

std::string formatError(const BenchPoint& point, const std::string& name)
{
    const auto found = point.errors.find(name);
    return found == point.errors.end() ? fmt::format(" {:>13}", "-") : fmt::format(" {:>13.6g}", found->second);
}

// How steady a method's answers are, against what they cost; nothing where it was not measured.
std::optional<Chart> makeFlipsChart(const BenchScene& scene)
{
    if (!scene.trueFlips) return std::nullopt;
    Chart chart{"projection_flips_" + chartIdOf(scene.name),
                "Stability: " + scene.name,
                "reads of the depth buffer or its pyramid, a pixel",
                "share of the rays whose class flips where the camera moves by a hundredth of a pixel",
                {}};
    for (const BenchPoint& point : scene.points) {
        if (point.counters.contains("Fetches") && point.errors.contains("Flips")) {
            chart.points.push_back(
                {point.method, point.counters.at("Fetches"), point.errors.at("Flips"), false, point.kind == "own"});
        }
    }
    chart.points.push_back({"what really changes", 1, *scene.trueFlips, true});
    return chart;
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

void checkBudget(const std::vector<BudgetTerm>& budget, const Case& testCase)
{
    const std::vector<std::string>& known = errorNames(effectNameOf(testCase));
    for (const BudgetTerm& term : budget) {
        if (std::find(known.begin(), known.end(), term.error) == known.end()) {
            throw InputError(fmt::format("budget: {} has no error \"{}\"; allowed are {}", testCase.name, term.error,
                                         fmt::join(known, ", ")));
        }
    }
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
        if (isKept && (best == nullptr || isCheaper(point, *best, scene.effect))) best = &point;
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
        if (scene.trueFlips)
            text += fmt::format("; a hundredth of a pixel changes {:.3f} % of them", 100 * *scene.trueFlips);
    }
    text += fmt::format("; reading and writing alone takes {:.3f} ms\n\n", scene.baselineMs);
    text += fmt::format("{:<40}", "method");
    for (const std::string& name : errorNames(scene.effect))
        text += fmt::format(" {:>13}", name);
    const std::vector<CounterColumn> columns = counterColumns(scene.effect);
    for (const CounterColumn& column : columns)
        text += fmt::format(" {:>{}}", column.title, column.width);
    text += fmt::format(" {:>9} {:>19} {:>7}\n", "ms", "fastest to slowest", "ratio");
    for (const BenchPoint& point : scene.points) {
        text += fmt::format("{:<40}", point.method);
        for (const std::string& name : errorNames(scene.effect))
            text += formatError(point, name);
        for (const CounterColumn& column : columns) {
            const double value = counterOr(point, column.name, -1);
            const bool isWhole = value >= 0 && value == std::floor(value) && scene.effect != "reflection";
            const std::string shown =
                value < 0 ? "-"
                : isWhole ? fmt::format("{:.0f}", value)
                          : fmt::format("{:.{}f}", value, value < 10 && scene.effect != "reflection" ? 3 : 1);
            text += fmt::format(" {:>{}}", shown, column.width);
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
    std::map<std::string, std::vector<const BenchScene*>> families;
    for (const BenchScene& scene : result.scenes) {
        if (findBenchFamily(scene.effect) != nullptr) {
            families[scene.effect].push_back(&scene);
            continue;
        }
        if (scene.effect == "refraction") {
            const std::vector<Chart> models = makeRefractionModelCharts(scene, device);
            charts.insert(charts.end(), models.begin(), models.end());
            continue;
        }
        const std::string time =
            fmt::format("time over that of reading the G-buffer and writing the outputs ({})", device);
        Chart wrong{"projection_" + chartIdOf(scene.name),
                    "Projection: " + scene.name,
                    time,
                    "share of all rays that are answered wrongly",
                    {}};
        Chart reads{"projection_reads_" + chartIdOf(scene.name),
                    "Projection: " + scene.name,
                    "reads of the depth buffer or its pyramid, a pixel",
                    "share of all rays that are answered wrongly",
                    {}};
        for (const BenchPoint& point : scene.points) {
            const bool isOwn = point.kind == "own";
            wrong.points.push_back({point.method, point.time.ratio, point.errors.at("Wrong"), false, isOwn});
            if (point.counters.contains("Fetches")) {
                reads.points.push_back(
                    {point.method, point.counters.at("Fetches"), point.errors.at("Wrong"), false, isOwn});
            }
        }
        reads.points.push_back({"what the depth buffer shows", 1, scene.oracleWrong, true});
        charts.insert(charts.end(), {wrong, reads});
        if (const auto flips = makeFlipsChart(scene)) charts.push_back(*flips);
    }
    for (const auto& [name, scenes] : families) {
        const std::vector<Chart> made = findBenchFamily(name)->makeCharts(scenes, device);
        charts.insert(charts.end(), made.begin(), made.end());
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
