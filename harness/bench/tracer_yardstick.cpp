#include "harness/bench/tracer_yardstick.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace crossray {

namespace {

constexpr int kGroup = 32;

double percentile(std::vector<double>& values, double share)
{
    if (values.empty()) return 0;
    const auto index = static_cast<size_t>(share * static_cast<double>(values.size()));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::min(index, values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

double share(double part, double whole, double ofNothing)
{
    return whole > 0 ? part / whole : ofNothing;
}

struct Column {
    double TracerScore::*value;
    bool moreIsBetter;
};
constexpr std::array<Column, 11> kColumns{{{&TracerScore::recall, true},
                                           {&TracerScore::precision, true},
                                           {&TracerScore::falseShare, false},
                                           {&TracerScore::wrong, false},
                                           {&TracerScore::medianPixels, false},
                                           {&TracerScore::p95Pixels, false},
                                           {&TracerScore::medianDepth, false},
                                           {&TracerScore::fetches, false},
                                           {&TracerScore::groupFetches, false},
                                           {&TracerScore::iterations, false},
                                           {&TracerScore::capped, false}}};

} // namespace

TracerScore scoreTracer(const YardstickScene& scene, const Tracer& tracer, std::span<ReliabilityBin> bins)
{
    double answerable = 0, claimed = 0, falseHits = 0, fetches = 0, iterations = 0, capped = 0;
    double groupSum = 0, groups = 0;
    int groupMaximum = 0;
    std::vector<double> pixels, depths;
    for (size_t i = 0; i < scene.rays.size(); ++i) {
        const YardstickRay& ray = scene.rays[i];
        const TracerAnswer answer = tracer(ray);
        const bool isAnswerable = ray.truth == RayTruth::kAnswerable;
        const double error = glm::length(answer.positionSS - ray.hitPositionSS);
        answerable += isAnswerable;
        claimed += answer.isHit;
        falseHits += answer.isHit && !isAnswerable;
        if (answer.isHit && isAnswerable && error <= kRightPixels) {
            pixels.push_back(error);
            depths.push_back(std::abs(answer.linearDepth / ray.hitLinearDepth - 1));
        }
        if (answer.isHit && answer.confidence > 0 && !bins.empty()) {
            const auto count = static_cast<double>(bins.size());
            ReliabilityBin& bin = bins[static_cast<size_t>(std::min(answer.confidence * count, count - 1))];
            bin.count += 1; // sums, until all scenes are in
            bin.confidence += answer.confidence;
            bin.right += isAnswerable && error <= kRightPixels;
        }
        fetches += answer.fetches;
        iterations += answer.iterations;
        capped += answer.isCapped;
        groupMaximum = std::max(groupMaximum, answer.fetches);
        if (i % kGroup == kGroup - 1 || i + 1 == scene.rays.size()) {
            groupSum += groupMaximum;
            groups += 1;
            groupMaximum = 0;
        }
    }
    const auto rays = static_cast<double>(scene.rays.size());
    const auto right = static_cast<double>(pixels.size());
    TracerScore score;
    score.recall = share(right, answerable, 1);
    score.precision = share(right, claimed, 1);
    score.falseShare = share(falseHits, rays - answerable, 0);
    score.wrong = share(answerable - right + falseHits, rays, 0);
    score.medianPixels = percentile(pixels, 0.5);
    score.p95Pixels = percentile(pixels, 0.95);
    score.medianDepth = percentile(depths, 0.5);
    score.fetches = share(fetches, rays, 0);
    score.groupFetches = share(groupSum, groups, 0);
    score.iterations = share(iterations, rays, 0);
    score.capped = share(capped, rays, 0);
    return score;
}

TracerRow summarize(std::string name, std::span<const TracerScore> scores)
{
    TracerRow row{std::move(name), {}, {}, static_cast<int>(scores.size())};
    if (scores.empty()) return row;
    row.worst = scores.front();
    for (const Column& column : kColumns) {
        double sum = 0;
        for (const TracerScore& score : scores) {
            const double value = score.*column.value;
            double& worst = row.worst.*column.value;
            worst = column.moreIsBetter ? std::min(worst, value) : std::max(worst, value);
            sum += value;
        }
        row.mean.*column.value = sum / static_cast<double>(scores.size());
    }
    return row;
}

namespace {

using Bins = std::array<ReliabilityBin, kReliabilityBins>;

// One method over all scenes.
struct Tally {
    std::vector<TracerScore> scores; // by scene
    std::vector<Bins> bins;
};

void measureScene(std::span<const TracerMethod> methods, const YardstickScene& scene, size_t index,
                  std::vector<Tally>& tallies)
{
    for (size_t i = 0; i < methods.size(); ++i)
        tallies[i].scores[index] = scoreTracer(scene, methods[i].prepare(scene), tallies[i].bins[index]);
}

std::vector<MeasuredTracer> finish(std::span<const TracerMethod> methods, const std::vector<Tally>& tallies)
{
    std::vector<MeasuredTracer> measured;
    for (size_t i = 0; i < methods.size(); ++i) {
        MeasuredTracer tracer{summarize(methods[i].name, tallies[i].scores), {}};
        Bins sums{};
        for (const Bins& scene : tallies[i].bins) {
            for (size_t bin = 0; bin < sums.size(); ++bin) {
                sums[bin].count += scene[bin].count;
                sums[bin].confidence += scene[bin].confidence;
                sums[bin].right += scene[bin].right;
            }
        }
        for (const ReliabilityBin& sum : sums) {
            if (sum.count > 0)
                tracer.reliability.push_back({sum.confidence / sum.count, sum.right / sum.count, sum.count});
        }
        measured.push_back(std::move(tracer));
    }
    return measured;
}

std::vector<Tally> makeTallies(size_t methods, size_t scenes)
{
    return std::vector<Tally>(methods, {std::vector<TracerScore>(scenes), std::vector<Bins>(scenes)});
}

} // namespace

std::vector<MeasuredTracer> measureTracers(std::span<const TracerMethod> methods, const YardstickOptions& options,
                                           const std::function<void(uint64_t)>& report)
{
    const auto scenes = static_cast<size_t>(options.lastSeed - options.firstSeed + 1);
    std::vector<Tally> tallies = makeTallies(methods.size(), scenes);
    std::atomic<size_t> next = 0;
    std::mutex reporting;
    std::exception_ptr failure; // the first one; it ends the others' work, too
    const auto measureAll = [&] {
        for (size_t index = next++; index < scenes; index = next++) {
            const uint64_t seed = options.firstSeed + index;
            const YardstickScene scene = makeYardstickScene(options.family, seed, options.width, options.height,
                                                            options.stride, options.disturbance);
            measureScene(methods, scene, index, tallies);
            const std::lock_guard lock(reporting);
            if (report) report(seed);
        }
    };
    const auto work = [&] {
        try {
            measureAll();
        } catch (...) {
            next = scenes;
            const std::lock_guard lock(reporting);
            if (!failure) failure = std::current_exception();
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 1; i < options.threads; ++i)
        threads.emplace_back(work);
    work();
    threads.clear(); // joins
    if (failure) std::rethrow_exception(failure);
    return finish(methods, tallies);
}

std::vector<MeasuredTracer> measureTracers(std::span<const TracerMethod> methods, const YardstickScene& scene)
{
    std::vector<Tally> tallies = makeTallies(methods.size(), 1);
    measureScene(methods, scene, 0, tallies);
    return finish(methods, tallies);
}

std::string formatTracerTable(std::span<const MeasuredTracer> rows)
{
    std::string text =
        "| tracer | recall (min) | precision | false (max) | median / p95 px | fetches | of 32 | steps | "
        "capped |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const MeasuredTracer& tracer : rows) {
        const TracerRow& row = tracer.row;
        const TracerScore& m = row.mean;
        text += fmt::format("| {} | {:.3f} ({:.3f}) | {:.3f} | {:.4f} ({:.3f}) | {:.3f} / {:.3f} | {:.1f} | {:.0f} | "
                            "{:.1f} | {:.3f} % |\n",
                            row.name, m.recall, row.worst.recall, m.precision, m.falseShare, row.worst.falseShare,
                            m.medianPixels, m.p95Pixels, m.fetches, m.groupFetches, m.iterations, 100 * m.capped);
    }
    return text;
}

} // namespace crossray
