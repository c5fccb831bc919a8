// Where something jumps along a sweep, how near that can be told, and what happens there in one sentence.
#include "harness/base/error.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace crossray {

namespace {

constexpr double kChangedShare = 0.005; // of the rays: less is the drift of a smooth parameter
constexpr double kErrorFactor = 30;     // by which an error jumps
constexpr double kErrorFloor = 1e-6;    // errors below are rounding
constexpr size_t kMostEdges = 8;

double greatestChange(const ClassShares& a, const ClassShares& b)
{
    double greatest = 0;
    for (const auto& [name, share] : a)
        greatest = std::max(greatest, std::abs(share - (b.contains(name) ? b.at(name) : 0)));
    for (const auto& [name, share] : b) {
        if (!a.contains(name)) greatest = std::max(greatest, share);
    }
    return greatest;
}

bool keepsTolerances(const SweepCell& cell)
{
    return std::all_of(cell.errors.begin(), cell.errors.end(), [](const SweepError& error) { return error.passed; });
}

double greatestError(const SweepCell& cell)
{
    double greatest = 0;
    for (const SweepError& error : cell.errors)
        greatest = std::max(greatest, error.max);
    return greatest;
}

// How far a cell is from its neighbour in what the kind of edge looks at; 0 where nothing changes.
double changeBetween(EdgeKind kind, const SweepRow& before, const SweepRow& after, size_t cell)
{
    if (kind == EdgeKind::kRefused) return before.refused.empty() != after.refused.empty() ? 1 : 0;
    if (!before.refused.empty() || !after.refused.empty()) return 0;
    const SweepCell& a = before.cells[cell];
    const SweepCell& b = after.cells[cell];
    if (kind == EdgeKind::kFailure) return a.failure.empty() != b.failure.empty() ? 1 : 0;
    if (!a.failure.empty() || !b.failure.empty()) return 0;
    switch (kind) {
    case EdgeKind::kFiniteness:
        return (a.notFinite > 0) != (b.notFinite > 0) ? 1 : 0;
    case EdgeKind::kTolerance:
        return keepsTolerances(a) != keepsTolerances(b) ? 1 : 0;
    case EdgeKind::kDisagreement:
        return (a.differs > kChangedShare) != (b.differs > kChangedShare) ? 1 : 0;
    case EdgeKind::kClasses: {
        const double change = greatestChange(a.classes, b.classes);
        return change > kChangedShare ? change : 0;
    }
    case EdgeKind::kError: {
        const double low = std::max(kErrorFloor, std::min(greatestError(a), greatestError(b)));
        const double factor = std::max(greatestError(a), greatestError(b)) / low;
        return factor > kErrorFactor ? factor : 0;
    }
    default:
        return 0;
    }
}

// Runs of neighbouring pairs between which the classes change: where each begins and where it ends. A run over most of
// the sweep is a drift, of which the steepest pair alone is told.
void addClassJumps(const SweepResult& result, size_t cell, std::vector<SweepJump>& jumps)
{
    const size_t pairs = result.rows.size() - 1;
    for (size_t first = 0; first < pairs; ++first) {
        if (changeBetween(EdgeKind::kClasses, result.rows[first], result.rows[first + 1], cell) == 0) continue;
        size_t end = first, steepest = first;
        double greatest = 0;
        for (; end < pairs; ++end) {
            const double change = changeBetween(EdgeKind::kClasses, result.rows[end], result.rows[end + 1], cell);
            if (change == 0) break;
            if (change > greatest) steepest = end;
            greatest = std::max(greatest, change);
        }
        if (2 * (end - first) > pairs) {
            jumps.push_back({EdgeKind::kClasses, cell, steepest, true, steepest, steepest + 1});
        } else {
            // What changes up to an end of the sweep begins or ends beyond it.
            const bool isOne = end - first == 1;
            if (isOne || first > 0) jumps.push_back({EdgeKind::kClasses, cell, first, true, first, end});
            if (!isOne && end < pairs) jumps.push_back({EdgeKind::kClasses, cell, end - 1, false, first, end});
        }
        first = end;
    }
}

size_t placeOf(const SweepResult& result, std::string_view backend)
{
    return static_cast<size_t>(std::find(result.backends.begin(), result.backends.end(), backend) -
                               result.backends.begin());
}

std::string formatValue(double value)
{
    return fmt::format("{:.6g}", value);
}

std::string percent(double share)
{
    return share > 0 && share < 0.0095 ? fmt::format("{:.2g} %", share * 100) : fmt::format("{:.0f} %", share * 100);
}

// " that meet the surface at 60 to 90 degrees", of the rays whose class is another one.
std::string describeAngles(const SweepPixels& before, const SweepPixels& after)
{
    if (before.width != after.width || before.height != after.height) return "";
    float low = 180, high = 0;
    for (size_t pixel = 0; pixel < before.kinds.size(); ++pixel) {
        if (before.kinds[pixel] == after.kinds[pixel] || before.kinds[pixel] < 0 || after.kinds[pixel] < 0) continue;
        low = std::min(low, after.incidence[pixel]);
        high = std::max(high, after.incidence[pixel]);
    }
    if (low > high) return "";
    return high - low < 0.1F
               ? fmt::format(", seen at {:.4g} degrees", static_cast<double>(low))
               : fmt::format(", seen at {:.3g} to {:.3g} degrees", static_cast<double>(low), static_cast<double>(high));
}

std::string describeClasses(const SweepRow& before, const SweepRow& after, size_t cell)
{
    const ClassShares& a = before.cells[cell].classes;
    const ClassShares& b = after.cells[cell].classes;
    std::string from, to;
    double lost = 0, won = 0;
    const auto look = [&](const std::string& name) {
        const double change = (b.contains(name) ? b.at(name) : 0) - (a.contains(name) ? a.at(name) : 0);
        if (change > won) won = change, to = name;
        if (change < lost) lost = change, from = name;
    };
    for (const auto& [name, share] : a)
        look(name);
    for (const auto& [name, share] : b)
        look(name);
    return fmt::format("{} of the rays turn from \"{}\" into \"{}\"{}", percent(won), from, to,
                       describeAngles(before.pixels, after.pixels));
}

std::string describeTolerance(const SweepRow& before, const SweepRow& after, size_t cell)
{
    const bool leaves = keepsTolerances(before.cells[cell]);
    const SweepCell& bad = leaves ? after.cells[cell] : before.cells[cell];
    for (const SweepError& error : bad.errors) {
        if (error.passed) continue;
        std::string text = fmt::format("{} {} the case's tolerance against \"{}\", ", error.output,
                                       leaves ? "leaves" : "comes within", error.source);
        text += leaves ? "with " : "from ";
        if (error.metrics.empty()) {
            return text + fmt::format("{} of the pixels beyond it, by up to {:.3g} {}", percent(error.failed),
                                      error.max, error.unit);
        }
        std::vector<std::string> metrics;
        for (const auto& [name, value] : error.metrics)
            metrics.push_back(fmt::format("{} {:.3g}", name, value));
        return text + fmt::format("{}", fmt::join(metrics, ", "));
    }
    return "";
}

std::string describeChange(EdgeKind kind, const SweepRow& before, const SweepRow& after, size_t cell)
{
    const SweepRow& bad = before.refused.empty() ? after : before;
    switch (kind) {
    case EdgeKind::kRefused:
        return "the case is refused: " + bad.refused;
    case EdgeKind::kFailure:
        return "the backend gives no answer: " +
               (before.cells[cell].failure.empty() ? after : before).cells[cell].failure;
    case EdgeKind::kFiniteness: {
        const SweepCell& worse = (before.cells[cell].notFinite > 0 ? before : after).cells[cell];
        return fmt::format("{} values of {} are NaN or infinite", worse.notFinite, worse.notFiniteOutputs);
    }
    case EdgeKind::kClasses:
        return describeClasses(before, after, cell);
    case EdgeKind::kTolerance:
        return describeTolerance(before, after, cell);
    case EdgeKind::kError:
        return fmt::format("the greatest error goes from {:.3g} to {:.3g}", greatestError(before.cells[cell]),
                           greatestError(after.cells[cell]));
    case EdgeKind::kDisagreement:
        return fmt::format("the class is not cpu64's on {} of the rays (before: {})",
                           percent(after.cells[cell].differs), percent(before.cells[cell].differs));
    }
    return "";
}

class EdgeSearch {
  public:
    EdgeSearch(SweepResult& result, const MeasureValue& measure) : result_(result), measure_(measure) {}

