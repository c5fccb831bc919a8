#include "harness/bench/chart.h"

#include "harness/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

constexpr double kWidth = 880, kHeight = 560;
constexpr double kLeft = 78, kRight = 24, kTop = 48, kBottom = 62;
constexpr double kZeroBand = 26;    // pixels below the axis, for errors of 0
constexpr double kNameMargin = 170; // for the names of curves
constexpr double kTextHeight = 13, kTextWidth = 6.5;
constexpr double kNearName = 40; // pixels from a point to its name; what finds no place there is numbered
constexpr double kKeyWidth = 270;
constexpr const char* kFrontColor = "#1f5fa8";
constexpr const char* kPaleColor = "#b9bec6";
constexpr const char* kOwnColor = "#c2571a";
constexpr std::array<const char*, 4> kSeriesColors{"#1f5fa8", "#c2571a", "#2f8f4e", "#7a4fa3"};

bool isDrawn(const ChartPoint& point)
{
    return std::isfinite(point.cost) && std::isfinite(point.error) && point.cost > 0 && point.error >= 0;
}

// A logarithmic axis over whole 1-2-5 steps around the values.
struct LogAxis {
    double low = 1, high = 10;
    double begin = 0, end = 1; // pixels of low and high

    double place(double value) const { return begin + (end - begin) * std::log(value / low) / std::log(high / low); }
    std::vector<double> ticks() const
    {
        std::vector<double> found;
        const bool isWide = high / low > 2000;
        for (int decade = static_cast<int>(std::floor(std::log10(low))); std::pow(10, decade) <= high * 1.001;
             ++decade) {
            for (const double step : {1.0, 2.0, 5.0}) {
                const double value = step * std::pow(10, decade);
                if (isWide && step != 1.0) continue;
                if (value >= low * 0.999 && value <= high * 1.001) found.push_back(value);
            }
        }
        return found;
    }
};

double stepBelow(double value)
{
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {5.0, 2.0, 1.0}) {
        if (step * decade <= value * 0.999) return step * decade;
    }
    return 0.5 * decade;
}

double stepAbove(double value)
{
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0, 10.0}) {
        if (step * decade >= value * 1.001) return step * decade;
    }
    return 20 * decade;
}

LogAxis makeAxis(const std::vector<double>& values, double begin, double end)
{
    LogAxis axis;
    axis.begin = begin;
    axis.end = end;
    if (values.empty()) return axis;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    axis.low = stepBelow(*low);
    axis.high = stepAbove(*high);
    return axis;
}

std::string formatNumber(double value)
{
    return value >= 1e-4 && value < 1e5 ? fmt::format("{:g}", value) : fmt::format("{:.0e}", value);
}

struct Box {
    double x0, y0, x1, y1;
    bool overlaps(const Box& other) const { return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1; }
};

// Finds a free place for each label near its point, nearest first; draws a leader where it is not beside the point.
class Labels {
  public:
    void block(double x, double y, double radius) { block(x, y, x, y, radius); }
    // A straight line along an axis.
    void block(double x0, double y0, double x1, double y1, double radius)
    {
        taken_.push_back({std::min(x0, x1) - radius, std::min(y0, y1) - radius, std::max(x0, x1) + radius,
                          std::max(y0, y1) + radius});
    }
    // Nothing where there is no free place within `reach` pixels.
    std::string add(double x, double y, const std::string& text, const char* color, double reach)
    {
        const double width = kTextWidth * static_cast<double>(text.size());
        for (double distance = 0; distance < reach; distance += kTextHeight) {
            for (const double side : {1.0, -1.0}) {
                for (const double lift : {0.0, -1.0, 1.0}) {
                    if (distance > 0 && lift == 0.0) continue;
                    const double left = side > 0 ? x + 8 + 0.3 * distance : x - 8 - 0.3 * distance - width;
                    const double baseline = y + 4 + lift * distance;
                    const Box box{left, baseline - kTextHeight + 2, left + width, baseline + 3};
                    if (isFree(box)) return place(x, y, box, baseline, text, color, distance > 0);
                }
            }
        }
        return "";
    }

