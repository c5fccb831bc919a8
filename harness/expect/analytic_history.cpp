// The previous frame's colour (domain, section 1): each level's cells are means over the pixels that they cover, taken
// from the image itself and not from the level before; between cells and between levels the weight falls linearly with
// the distance.
#include "harness/expect/analytic.h"
#include "harness/expect/frame_history.h"

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr double kSmallestCoverage = 1e-6;

// Pixels [first, last] of a side that a cell covers: 2^level of them, and in the last cell what is left of the side.
struct Span {
    int first, last;
};
Span spanOf(int cell, int cells, int level, int side)
{
    const int first = cell * (1 << level);
    return {first, cell + 1 == cells ? side - 1 : first + (1 << level) - 1};
}

bool isValid(const Plane& color, int x, int y)
{
    for (int channel = 0; channel < 3; ++channel) {
        const double value = color.at(x, y, channel);
        if (!std::isfinite(value) || value < 0.0) return false;
    }
    return true;
}

// Mean of the valid pixels, and their share.
glm::dvec4 averageSpans(const Plane& color, Span columns, Span rows)
{
    glm::dvec3 sum(0.0);
    int valid = 0, all = 0;
    for (int y = rows.first; y <= rows.last; ++y)
        for (int x = columns.first; x <= columns.last; ++x) {
            ++all;
            if (!isValid(color, x, y)) continue;
            sum += glm::dvec3(color.at(x, y, 0), color.at(x, y, 1), color.at(x, y, 2));
            ++valid;
        }
    if (valid == 0) return glm::dvec4(0.0);
    return glm::dvec4(sum / static_cast<double>(valid), static_cast<double>(valid) / all);
}

glm::dvec4 cellOf(const Plane& level, int x, int y)
{
    const int column = std::clamp(x, 0, level.width - 1), row = std::clamp(y, 0, level.height - 1);
    return {level.at(column, row, 0), level.at(column, row, 1), level.at(column, row, 2), level.at(column, row, 3)};
}

} // namespace

std::vector<Plane> averageLevels(const Plane& color)
{
    std::vector<Plane> levels;
    int width = color.width, height = color.height;
    for (int level = 0;; ++level) {
        Plane plane("ColorLevel", width, height, 4);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const glm::dvec4 cell =
                    averageSpans(color, spanOf(x, width, level, color.width), spanOf(y, height, level, color.height));
                for (int channel = 0; channel < 4; ++channel)
                    plane.at(x, y, channel) = cell[channel];
            }
        levels.push_back(std::move(plane));
        if (width == 1 && height == 1) return levels;
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
}

std::optional<glm::dvec3> colorAt(const std::vector<Plane>& levels, const glm::dvec2& uv, double level)
{
    glm::dvec3 sum(0.0);
    double total = 0;
    for (size_t i = 0; i < levels.size(); ++i) {
        const double ofLevel = 1.0 - std::abs(level - static_cast<double>(i));
        if (!(ofLevel > 0.0)) continue;
        const glm::dvec2 place = uv * glm::dvec2(levels[i].width, levels[i].height);
        const int column = static_cast<int>(std::floor(place.x - 0.5)),
                  row = static_cast<int>(std::floor(place.y - 0.5));
        for (int y = row; y <= row + 1; ++y)
            for (int x = column; x <= column + 1; ++x) {
                const double share =
                    ofLevel * (1.0 - std::abs(place.x - (x + 0.5))) * (1.0 - std::abs(place.y - (y + 0.5)));
                const glm::dvec4 cell = cellOf(levels[i], x, y);
                sum += share * cell.w * glm::dvec3(cell);
                total += share * cell.w;
            }
    }
    if (!(total >= kSmallestCoverage)) return std::nullopt;
    return sum / total;
}

double colorLevelOf(double roughness, TraceEffect effect, int levels)
{
    const double exponent = effect == TraceEffect::kReflection ? 0.8 : 1.3;
    return std::pow(std::clamp(roughness, 0.0, 1.0), exponent) * (levels - 1);
}

} // namespace crossray