    // Bisects the jump and tells what it is.
    SweepEdge locate(const SweepJump& jump)
    {
        const std::string& backend = result_.backends[jump.cell];
        const std::vector<std::string> asked =
            backend == "cpu64" ? std::vector<std::string>{backend} : std::vector<std::string>{backend, "cpu64"};
        SweepRow low = pick(result_.rows[jump.row], asked), high = pick(result_.rows[jump.row + 1], asked);
        const double whole = changeBetween(jump.kind, low, high, 0);
        const SweepRow first = low, last = high; // the sides that are known to differ
        while (!isNarrow(low.value, high.value)) {
            SweepRow middle = pick(measure_(middleOf(low.value, high.value), asked), asked);
            const bool isBeyond = jump.isStart ? changeBetween(jump.kind, first, middle, 0) > 0
                                               : changeBetween(jump.kind, middle, last, 0) == 0;
            const bool isOdd = middle.refused.empty() != low.refused.empty() && jump.kind != EdgeKind::kRefused;
            if (isOdd) break;
            (isBeyond ? high : low) = std::move(middle);
        }
        low = measureWhole(low.value);
        high = measureWhole(high.value);
        SweepEdge edge{jump.kind, result_.backends[jump.cell], low.value, high.value, false, ""};
        const bool isClasses = jump.kind == EdgeKind::kClasses;
        edge.isGradual = isClasses && changeBetween(jump.kind, low, high, jump.cell) < 0.5 * whole;
        if (!edge.isGradual)
            edge.sentence = tell(jump, edge, low, high);
        else
            edge.sentence = jump.isStart ? tell(jump, edge, low, result_.rows[jump.runEnd])
                                         : tell(jump, edge, result_.rows[jump.runBegin], high);
        low.isAtEdge = high.isAtEdge = true;
        found_.push_back(std::move(low));
        found_.push_back(std::move(high));
        return edge;
    }