  private:
    bool isFree(const Box& box) const
    {
        if (box.x0 < kLeft + 2 || box.x1 > kWidth - 4 || box.y0 < kTop - 6 || box.y1 > kHeight - kBottom) return false;
        return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return box.overlaps(other); });
    }
    std::string place(double x, double y, const Box& box, double baseline, const std::string& text, const char* color,
                      bool hasLeader)
    {
        taken_.push_back(box);
        std::string svg;
        if (hasLeader) {
            const double end = box.x0 > x ? box.x0 - 2 : box.x1 + 2;
            svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-width=\"0.6\"/>\n", x, y,
                               end, baseline - 4, color);
        }
        return svg + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" fill=\"{}\" stroke=\"#ffffff\" "
                                 "stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
                                 box.x0, baseline, color, escapeMarkup(text));
    }
    std::vector<Box> taken_;
};

std::string openSvg(const std::string& title, double width, double height)
{
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                       "font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"none\">\n<title>{2}</title>\n"
                       "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
                       "<text x=\"{3}\" y=\"26\" font-size=\"15\" fill=\"#20242a\">{2}</text>\n",
                       width, height, escapeMarkup(title), kLeft);
}

std::string drawAxes(const Chart& chart, const LogAxis& x, const LogAxis& y, bool hasZeros)
{
    const double right = kWidth - kRight, bottom = y.begin;
    std::string svg;
    for (const double tick : x.ticks()) {
        const double at = x.place(tick);
        svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2}\" stroke=\"#e6e9ee\"/><text x=\"{0:.1f}\" y=\"{3}\" "
                           "font-size=\"11\" fill=\"#50565f\" text-anchor=\"middle\">{4}</text>\n",
                           at, bottom, kTop, kHeight - kBottom + 18, formatNumber(tick));
    }
    for (const double tick : y.ticks()) {
        const double at = y.place(tick);
        svg += fmt::format("<path d=\"M{0} {1:.1f}H{2}\" stroke=\"#e6e9ee\"/><text x=\"{3}\" y=\"{4:.1f}\" "
                           "font-size=\"11\" fill=\"#50565f\" text-anchor=\"end\">{5}</text>\n",
                           kLeft, at, right, kLeft - 7, at + 4, formatNumber(tick));
    }
    if (hasZeros) {
        svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#f3f5f8\"/><text x=\"{}\" "
                           "y=\"{:.1f}\" font-size=\"11\" fill=\"#50565f\" text-anchor=\"end\">0</text>\n",
                           kLeft, bottom, right - kLeft, kZeroBand, kLeft - 7, bottom + 0.5 * kZeroBand + 4);
    }
    svg +=
        fmt::format("<path d=\"M{0} {1}V{2:.1f}H{3}\" stroke=\"#50565f\"/>\n", kLeft, kTop, kHeight - kBottom, right);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"12\" fill=\"#20242a\" text-anchor=\"middle\">{}</text>\n",
                       0.5 * (kLeft + right), kHeight - 14, escapeMarkup(chart.costLabel));
    svg += fmt::format("<text transform=\"translate(20 {}) rotate(-90)\" font-size=\"12\" fill=\"#20242a\" "
                       "text-anchor=\"middle\">{}</text>\n",
                       0.5 * (kTop + kHeight - kBottom), escapeMarkup(chart.errorLabel));
    return svg;
}

struct Placed {
    const ChartPoint* point;
    double x, y;
    bool isOnFront;
};

std::vector<Placed> sortFront(std::vector<Placed> placed)
{
    std::erase_if(placed, [](const Placed& p) { return !p.isOnFront; });
    std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
    return placed;
}

std::string drawFront(const std::vector<Placed>& front)
{
    if (front.size() < 2) return "";
    std::string path = fmt::format("M{:.1f} {:.1f}", front[0].x, front[0].y);
    for (size_t i = 1; i < front.size(); ++i) // what is reached at a cost stays reached until the next point
        path += fmt::format("H{:.1f}V{:.1f}", front[i].x, front[i].y);
    return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"1.4\" stroke-opacity=\"0.6\"/>\n", path,
                       kFrontColor);
}

std::string drawPoint(const Placed& p)
{
    if (p.point->isBound) {
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" stroke=\"#2f8f4e\" stroke-width=\"1.6\"/>\n",
                           p.x, p.y);
    }
    const char* const color = p.point->isOwn ? kOwnColor : p.isOnFront ? kFrontColor : kPaleColor;
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"{}\"><title>{}</title></circle>\n", p.x,
                       p.y, color, escapeMarkup(p.point->name));
}

const char* nameColor(const Placed& p)
{
    return p.point->isOwn ? kOwnColor : p.isOnFront ? "#20242a" : "#8a9099";
}

