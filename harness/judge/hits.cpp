// A screen-space answer against what the screen could have known.
#include "harness/judge/judge.h"

#include "harness/base/error.h"
#include "harness/judge/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

struct HitCounts {
    uint64_t traced = 0, answerable = 0, claimed = 0, right = 0, wrong = 0, falseHits = 0, missed = 0;
    std::vector<double> distances; // px, of the answerable rays' claimed hits
    std::optional<PixelDifference> worstPlaced, firstMissed, firstFalse;
};

void checkHits(const std::vector<HitTruth>& truth, const Plane& hitSuccess, const Plane* positions,
               const HitBudget& budget)
{
    if (truth.size() != hitSuccess.pixelCount() || hitSuccess.channels != 1 ||
        hitSuccess.values.size() != hitSuccess.pixelCount()) {
        throw InputError(
            fmt::format("hit budget: HitSuccess is {}x{} with {} channels, allowed is one channel and the truth's {} "
                        "pixels",
                        hitSuccess.width, hitSuccess.height, hitSuccess.channels, truth.size()));
    }
    if (positions != nullptr && (positions->width != hitSuccess.width || positions->height != hitSuccess.height ||
                                 positions->channels != 2 || positions->values.size() != 2 * truth.size())) {
        throw InputError(fmt::format("hit budget: HitPositionSS is {}x{} with {} channels, allowed is {}x{} with 2",
                                     positions->width, positions->height, positions->channels, hitSuccess.width,
                                     hitSuccess.height));
    }
    if (!budget.recall && !budget.precision && !budget.falseHits) {
        throw InputError("hit budget: it bounds nothing, allowed are recall, precision and false");
    }
    for (const std::optional<double>& share : {budget.recall, budget.precision, budget.falseHits}) {
        if (share && !(*share >= 0.0 && *share <= 1.0)) {
            throw InputError(fmt::format("hit budget: a share is {}, allowed is 0 to 1", *share));
        }
    }
    if (!(budget.positionPx >= 0.0)) {
        throw InputError(
            fmt::format("hit budget: position_px is {}, allowed is a number of at least 0", budget.positionPx));
    }
}

// Kinds as numbers while pixels are counted; names are made once a plane.
constexpr int kRight = 0;
constexpr int kWrongPlace = 1;
constexpr int kNoPlace = 2;
constexpr int kFirstClassKind = 3;
constexpr int kKinds = kFirstClassKind + 2 * (kNanClass + 1);

std::string nameOfKind(int kind)
{
    if (kind == kWrongPlace) return "hit at the wrong place";
    if (kind == kNoPlace) return "hit at no finite place";
    const int claim = (kind - kFirstClassKind) / 2;
    const bool answerable = (kind - kFirstClassKind) % 2 == 1;
    return nameOfClass(claim) + (answerable ? " for hit" : " for unanswerable");
}

struct PixelPlace {
    int x, y;
};

PixelDifference classDifference(PixelPlace place, bool answerable, double value)
{
    const HitClass expected = answerable ? HitClass::kHit : HitClass::kUnknown;
    return {place.x, place.y, {static_cast<double>(expected)}, {value}, kNoDistance};
}

// Counts one traced pixel and returns the kind of its difference.
int countPixel(HitCounts& counts, const HitTruth& truth, double value, const double* position, double positionPx,
               PixelPlace place)
{
    const int claim = classOf(value);
    const bool claimed = claim == static_cast<int>(HitClass::kHit);
    const int classKind = kFirstClassKind + 2 * claim + (truth.answerable ? 1 : 0);
    ++counts.traced;
    counts.answerable += truth.answerable ? 1U : 0U;
    counts.claimed += claimed ? 1U : 0U;
    if (!truth.answerable) {
        if (!claimed) return claim < kNotAClass ? kRight : classKind;
        ++counts.falseHits;
        if (!counts.firstFalse) counts.firstFalse = classDifference(place, false, value);
        return classKind;
    }
    if (!claimed) {
        ++counts.missed;
        if (!counts.firstMissed) counts.firstMissed = classDifference(place, true, value);
        return classKind;
    }
    if (position == nullptr) {
        ++counts.right;
        return kRight;
    }
    const double distance = std::hypot(position[0] - truth.hitX, position[1] - truth.hitY);
    const double error = std::isfinite(distance) ? distance : kNoDistance;
    counts.distances.push_back(error);
    if (!counts.worstPlaced || error > counts.worstPlaced->error) {
        counts.worstPlaced =
            PixelDifference{place.x, place.y, {truth.hitX, truth.hitY}, {position[0], position[1]}, error};
    }
    if (std::isfinite(error) && error <= positionPx) {
        ++counts.right;
        return kRight;
    }
    ++counts.wrong;
    return std::isfinite(error) ? kWrongPlace : kNoPlace;
}

struct Violation {
    double shortfall; // in shares
    std::string text;
    std::optional<PixelDifference> pixel;
};

