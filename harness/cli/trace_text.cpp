#include "harness/cli/trace_text.h"

#include "harness/inspect/names.h"
#include "harness/inspect/pixel_conditioning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr int kLabelWidth = 22;
constexpr int kValueWidth = 44;

// One line of the header.
struct Row {
    const char* label;
    std::string (*format)(const PixelRecord& record);
    bool isExact = false;     // differing texts are a difference in kind, and marked
    bool isOfMarch = false;   // only where there are steps to speak of
    bool isOfProxy = false;   // only where there is a proxy
    bool isOfPatches = false; // only where the model says how sure it is of a hit
};

bool isProxy(const PixelRecord& record)
{
    return record.model == ProjectionModel::kProxyInfinite || record.model == ProjectionModel::kProxyBox ||
           record.model == ProjectionModel::kProxySphere || record.model == ProjectionModel::kProxyProbe;
}

bool isMarch(const PixelRecord& record)
{
    return record.model != ProjectionModel::kNone && !isProxy(record);
}

std::string formatPlace(const glm::dvec2& positionSS, double linearDepth)
{
    return fmt::format("({:.3f}, {:.3f}) px, {:.6g} m", positionSS.x, positionSS.y, linearDepth);
}

std::string formatVector(const glm::dvec3& vector)
{
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", vector.x, vector.y, vector.z);
}

std::string formatHit(const PixelRecord& record)
{
    const std::string_view hitClass = nameOf(record.hitClass);
    return record.reason == 0 ? std::string(hitClass) : fmt::format("{}: {}", hitClass, nameOfReason(record.reason));
}

std::string formatDirSS(const PixelRecord& record)
{
    if (record.wayOnScreen <= 0) return "none: it runs along the line of sight";
    return fmt::format("({:.6f}, {:.6f}), at most {:.6g} px", record.dirSS.x, record.dirSS.y, record.wayOnScreen);
}

std::string formatEnd(const PixelRecord& record)
{
    if (record.hitClass == HitClass::kHit) return formatPlace(record.endSS, record.endDepth);
    return fmt::format("({:.3f}, {:.3f}) px, no hit", record.endSS.x, record.endSS.y);
}

const Row kRows[] = {
    {"tracing model", [](const PixelRecord& r) { return nameOfTracingModel(static_cast<int>(r.model)); }, true},
    {"hit success", formatHit, true},
    {"start", [](const PixelRecord& r) { return formatPlace(r.startSS, r.startDepth); }},
    {"start, world", [](const PixelRecord& r) { return formatVector(r.originWS) + " m"; }},
    {"ray direction, screen", formatDirSS},
    {"ray direction, world", [](const PixelRecord& r) { return formatVector(r.dirWS); }},
    {"way in the material", [](const PixelRecord& r) { return fmt::format("{:.6g} m", r.pathLength); }},
    {"projection distance",
     [](const PixelRecord& r) {
         return r.meetsProxy ? fmt::format("{:.6g} m", r.projectionDistance) : std::string("does not meet the proxy");
     },
     false, false, true},
    {"levels", [](const PixelRecord& r) { return fmt::format("{} to {}", r.minLevel, r.maxLevel); }, true, true},
    {"thickness", [](const PixelRecord& r) { return fmt::format("{:.6g} m", r.depthBias); }, false, true},
    {"iterations", [](const PixelRecord& r) { return fmt::format("{} of {}", r.iterations, r.maxIterations); }, true,
     true},
    {"coarsest level used", [](const PixelRecord& r) { return fmt::format("{}", r.maxUsedLevel); }, true, true},
    {"last intersection", [](const PixelRecord& r) { return nameOfIntersection(static_cast<int>(r.lastKind)); }, true,
     true},
    {"end", formatEnd},
    {"hit weight", [](const PixelRecord& r) { return fmt::format("{:.6g}", r.hitWeight); }},
    {"confidence", [](const PixelRecord& r) { return fmt::format("{:.4g}", r.confidence); }, false, false, false, true},
    {"sampled colour",
     [](const PixelRecord& r) {
         return fmt::format("{}, weight {:.6g}", formatVector(r.sampledColor), r.sampledColorWeight);
     }},
};

std::string formatHeader(const PixelTrace& trace, const Style& style)
{
    std::string text = fmt::format("  {:<{}}", "", kLabelWidth);
    for (const RecordOnBackend& record : trace.records)
        text += fmt::format("  {:<{}}", record.backend, kValueWidth);
    text = style.paint(Ink::kBold, text) + "\n";
    for (const Row& row : kRows) {
        const PixelRecord& first = trace.records.front().record;
        const bool hasConfidence = first.model == ProjectionModel::kPatches;
        const bool isMissing = (row.isOfMarch && !isMarch(first)) || (row.isOfProxy && !isProxy(first)) ||
                               (row.isOfPatches && !hasConfidence);
        if (isMissing) continue;
        std::string line;
        bool differs = false;
        for (const RecordOnBackend& record : trace.records) {
            const std::string value = row.format(record.record);
            differs = differs || value != row.format(first);
            line += fmt::format("  {:<{}}", value, kValueWidth);
        }
        const bool isMarked = differs && row.isExact;
        line = fmt::format("{} {:<{}}{}", isMarked ? ">" : " ", row.label, kLabelWidth, line);
        line.erase(line.find_last_not_of(' ') + 1);
        text += (isMarked ? style.paint(Ink::kYellow, line) : line) + "\n";
    }
    return text;
}