// What the numbers beside crowded points stand for, in a column of its own.
std::string drawKey(const std::vector<const Placed*>& numbered)
{
    std::string svg;
    double y = kTop + 8;
    for (size_t i = 0; i < numbered.size(); ++i, y += 17) {
        svg +=
            fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"11\" fill=\"{}\"><tspan font-weight=\"bold\">{}</tspan>"
                        "<tspan x=\"{}\">{}</tspan></text>\n",
                        kWidth, y, nameColor(*numbered[i]), i + 1, kWidth + 24, escapeMarkup(numbered[i]->point->name));
    }
    return svg;
}

// `width`: grows where points are too close to each other for their names.
std::string drawPoints(const std::vector<Placed>& placed, const std::vector<Placed>& front, double& width)
{
    Labels labels;
    std::string svg;
    for (const Placed& p : placed)
        labels.block(p.x, p.y, 5);
    for (size_t i = 1; i < front.size(); ++i) {
        labels.block(front[i - 1].x, front[i - 1].y, front[i].x, front[i - 1].y, 1);
        labels.block(front[i].x, front[i - 1].y, front[i].x, front[i].y, 1);
    }
    // A person's own names have the first choice of places, then those of the front; their dots lie on top.
    const auto rank = [](const Placed& p) { return p.point->isOwn ? 0 : p.isOnFront ? 1 : 2; };
    std::string names;
    std::vector<const Placed*> numbered;
    for (const int turn : {0, 1, 2}) {
        for (const Placed& p : placed) {
            if (rank(p) == 2 - turn) svg += drawPoint(p);
            if (rank(p) != turn) continue;
            const std::string name = labels.add(p.x, p.y, p.point->name, nameColor(p), kNearName);
            if (name.empty()) numbered.push_back(&p);
            names += name;
        }
    }
    std::sort(numbered.begin(), numbered.end(), [](const Placed* a, const Placed* b) { return a->y < b->y; });
    for (size_t i = 0; i < numbered.size(); ++i) {
        const Placed& p = *numbered[i];
        names += labels.add(p.x, p.y, std::to_string(i + 1), nameColor(p), 200);
    }
    if (!numbered.empty()) width += kKeyWidth;
    return svg + names + drawKey(numbered);
}

// Each name's points as one line with dots; the names stand in the margin, in the order of the lines' ends.
std::string drawCurves(const std::vector<Placed>& placed)
{
    std::vector<std::vector<Placed>> curves;
    for (const Placed& p : placed) {
        const auto same = [&](const std::vector<Placed>& curve) { return curve[0].point->name == p.point->name; };
        const auto found = std::find_if(curves.begin(), curves.end(), same);
        found == curves.end() ? curves.push_back({p}) : found->push_back(p);
    }
    for (std::vector<Placed>& curve : curves)
        std::sort(curve.begin(), curve.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
    std::sort(curves.begin(), curves.end(), [](const auto& a, const auto& b) { return a.back().y < b.back().y; });
    std::string svg;
    double below = kTop;
    for (size_t i = 0; i < curves.size(); ++i) {
        const char* const color = kSeriesColors[i % kSeriesColors.size()];
        std::string path;
        for (const Placed& p : curves[i]) {
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x, p.y);
            svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", p.x, p.y, color);
        }
        const Placed& last = curves[i].back();
        const double row = std::max(last.y, below + kTextHeight);
        below = row;
        svg += fmt::format("<path d=\"{0}\" stroke=\"{1}\" stroke-width=\"1.4\"{2}/><path d=\"M{3:.1f} {4:.1f}L{5:.1f} "
                           "{6:.1f}\" stroke=\"{1}\" stroke-width=\"0.6\"/><text x=\"{7:.1f}\" y=\"{8:.1f}\" "
                           "font-size=\"11\" fill=\"{1}\">{9}</text>\n",
                           path, color, i < kSeriesColors.size() ? "" : " stroke-dasharray=\"5 3\"", last.x, last.y,
                           last.x + 16, row, last.x + 19, row + 4, escapeMarkup(last.point->name));
    }
    return svg;
}

} // namespace

std::vector<bool> findParetoFront(std::span<const ChartPoint> points)
{
    std::vector<bool> front;
    for (const ChartPoint& point : points) {
        const bool isDominated = std::any_of(points.begin(), points.end(), [&](const ChartPoint& other) {
            const bool isNoWorse = other.cost <= point.cost && other.error <= point.error;
            const bool isBetter = other.cost < point.cost || other.error < point.error;
            return isDrawn(other) && !other.isBound && isNoWorse && isBetter;
        });
        front.push_back(isDrawn(point) && !point.isBound && !isDominated);
    }
    return front;
}

