// A sweep as curves: a panel for each error that says something, one for the shares of the classes, one for the
// iterations, over one axis; the edges as numbered lines, told in words below. SVG that needs nothing else.
#include "harness/sweep/sweep.h"

#include "harness/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace crossray {

namespace {

constexpr double kWidth = 1000, kLeft = 84, kRight = 250, kTop = 62;
constexpr double kPanel = 150, kGap = 40, kZeroBand = 18;
constexpr size_t kMostErrorPanels = 3;
constexpr size_t kLineLength = 150; // letters of the text below
constexpr std::array<const char*, 8> kColors{"#1f5fa8", "#c2571a", "#2f8f4e", "#7a4fa3",
                                             "#b0224a", "#0e8c92", "#8a6d1a", "#50565f"};

std::string drawText(double x, double y, std::string_view text, std::string_view look)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, look, escapeMarkup(text));
}
constexpr std::string_view kSmall = "font-size=\"11\" fill=\"#50565f\"";
constexpr std::string_view kSmallEnd = "font-size=\"11\" fill=\"#50565f\" text-anchor=\"end\"";
constexpr std::string_view kSmallMiddle = "font-size=\"11\" fill=\"#50565f\" text-anchor=\"middle\"";

std::string formatTick(double value)
{
    const double size = std::abs(value);
    return size == 0 || (size >= 1e-3 && size < 1e5) ? fmt::format("{:.6g}", value) : fmt::format("{:.0e}", value);
}

// Values to pixels, either way round.
struct Axis {
    double from = 0, to = 1; // at begin and end
    double begin = 0, end = 1;
    bool isLog = false;

    double place(double value) const
    {
        const double t = isLog ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
        return begin + (end - begin) * t;
    }
    std::vector<double> ticks() const
    {
        const double low = std::min(from, to), high = std::max(from, to);
        std::vector<double> found;
        if (isLog) {
            const double decades = std::log10(high / low);
            const int stride = std::max(1, static_cast<int>(std::ceil(decades / 8)));
            const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
            for (int decade = first; std::pow(10, decade) <= high * 1.0001; decade += stride)
                found.push_back(std::pow(10, decade));
            if (found.size() < 2) found = {low, high};
            return found;
        }
        const double rough = (high - low) / 6, decade = std::pow(10, std::floor(std::log10(rough)));
        double step = decade;
        for (const double factor : {2.0, 5.0, 10.0}) {
            if (step < rough) step = factor * decade;
        }
        for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1)
            found.push_back(i == 0 ? 0 : i * step);
        return found;
    }
};

struct Curve {
    std::string color, dash; // dash: "" for solid
    double stroke = 1.4;
    std::vector<std::optional<double>> values; // by row; none: a gap
};

struct LegendEntry {
    std::string color, dash, name;
};

struct Panel {
    std::string title;
    bool isLog = false;
    double top = 0; // of the values where it is fixed, else found
    std::vector<Curve> curves;
    std::vector<LegendEntry> legend;
};

// One value of each row of a backend.
template <typename Read>
std::vector<std::optional<double>> readRows(const SweepResult& result, size_t cell, const Read& read)
{
    std::vector<std::optional<double>> values;
    for (const SweepRow& row : result.rows) {
        const bool hasAnswer = row.refused.empty() && cell < row.cells.size() && row.cells[cell].failure.empty();
        values.push_back(hasAnswer ? read(row.cells[cell]) : std::nullopt);
    }
    return values;
}

const std::vector<SweepError>* errorsOf(const SweepResult& result)
{
    for (const SweepRow& row : result.rows) {
        for (const SweepCell& cell : row.cells) {
            if (!cell.errors.empty()) return &cell.errors;
        }
    }
    return nullptr;
}

const char* colorOf(size_t index)
{
    return kColors[index % kColors.size()];
}

double shareWrong(const SweepError& error, const std::string& metric)
{
    const auto found = error.metrics.find(metric);
    return found == error.metrics.end() ? 0 : 1 - found->second;
}

// Which two numbers of an error are drawn, solid and dotted.
struct ErrorCurves {
    std::string unit, dotted;
    double (*solid)(const SweepError&);
    double (*second)(const SweepError&);
};