std::string formatStep(size_t index, const RecordedStep& step, const std::string& backend)
{
    const std::string position = fmt::format("{:.3f}, {:.3f}", step.positionSS.x, step.positionSS.y);
    std::string line =
        fmt::format("{:>4}  {:>5}  {:<11} {:<9} {:<20} {:>11.6g} {:>11.6g} {:>11.6g} {:>11.6g}  {:<12} {}", index,
                    step.level, fmt::format("{},{}", step.cell.x, step.cell.y),
                    fmt::format("{}x{}", step.cellSize.x, step.cellSize.y), position, step.rayLinearDepth, step.nearest,
                    step.farthest, step.thick, nameOfIntersection(static_cast<int>(step.kind)), backend);
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
}

// Steps on which both agree once; from where they part each backend's own.
std::string formatSteps(const PixelTrace& trace, const Style& style)
{
    size_t most = 0;
    for (const RecordOnBackend& record : trace.records)
        most = std::max(most, record.record.steps.size());
    if (most == 0) return "";
    const size_t parted = trace.parting && trace.parting->step >= 0 ? static_cast<size_t>(trace.parting->step) : most;
    const std::string head =
        fmt::format("  {:>4}  {:>5}  {:<11} {:<9} {:<20} {:>11} {:>11} {:>11} {:>11}  {}", "step", "level", "cell",
                    "size", "position, px", "ray, m", "nearest, m", "farthest, m", "+ thick, m", "intersection");
    std::string text = fmt::format("\n{}\n", style.paint(Ink::kBold, head));
    for (size_t i = 0; i < most; ++i) {
        for (const RecordOnBackend& record : trace.records) {
            if (i >= record.record.steps.size()) continue;
            const bool isApart = i >= parted;
            const std::string line = formatStep(i, record.record.steps[i], isApart ? record.backend : "");
            const bool isFirst = i == parted;
            const std::string marked = fmt::format("{} {}\n", isFirst ? ">" : " ", line);
            text += isFirst ? style.paint(Ink::kYellow, marked) : marked;
            if (!isApart) break;
        }
    }
    for (const RecordOnBackend& record : trace.records) {
        if (record.record.lostSteps > 0) {
            text += fmt::format("  {}: {} later steps are not recorded, only counted\n", record.backend,
                                record.record.lostSteps);
        }
    }
    return text;
}

std::string formatComparison(const PixelTrace& trace)
{
    if (trace.records.size() != 2) return "";
    if (trace.parting) return fmt::format("\n{}\n", trace.parting->sentence);
    const PixelRecord &first = trace.records[0].record, &second = trace.records[1].record;
    const RecordDistance distance = measureDistance(first, second);
    const size_t steps = first.steps.size();
    return fmt::format("\nThey agree{}; at most {:.3g} px and {:.3g} relative depth apart.\n",
                       steps == 0 ? "" : fmt::format(" in {} step{}", steps, steps == 1 ? "" : "s"), distance.pixels,
                       distance.depth);
}

std::string formatConditioning(const PixelTrace& trace, const Style& style)
{
    if (!trace.conditioningNote.empty())
        return fmt::format("\nConditioning: not measured: {}\n", trace.conditioningNote);
    if (trace.conditioning.empty()) return {};
    std::string text = fmt::format(
        "\n  {}\n",
        style.paint(Ink::kBold, fmt::format("{:<16} {:>8} {:>8} {:>8}", "ulp for an ulp", "cpu64", "cpu32", "apart")));
    const std::vector<std::string> lines = describePixelConditioning(trace.conditioning);
    for (size_t i = 0; i < lines.size(); ++i) {
        const bool isUndecidable = trace.conditioning[i].condition > kUndecidableAbove;
        text += fmt::format("{} {}\n", isUndecidable ? ">" : " ",
                            isUndecidable ? style.paint(Ink::kYellow, lines[i]) : lines[i]);
    }
    return text;
}

} // namespace

std::string formatTrace(const PixelTrace& trace, const Style& style)
{
    const std::string head = fmt::format("{}  pixel {},{}\n{}\n\n", style.paint(Ink::kBold, trace.caseName),
                                         trace.pixel.x, trace.pixel.y, trace.summary);
    const bool isTraced = std::any_of(trace.records.begin(), trace.records.end(),
                                      [](const RecordOnBackend& record) { return record.record.isTraced; });
    if (!isTraced)
        return head + "This pixel traces no ray: what it shows is no mirror (reflection) and no glass (refraction).\n";
    return head + formatHeader(trace, style) + formatSteps(trace, style) + formatComparison(trace) +
           formatConditioning(trace, style);
}

} // namespace crossray
