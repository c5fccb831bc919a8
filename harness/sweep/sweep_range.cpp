// The values that a parameter takes, and which keys of the case format can be one.
#include "harness/base/error.h"
#include "harness/case/key_path.h"
#include "harness/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace crossray {

namespace {

constexpr int kMostSteps = 1000;

template <typename Number>
bool readNumber(const std::string& text, Number& number)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size();
}

[[noreturn]] void refuseRange(const std::string& text, const std::string& why)
{
    throw InputError(
        fmt::format("\"{}\": {}; allowed is FROM..TO[:STEPS][:log], such as 0.5..2.5:40 or 1..8192:14:log", text, why));
}

bool isSwept(const KeySpec& spec)
{
    switch (spec.type) {
    case KeyType::kNumber:
    case KeyType::kInteger:
    case KeyType::kSize:
    case KeyType::kVec3:
    case KeyType::kExtents:
    case KeyType::kRotation:
        break;
    default:
        return false;
    }
    return !spec.table.empty() && !spec.table.starts_with("expect");
}

// "scene.primitives.N.center.N": an index stands behind each list.
std::string describePath(const KeySpec& spec)
{
    std::string path;
    for (const std::string& part : splitPath(spec.path())) {
        path += (path.empty() ? "" : ".") + part;
        const bool isTableList = path == "scene.primitives" || path == "probe" || path == "history.moved";
        if (isTableList) path += ".N";
    }
    return path + (isNumberList(spec) ? ".N" : "");
}

const KeySpec& findSweptKey(const std::string& path)
{
    const PathTarget target = findPathTarget(path);
    if (target.spec != nullptr && isSwept(*target.spec) && isNumberList(*target.spec) == target.isComponent)
        return *target.spec;
    std::vector<std::string> allowed;
    for (const KeySpec& spec : keySpecs()) {
        if (isSwept(spec)) allowed.push_back(describePath(spec));
    }
    throw InputError(fmt::format("\"{}\" is no number of the case format{}", path, suggest(path, allowed)));
}

} // namespace

SweepRange SweepRange::parse(const std::string& text)
{
    SweepRange range;
    const std::vector<std::string> parts = splitPath(text, ':');
    const size_t dots = parts[0].find("..");
    if (dots == std::string::npos || !readNumber(parts[0].substr(0, dots), range.from) ||
        !readNumber(parts[0].substr(dots + 2), range.to) || !std::isfinite(range.from) || !std::isfinite(range.to)) {
        refuseRange(text, "no two numbers with .. between them");
    }
    for (size_t i = 1; i < parts.size(); ++i) {
        if (parts[i] == "log") {
            range.isLog = true;
        } else if (!readNumber(parts[i], range.steps) || range.steps < 2 || range.steps > kMostSteps) {
            refuseRange(text, fmt::format("\"{}\" is no number of steps from 2 to {}", parts[i], kMostSteps));
        }
    }
    if (range.from == range.to) refuseRange(text, "both ends are the same");
    if (range.isLog && (range.from <= 0 || range.to <= 0)) refuseRange(text, "log needs ends above 0");
    return range;
}

double SweepRange::middle(double a, double b) const
{
    return isLog ? std::sqrt(a) * std::sqrt(b) : 0.5 * (a + b);
}

double SweepRange::distance(double a, double b) const
{
    return isLog ? std::abs(std::log(a / b) / std::log(to / from)) : std::abs((a - b) / (to - from));
}

std::vector<double> SweepRange::values(bool isInteger) const
{
    std::vector<double> found;
    for (int i = 0; i < steps; ++i) {
        const double t = static_cast<double>(i) / (steps - 1);
        double value = isLog ? from * std::pow(to / from, t) : from + (to - from) * t;
        if (i == steps - 1) value = to;
        if (isInteger) value = std::round(value);
        if (found.empty() || found.back() != value) found.push_back(value);
    }
    return found;
}

SweepKeys SweepKeys::parse(const std::string& text)
{
    SweepKeys keys;
    keys.paths = splitPath(text, ',');
    keys.isInteger = true;
    for (const std::string& path : keys.paths) {
        const KeySpec& spec = findSweptKey(path);
        keys.isInteger = keys.isInteger && (spec.type == KeyType::kInteger || spec.type == KeyType::kSize);
    }
    return keys;
}

} // namespace crossray
