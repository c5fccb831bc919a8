#include "harness/bench/tracer_yardstick.h"

#include "harness/scene/camera_frame.h"
#include "harness/scene/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace crossray {

namespace {

constexpr int kGroup = 32;
constexpr double kSelfHit = 1e-6; // metres by which a ray leaves its own surface

void fillTruth(const Scene& scene, const CameraFrame& frame, const glm::dvec3& originWS, YardstickRay& ray)
{
    const auto hit = castRay(scene, Ray{originWS, ray.dirWS}, kSelfHit);
    if (!hit) return;
    const ScreenPoint point = frame.project(hit->positionWS);
    if (!point.inFront || !frame.covers(point)) {
        ray.truth = RayTruth::kOffScreen;
        return;
    }
    ray.hitPositionSS = point.positionSS;
    ray.hitLinearDepth = point.linearDepth;
    const Ray look = frame.primaryRay(point.positionSS);
    const auto seen = castPrimaryRay(scene, frame, look);
    const bool isVisible = seen && frame.linearDepth(seen->positionWS) > point.linearDepth * (1 - 1e-6);
    const bool facesCamera = glm::dot(hit->normalWS, ray.dirWS) * glm::dot(hit->normalWS, look.dirWS) > 0;
    ray.truth = isVisible && facesCamera ? RayTruth::kAnswerable : RayTruth::kHidden;
}

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
constexpr std::array<Column, 10> kColumns{{{&TracerScore::recall, true},
                                           {&TracerScore::precision, true},
                                           {&TracerScore::falseShare, false},
                                           {&TracerScore::medianPixels, false},
                                           {&TracerScore::p95Pixels, false},
                                           {&TracerScore::medianDepth, false},
                                           {&TracerScore::fetches, false},
                                           {&TracerScore::groupFetches, false},
                                           {&TracerScore::iterations, false},
                                           {&TracerScore::capped, false}}};

} // namespace

YardstickScene makeYardstickRoom(uint64_t seed, int width, int height, int stride)
{
    const Scene scene = makeRandomRoom(seed);
    const Camera camera = makeRandomRoomCamera(seed, width, height);
    const CameraFrame frame(camera);
    const std::array channels{GBufferChannel::kDeviceDepth, GBufferChannel::kNormalWS};
    YardstickScene made{seed, renderGBuffer(scene, camera, channels), {}};
    for (int y = 0; y < height; y += stride) {
        for (int x = 0; x < width; x += stride) {
            const Ray primary = frame.primaryRay({x + 0.5, y + 0.5});
            const auto surface = castPrimaryRay(scene, frame, primary);
            if (!surface) continue;
            YardstickRay ray{.x = x, .y = y, .dirWS = glm::normalize(glm::reflect(primary.dirWS, surface->normalWS))};
            fillTruth(scene, frame, surface->positionWS, ray);
            made.rays.push_back(ray);
        }
    }
    return made;
}

TracerScore scoreTracer(const YardstickScene& scene, const Tracer& tracer)
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

std::vector<TracerRow> measureTracers(std::span<const TracerMethod> methods, uint64_t firstSeed, uint64_t lastSeed,
                                      int width, int height, const std::function<void(uint64_t)>& report)
{
    std::vector<std::vector<TracerScore>> scores(methods.size());
    for (uint64_t seed = firstSeed; seed <= lastSeed; ++seed) {
        const YardstickScene scene = makeYardstickRoom(seed, width, height);
        for (size_t i = 0; i < methods.size(); ++i)
            scores[i].push_back(scoreTracer(scene, methods[i].prepare(scene)));
        if (report) report(seed);
    }
    std::vector<TracerRow> rows;
    for (size_t i = 0; i < methods.size(); ++i)
        rows.push_back(summarize(methods[i].name, scores[i]));
    return rows;
}

std::string formatTracerTable(std::span<const TracerRow> rows)
{
    std::string text = "| tracer | recall (min) | precision | false | median / p95 px | fetches | of 32 | capped |\n"
                       "|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const TracerRow& row : rows) {
        const TracerScore& m = row.mean;
        text +=
            fmt::format("| {} | {:.3f} ({:.3f}) | {:.3f} | {:.4f} | {:.3f} / {:.3f} | {:.1f} | {:.0f} | {:.3f} % |\n",
                        row.name, m.recall, row.worst.recall, m.precision, m.falseShare, m.medianPixels, m.p95Pixels,
                        m.fetches, m.groupFetches, 100 * m.capped);
    }
    return text;
}

} // namespace crossray