    // Puts the rows at the edges among the others.
    void addRows()
    {
        for (SweepRow& row : found_) {
            const auto same = std::find_if(result_.rows.begin(), result_.rows.end(),
                                           [&](const SweepRow& other) { return other.value == row.value; });
            if (same == result_.rows.end()) result_.rows.push_back(std::move(row));
        }
        const bool isRising = result_.range.from < result_.range.to;
        std::sort(result_.rows.begin(), result_.rows.end(), [&](const SweepRow& a, const SweepRow& b) {
            return isRising ? a.value < b.value : a.value > b.value;
        });
    }

  private:
    // The row with these backends' cells alone.
    static SweepRow pick(SweepRow row, const std::vector<std::string>& backends)
    {
        std::vector<SweepCell> cells;
        for (const std::string& backend : backends) {
            for (SweepCell& cell : row.cells) {
                if (cell.backend == backend) cells.push_back(std::move(cell));
            }
        }
        row.cells = std::move(cells);
        return row;
    }
    SweepRow measureWhole(double value) const
    {
        for (const SweepRow& row : result_.rows) {
            if (row.value == value) return row;
        }
        return measure_(value, result_.backends);
    }
    double middleOf(double a, double b) const
    {
        const double middle = result_.range.middle(a, b);
        return result_.isInteger ? std::floor(middle) == std::min(a, b) ? std::min(a, b) + 1 : std::floor(middle)
                                 : middle;
    }
    bool isNarrow(double a, double b) const
    {
        return result_.isInteger ? std::abs(a - b) <= 1 : result_.range.distance(a, b) <= result_.width;
    }