ErrorCurves chooseCurves(const SweepError& error)
{
    if (!error.metrics.empty()) {
        return {"answerable rays that are missed", "claims that are wrong",
                [](const SweepError& e) { return shareWrong(e, "recall"); },
                [](const SweepError& e) { return shareWrong(e, "precision"); }};
    }
    if (error.unit == "class")
        return {"share of wrong classes", "", [](const SweepError& e) { return e.failed; }, nullptr};
    return {error.unit, "99 % are below", [](const SweepError& e) { return e.max; },
            [](const SweepError& e) { return e.p99; }};
}

Panel makeErrorPanel(const SweepResult& result, size_t expectation, const SweepError& error)
{
    const ErrorCurves curves = chooseCurves(error);
    Panel panel;
    panel.title = fmt::format("{} against {}: {}", error.output, error.source, curves.unit);
    panel.isLog = true;
    for (size_t cell = 0; cell < result.backends.size(); ++cell) {
        const auto read = [&](double (*number)(const SweepError&)) {
            return readRows(result, cell, [&](const SweepCell& answer) -> std::optional<double> {
                const bool hasError = expectation < answer.errors.size() && answer.errors[expectation].compared > 0;
                if (!hasError) return std::nullopt;
                return number(answer.errors[expectation]);
            });
        };
        panel.curves.push_back({colorOf(cell), "", 1.4, read(curves.solid)});
        if (curves.second != nullptr) panel.curves.push_back({colorOf(cell), "2 3", 1.0, read(curves.second)});
        panel.legend.push_back({colorOf(cell), "", result.backends[cell]});
    }
    if (curves.second != nullptr) panel.legend.push_back({"#50565f", "2 3", curves.dotted});
    return panel;
}

// The panels of the errors that move most.
void addErrorPanels(const SweepResult& result, std::vector<Panel>& panels)
{
    const std::vector<SweepError>* const errors = errorsOf(result);
    if (errors == nullptr) return;
    std::vector<std::pair<double, size_t>> bySize;
    for (size_t i = 0; i < errors->size(); ++i) {
        double most = 0;
        for (const SweepRow& row : result.rows) {
            for (const SweepCell& cell : row.cells) {
                if (i >= cell.errors.size()) continue;
                most = std::max({most, cell.errors[i].passed ? 0.0 : 1e9, cell.errors[i].max});
            }
        }
        bySize.emplace_back(-most, i);
    }
    std::stable_sort(bySize.begin(), bySize.end());
    if (bySize.size() > kMostErrorPanels) bySize.resize(kMostErrorPanels);
    for (const auto& [unused, i] : bySize)
        panels.push_back(makeErrorPanel(result, i, (*errors)[i]));
}

Panel makeClassPanel(const SweepResult& result)
{
    Panel panel;
    panel.title = "classes, share of the rays (thin: each backend)";
    panel.top = 1;
    std::set<std::string> names;
    for (const SweepRow& row : result.rows) {
        for (const SweepCell& cell : row.cells) {
            for (const auto& [name, share] : cell.classes)
                names.insert(name);
        }
    }
    size_t color = 0;
    for (const std::string& name : names) {
        for (size_t cell = 0; cell < result.backends.size(); ++cell) {
            const bool isReference = result.backends[cell] == "cpu64";
            panel.curves.push_back({colorOf(color), isReference ? "" : "5 2", isReference ? 1.8 : 0.9,
                                    readRows(result, cell, [&](const SweepCell& answer) -> std::optional<double> {
                                        const auto found = answer.classes.find(name);
                                        return found == answer.classes.end() ? 0 : found->second;
                                    })});
        }
        panel.legend.push_back({colorOf(color), "", name});
        ++color;
    }
    return panel;
}

Panel makeIterationPanel(const SweepResult& result)
{
    Panel panel;
    panel.title = "iterations a ray";
    for (size_t cell = 0; cell < result.backends.size(); ++cell) {
        panel.curves.push_back({colorOf(cell), "", 1.4, readRows(result, cell, [](const SweepCell& answer) {
                                    return std::optional<double>(answer.meanIterations);
                                })});
        panel.curves.push_back({colorOf(cell), "2 3", 1.0, readRows(result, cell, [](const SweepCell& answer) {
                                    return std::optional<double>(answer.maxIterations);
                                })});
        panel.legend.push_back({colorOf(cell), "", result.backends[cell]});
    }
    panel.legend.push_back({"#50565f", "2 3", "most"});
    return panel;
}