std::vector<Violation> findViolations(const HitCounts& counts, const HitBudget& budget, const Comparison& comparison)
{
    std::vector<Violation> violations;
    const auto value = [&](const char* name) {
        const auto metric = comparison.metrics.find(name);
        return metric == comparison.metrics.end() ? std::optional<double>() : metric->second;
    };
    const auto wrongPlace = counts.wrong > 0 ? counts.worstPlaced : std::nullopt;
    const auto require = [&](const char* name, const std::optional<double>& bound, const char* lacking,
                             const std::optional<PixelDifference>& pixel) {
        if (!bound) return;
        const std::optional<double> share = value(name);
        if (!share) {
            violations.push_back({2.0, fmt::format("{} has no value: {}", name, lacking), pixel});
        } else if (*share < *bound) {
            violations.push_back(
                {*bound - *share, fmt::format("{} {:.4f} is below {:.4g}", name, *share, *bound), pixel});
        }
    };
    require("recall", budget.recall, "no ray is answerable",
            counts.wrong > counts.missed ? wrongPlace : counts.firstMissed);
    require("precision", budget.precision, "no hit is claimed",
            wrongPlace ? wrongPlace : (counts.firstFalse ? counts.firstFalse : counts.firstMissed));
    const std::optional<double> falseShare = value("false");
    if (budget.falseHits && falseShare && *falseShare > *budget.falseHits) {
        violations.push_back({*falseShare - *budget.falseHits,
                              fmt::format("false {:.4f} is above {:.4g}", *falseShare, *budget.falseHits),
                              counts.firstFalse});
    }
    std::stable_sort(violations.begin(), violations.end(),
                     [](const Violation& a, const Violation& b) { return a.shortfall > b.shortfall; });
    return violations;
}

void setMetrics(Comparison& comparison, const HitCounts& counts)
{
    const uint64_t unanswerable = counts.traced - counts.answerable;
    auto& metrics = comparison.metrics;
    const auto share = [&](const char* name, uint64_t part, uint64_t whole) {
        if (whole > 0) metrics[name] = static_cast<double>(part) / static_cast<double>(whole);
    };
    share("recall", counts.right, counts.answerable);
    share("precision", counts.right, counts.claimed);
    share("false", counts.falseHits, unanswerable);
    metrics["traced"] = static_cast<double>(counts.traced);
    metrics["answerable"] = static_cast<double>(counts.answerable);
    metrics["unanswerable"] = static_cast<double>(unanswerable);
    metrics["claimed"] = static_cast<double>(counts.claimed);
    metrics["right"] = static_cast<double>(counts.right);
    metrics["wrong"] = static_cast<double>(counts.wrong);
    metrics["falseHits"] = static_cast<double>(counts.falseHits);
}

} // namespace

Comparison judgeHits(const std::vector<HitTruth>& truth, const Plane& hitSuccess, const Plane* hitPositionSS,
                     const HitBudget& budget)
{
    checkHits(truth, hitSuccess, hitPositionSS, budget);
    Comparison comparison;
    comparison.unit = "px";
    ConfusionMatrix confusion;
    HitCounts counts;
    counts.distances.reserve(truth.size());
    std::array<uint64_t, kKinds> kinds{};
    const auto width = static_cast<size_t>(hitSuccess.width);
    for (size_t pixel = 0; pixel < truth.size(); ++pixel) {
        if (!truth[pixel].traced) continue;
        const double value = hitSuccess.values[pixel];
        const PixelPlace place{static_cast<int>(pixel % width), static_cast<int>(pixel / width)};
        const double* position = hitPositionSS == nullptr ? nullptr : &hitPositionSS->values[pixel * 2];
        ++kinds[static_cast<size_t>(countPixel(counts, truth[pixel], value, position, budget.positionPx, place))];
        const HitClass expected = truth[pixel].answerable ? HitClass::kHit : HitClass::kUnknown;
        const int claim = classOf(value);
        if (claim < kNotAClass) ++confusion.counts[static_cast<int>(expected)][claim];
    }
    for (int kind = kWrongPlace; kind < kKinds; ++kind) {
        const uint64_t count = kinds[static_cast<size_t>(kind)];
        if (count == 0) continue;
        comparison.failed += count;
        comparison.census[nameOfKind(kind)] += count;
    }
    comparison.compared = counts.traced;
    comparison.confusion = confusion;
    setMetrics(comparison, counts);
    setStatistics(comparison, counts.distances);
    if (counts.traced == 0) {
        comparison.reason = "no pixel traces a ray";
        return comparison;
    }
    const std::vector<Violation> violations = findViolations(counts, budget, comparison);
    comparison.passed = violations.empty();
    comparison.worst = violations.empty() ? counts.worstPlaced : violations.front().pixel;
    for (const Violation& violation : violations) {
        comparison.reason += (comparison.reason.empty() ? "" : ", ") + violation.text;
    }
    if (!comparison.passed && comparison.worst) {
        const PixelDifference& worst = *comparison.worst;
        const std::string size = std::isfinite(worst.error) ? fmt::format("{:.4g} px off ", worst.error) : "";
        comparison.reason += fmt::format("; {}at ({}, {}): expected {}, actual {}", size, worst.x, worst.y,
                                         formatValues(worst.expected), formatValues(worst.actual));
    }
    return comparison;
}

} // namespace crossray