std::vector<bool> findChartFront(const Chart& chart)
{
    return chart.isOfCurves ? std::vector<bool>(chart.points.size(), false) : findParetoFront(chart.points);
}

std::string formatChartSvg(const Chart& chart)
{
    const std::vector<bool> front = findChartFront(chart);
    std::vector<double> costs, errors;
    bool hasZeros = false;
    for (const ChartPoint& point : chart.points) {
        if (!isDrawn(point)) continue;
        costs.push_back(point.cost);
        if (point.error > 0) errors.push_back(point.error);
        hasZeros = hasZeros || point.error == 0;
    }
    const LogAxis x = makeAxis(costs, kLeft, kWidth - (chart.isOfCurves ? kNameMargin : kRight));
    const LogAxis y = makeAxis(errors, kHeight - kBottom - (hasZeros ? kZeroBand : 0), kTop);
    std::vector<Placed> placed;
    for (size_t i = 0; i < chart.points.size(); ++i) {
        const ChartPoint& point = chart.points[i];
        if (!isDrawn(point)) continue;
        const double height = point.error > 0 ? y.place(point.error) : y.begin + 0.5 * kZeroBand;
        placed.push_back({&point, x.place(point.cost), height, front[i]});
    }
    const std::vector<Placed> sorted = sortFront(placed);
    double width = kWidth;
    const std::string drawn =
        chart.isOfCurves ? drawCurves(placed) : drawFront(sorted) + drawPoints(placed, sorted, width);
    return openSvg(chart.title, width, kHeight) + drawAxes(chart, x, y, hasZeros) + drawn + "</svg>\n";
}

std::string formatReliabilitySvg(const std::string& title, std::span<const ReliabilitySeries> series)
{
    constexpr double kSide = 440;
    const auto x = [](double value) { return kLeft + kSide * value; };
    const auto y = [](double value) { return kTop + kSide * (1 - value); };
    std::string svg = openSvg(title, kLeft + kSide + 220, kTop + kSide + kBottom);
    for (int i = 0; i <= 10; i += 2) {
        const double value = 0.1 * i;
        svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {4:.1f}H{5:.1f}\" stroke=\"#e6e9ee\"/><text "
                           "x=\"{0:.1f}\" y=\"{6:.1f}\" font-size=\"11\" fill=\"#50565f\" "
                           "text-anchor=\"middle\">{7:g}</text><text x=\"{8:.1f}\" y=\"{9:.1f}\" font-size=\"11\" "
                           "fill=\"#50565f\" text-anchor=\"end\">{7:g}</text>\n",
                           x(value), y(0), y(1), x(0), y(value), x(1), y(0) + 18, value, x(0) - 7, y(value) + 4);
    }
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#50565f\" stroke-dasharray=\"4 4\"/>\n", x(0),
                       y(0), x(1), y(1));
    double row = kTop + 12;
    for (size_t i = 0; i < series.size(); ++i) {
        const char* const color = kSeriesColors[i % kSeriesColors.size()];
        std::string path;
        for (const ReliabilityDot& dot : series[i].dots) {
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(dot.confidence), y(dot.right));
            const double radius = std::clamp(0.6 * std::sqrt(std::sqrt(dot.count)), 2.0, 12.0);
            svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" fill-opacity=\"0.7\"/>\n",
                               x(dot.confidence), y(dot.right), radius, color);
        }
        svg += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"1\"/>\n", path, color);
        svg +=
            fmt::format("<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"5\" fill=\"{2}\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
                        "font-size=\"11\" fill=\"#20242a\">{5}</text>\n",
                        x(1) + 22, row - 4, color, x(1) + 33, row, escapeMarkup(series[i].name));
        row += 18;
    }
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" fill=\"#20242a\" text-anchor=\"middle\">"
                       "confidence that was given</text>\n",
                       x(0.5), y(0) + 42);
    svg += fmt::format("<text transform=\"translate(20 {:.1f}) rotate(-90)\" font-size=\"12\" fill=\"#20242a\" "
                       "text-anchor=\"middle\">share of these hits that are right</text>\n",
                       y(0.5));
    return svg + "</svg>\n";
}

} // namespace crossray