bool isEmpty(const Panel& panel)
{
    return std::none_of(panel.curves.begin(), panel.curves.end(), [](const Curve& curve) {
        return std::any_of(curve.values.begin(), curve.values.end(),
                           [](const auto& value) { return value && *value > 0; });
    });
}

Axis makeValueAxis(const Panel& panel, double top)
{
    Axis axis{0, 1, top + kPanel, top, panel.isLog};
    double low = 1e300, high = 0;
    for (const Curve& curve : panel.curves) {
        for (const auto& value : curve.values) {
            if (!value || !std::isfinite(*value) || *value <= 0) continue;
            low = std::min(low, *value);
            high = std::max(high, *value);
        }
    }
    if (panel.isLog) {
        axis.begin -= kZeroBand;
        axis.from = high > 0 ? std::pow(10, std::floor(std::log10(low))) : 1e-6;
        axis.to = high > 0 ? std::pow(10, std::ceil(std::log10(high) + 1e-9)) : 1;
        if (axis.to <= axis.from) axis.to = 10 * axis.from;
        return axis;
    }
    axis.to = panel.top > 0 ? panel.top : high > 0 ? 1.05 * high : 1;
    return axis;
}

std::string drawCurve(const Curve& curve, const std::vector<double>& xs, const Axis& y, double bottom)
{
    std::string path, dots;
    bool isOpen = false;
    for (size_t i = 0; i < xs.size(); ++i) {
        const auto& value = curve.values[i];
        if (!value || !std::isfinite(*value)) {
            isOpen = false;
            continue;
        }
        const double at = y.isLog && *value <= 0 ? bottom - 0.5 * kZeroBand : y.place(*value);
        path += fmt::format("{}{:.1f} {:.1f}", isOpen ? "L" : "M", xs[i], at);
        if (curve.dash.empty() && curve.stroke < 1.7) {
            dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.7\" fill=\"{}\"/>", xs[i], at, curve.color);
        }
        isOpen = true;
    }
    return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}/>{}\n", path, curve.color, curve.stroke,
                       curve.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", curve.dash), dots);
}

std::string drawPanel(const Panel& panel, const Axis& x, const std::vector<double>& xs, double top)
{
    const double bottom = top + kPanel, right = kWidth - kRight;
    const Axis y = makeValueAxis(panel, top);
    std::string svg = drawText(kLeft, top - 6, panel.title, "font-size=\"12\" fill=\"#20242a\"");
    for (const double tick : x.ticks()) {
        svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#e6e9ee\"/>", x.place(tick), top, bottom);
        svg += drawText(x.place(tick), bottom + 14, formatTick(tick), kSmallMiddle);
    }
    for (const double tick : y.ticks()) {
        svg += fmt::format("<path d=\"M{} {:.1f}H{}\" stroke=\"#e6e9ee\"/>", kLeft, y.place(tick), right);
        svg += drawText(kLeft - 7, y.place(tick) + 4, formatTick(tick), kSmallEnd);
    }
    if (panel.isLog) {
        svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#f3f5f8\"/>", kLeft,
                           bottom - kZeroBand, right - kLeft, kZeroBand);
        svg += drawText(kLeft - 7, bottom - 0.5 * kZeroBand + 4, "0", kSmallEnd);
    }
    svg += fmt::format("<path d=\"M{} {}V{}H{}\" stroke=\"#50565f\"/>\n", kLeft, top, bottom, right);
    for (const Curve& curve : panel.curves)
        svg += drawCurve(curve, xs, y, bottom);
    double row = top + 8;
    for (const LegendEntry& entry : panel.legend) {
        svg += fmt::format("<path d=\"M{0} {1}h20\" stroke=\"{2}\" stroke-width=\"2\"{3}/>", right + 14, row - 4,
                           entry.color, entry.dash.empty() ? "" : " stroke-dasharray=\"2 3\"");
        svg += drawText(right + 40, row, entry.name, kSmall);
        row += 15;
    }
    return svg;
}