    std::string tell(const SweepJump& jump, const SweepEdge& edge, const SweepRow& before, const SweepRow& after) const
    {
        const std::string& name = result_.parameter;
        const std::string between =
            result_.isInteger ? fmt::format("from {} {} to {}", name, formatValue(edge.low), formatValue(edge.high))
                              : fmt::format("at {} {} (between {} and {})", name,
                                            formatValue(result_.range.middle(edge.low, edge.high)),
                                            fmt::format("{:.8g}", edge.low), fmt::format("{:.8g}", edge.high));
        const std::string change = describeChange(jump.kind, before, after, jump.cell);
        const std::string where = namesAt(jump.kind, before, after);
        if (!edge.isGradual) return fmt::format("{}{}: {}", between, where, change);
        return jump.isStart ? fmt::format("{} a change begins: by {}, {}", between, formatValue(after.value), change)
                            : fmt::format("{} a change ends: since {}, {}", between, formatValue(before.value), change);
    }

    // " on lavapipe, osmesa": all that jump there.
    std::string namesAt(EdgeKind kind, const SweepRow& before, const SweepRow& after) const
    {
        if (kind == EdgeKind::kRefused || kind == EdgeKind::kClasses) return "";
        std::vector<std::string> names;
        for (size_t cell = 0; cell < result_.backends.size(); ++cell) {
            if (changeBetween(kind, before, after, cell) > 0) names.push_back(result_.backends[cell]);
        }
        return fmt::format(" on {}", fmt::join(names, ", "));
    }

    SweepResult& result_;
    const MeasureValue& measure_;
    std::vector<SweepRow> found_;
};

} // namespace

std::string_view nameOf(EdgeKind kind)
{
    static constexpr std::string_view kNames[] = {"refused",   "finiteness", "failure",     "classes",
                                                  "tolerance", "error",      "disagreement"};
    return kNames[static_cast<size_t>(kind)];
}

std::vector<SweepJump> findJumps(const SweepResult& result)
{
    std::vector<SweepJump> jumps;
    if (result.rows.size() < 2) return jumps;
    // The same jump on the next backend says nothing more, and of those to and fro the first and the last are enough.
    const auto addAll = [&](EdgeKind kind, size_t firstCell, size_t endCell) {
        std::vector<SweepJump> found;
        for (size_t row = 0; row + 1 < result.rows.size(); ++row) {
            for (size_t cell = firstCell; cell < endCell; ++cell) {
                if (changeBetween(kind, result.rows[row], result.rows[row + 1], cell) == 0) continue;
                found.push_back({kind, cell, row, true, row, row + 1});
                break;
            }
        }
        if (found.size() > 2) found.erase(found.begin() + 1, found.end() - 1);
        jumps.insert(jumps.end(), found.begin(), found.end());
    };
    const size_t backends = result.backends.size();
    addAll(EdgeKind::kRefused, 0, 1);
    addAll(EdgeKind::kFiniteness, 0, backends);
    addAll(EdgeKind::kFailure, 0, backends);
    addClassJumps(result, placeOf(result, "cpu64"), jumps);
    addAll(EdgeKind::kTolerance, 0, backends);
    addAll(EdgeKind::kDisagreement, 0, backends);
    if (jumps.empty()) addAll(EdgeKind::kError, 0, backends);
    if (jumps.size() > kMostEdges) jumps.resize(kMostEdges);
    return jumps;
}

SweepResult runSweep(const SweepPlan& plan, const std::vector<std::string>& backends, const MeasureValue& measure)
{
    SweepResult result;
    result.caseName = plan.caseName;
    result.parameter = plan.parameter;
    result.range = plan.range;
    result.isInteger = plan.keys.isInteger;
    result.width = plan.width;
    result.backends = backends;
    for (const double value : plan.range.values(plan.keys.isInteger))
        result.rows.push_back(measure(value, backends));
    const bool isAllRefused =
        std::all_of(result.rows.begin(), result.rows.end(), [](const SweepRow& row) { return !row.refused.empty(); });
    if (isAllRefused) throw InputError("every value is refused: " + result.rows.front().refused);
    EdgeSearch search(result, measure);
    for (const SweepJump& jump : findJumps(result))
        result.edges.push_back(search.locate(jump));
    search.addRows();
    const bool isRising = result.range.from < result.range.to;
    std::stable_sort(result.edges.begin(), result.edges.end(),
                     [&](const SweepEdge& a, const SweepEdge& b) { return isRising ? a.low < b.low : a.low > b.low; });
    return result;
}

} // namespace crossray