// Rows where a value is NaN or infinite, where a backend gave no answer, and where the format refuses the value.
std::string drawMarks(const SweepResult& result, const std::vector<double>& xs, double top, double bottom)
{
    std::string svg;
    for (size_t i = 0; i < xs.size(); ++i) {
        const SweepRow& row = result.rows[i];
        const bool isBad = std::any_of(row.cells.begin(), row.cells.end(), [](const SweepCell& cell) {
            return cell.notFinite > 0 || !cell.failure.empty();
        });
        if (!row.refused.empty()) {
            svg += fmt::format("<path d=\"M{:.1f} {}V{}\" stroke=\"#b9bec6\" stroke-width=\"5\" "
                               "stroke-opacity=\"0.5\"/>\n",
                               xs[i], top, bottom);
        } else if (isBad) {
            svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{}\" r=\"4\" fill=\"#e000c0\"/>\n", xs[i], top);
        }
    }
    return svg;
}

std::string drawEdges(const SweepResult& result, const Axis& x, double top, double bottom)
{
    std::string svg;
    for (size_t i = 0; i < result.edges.size(); ++i) {
        const double at = x.place(result.range.middle(result.edges[i].low, result.edges[i].high));
        svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#20242a\" stroke-width=\"0.9\" "
                           "stroke-dasharray=\"6 3\"/>\n",
                           at, top, bottom);
        svg += drawText(at, top - 18 - 11 * static_cast<double>(i % 2), fmt::format("{}", i + 1),
                        "font-size=\"11\" font-weight=\"bold\" fill=\"#20242a\" text-anchor=\"middle\"");
    }
    return svg;
}

std::vector<std::string> wrap(const std::string& text)
{
    std::vector<std::string> lines;
    std::string rest = text;
    while (rest.size() > kLineLength) {
        size_t space = rest.rfind(' ', kLineLength);
        if (space == std::string::npos || space == 0) space = kLineLength;
        lines.push_back(rest.substr(0, space));
        rest = "    " + rest.substr(space + 1);
    }
    lines.push_back(rest);
    return lines;
}

std::vector<std::string> textBelow(const SweepResult& result)
{
    std::vector<std::string> lines;
    for (size_t i = 0; i < result.edges.size(); ++i) {
        for (const std::string& line : wrap(fmt::format("{}  {}", i + 1, result.edges[i].sentence)))
            lines.push_back(line);
    }
    if (result.edges.empty()) lines.emplace_back("No edge: nothing jumps in this range.");
    return lines;
}

// Of several keys the first.
std::string labelOf(const std::string& parameter)
{
    const auto others = std::count(parameter.begin(), parameter.end(), ',');
    return others == 0 ? parameter : fmt::format("{} and {} more", parameter.substr(0, parameter.find(',')), others);
}

} // namespace

std::string formatSweepSvg(const SweepResult& result)
{
    const std::string label = labelOf(result.parameter);
    const Axis x{result.range.from, result.range.to, kLeft, kWidth - kRight, result.range.isLog};
    std::vector<double> xs;
    for (const SweepRow& row : result.rows)
        xs.push_back(x.place(row.value));
    std::vector<Panel> panels;
    addErrorPanels(result, panels);
    panels.push_back(makeClassPanel(result));
    if (Panel iterations = makeIterationPanel(result); !isEmpty(iterations)) panels.push_back(std::move(iterations));

    const double step = kPanel + kGap;
    const double bottom = kTop + 34 + step * static_cast<double>(panels.size()) - kGap;
    const std::vector<std::string> lines = textBelow(result);
    const double height = bottom + 56 + 16 * static_cast<double>(lines.size());
    std::string svg =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                    "font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"none\">\n<title>{2}</title>\n"
                    "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                    kWidth, height, escapeMarkup(result.caseName + ": " + label));
    svg += drawText(kLeft, 24, result.caseName + ": " + label, "font-size=\"15\" fill=\"#20242a\"");
    svg += drawMarks(result, xs, kTop + 34, bottom);
    double top = kTop + 34;
    for (const Panel& panel : panels) {
        svg += drawPanel(panel, x, xs, top);
        top += step;
    }
    svg += drawEdges(result, x, kTop + 10, bottom);
    svg += drawText(0.5 * (kLeft + kWidth - kRight), bottom + 32, label,
                    "font-size=\"12\" fill=\"#20242a\" text-anchor=\"middle\"");
    double row = bottom + 54;
    for (const std::string& line : lines) {
        svg += drawText(16, row, line, "font-size=\"11\" fill=\"#20242a\" xml:space=\"preserve\"");
        row += 16;
    }
    return svg + "</svg>\n";
}

} // namespace crossray
