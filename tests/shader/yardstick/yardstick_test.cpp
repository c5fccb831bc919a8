// How good the HiZ tracer is: mirror rays in random rooms, judged by the harness's ray caster. The full table of
// shaders/README.md: test_yardstick --gtest_also_run_disabled_tests --gtest_filter='*Table'
#include "harness/scene/random_scene.h"
#include "tests/shader/yardstick/hiz.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace crossray;

namespace {

struct Score { // means over the rooms
    double recall = 0, worstRecall = 1, precision = 0, falseShare = 0, fetches = 0, iterations = 0;
    double medianError = 0; // pixels, of the found
};

struct Room {
    Scene scene;
    Camera camera;
    std::vector<std::optional<SurfaceHit>> seen;
};

Room renderRoom(uint64_t seed, int width, int height)
{
    Room room{makeRandomRoom(seed), makeRandomRoomCamera(seed, width, height), {}};
    std::vector<float> depths;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            auto hit = castRay(room.scene, computePrimaryRay(room.camera, {x + 0.5, y + 0.5}));
            const double depth = hit ? projectToScreen(room.camera, hit->positionWS).linearDepth : 0;
            if (depth >= room.camera.farDistance) hit.reset();
            depths.push_back(hit ? static_cast<float>(depth) : 0.0f);
            room.seen.push_back(hit);
        }
    }
    yardstick::Frame frame;
    const glm::dmat4 viewFromWorld = computeViewFromWorld(room.camera);
    for (int i = 0; i < 16; ++i) {
        frame.viewFromWorld[static_cast<size_t>(i)] = viewFromWorld[i / 4][i % 4];
        frame.worldFromView[static_cast<size_t>(i)] = room.camera.worldFromView[i / 4][i % 4];
    }
    frame.width = width;
    frame.height = height;
    frame.slopeY = std::tan(glm::radians(room.camera.fovYDegrees / 2));
    frame.slopeX = frame.slopeY * width / height;
    frame.nearDistance = room.camera.nearDistance;
    frame.farDistance = room.camera.farDistance;
    yardstick::setDepth(frame, depths);
    return room;
}

// Is what the ray really meets the nearest thing at its place on screen, seen from the side that the ray meets?
bool isAnswerable(const Room& room, const SurfaceHit& truth, const glm::dvec3& dirWS, const ScreenPoint& place)
{
    if (!place.inFront || !place.onScreen || place.linearDepth <= room.camera.nearDistance) return false;
    const Ray look = computePrimaryRay(room.camera, place.positionSS);
    const auto visible = castRay(room.scene, look);
    if (!visible || glm::length(visible->positionWS - truth.positionWS) > 1e-4 * (1 + visible->distance)) return false;
    return (glm::dot(truth.normalWS, dirWS) < 0) == (glm::dot(truth.normalWS, look.dirWS) < 0);
}

Score measure(int rooms, int width, int height, int stride, const yardstick::Settings& settings)
{
    Score score;
    std::vector<double> errors;
    for (int seed = 0; seed < rooms; ++seed) {
        const Room room = renderRoom(static_cast<uint64_t>(seed), width, height);
        double rays = 0, answerable = 0, found = 0, hits = 0, right = 0, wrong = 0, fetches = 0, iterations = 0;
        for (int y = 0; y < height; y += stride) {
            for (int x = 0; x < width; x += stride) {
                const auto& seen = room.seen[static_cast<size_t>(y * width + x)];
                if (!seen) continue;
                const glm::dvec3 dir =
                    glm::reflect(computePrimaryRay(room.camera, {x + 0.5, y + 0.5}).dirWS, seen->normalWS);
                const auto truth = castRay(room.scene, {seen->positionWS, dir}, 1e-6);
                const ScreenPoint place = truth ? projectToScreen(room.camera, truth->positionWS) : ScreenPoint{};
                const bool known = truth && isAnswerable(room, *truth, dir, place);
                const yardstick::Answer answer = yardstick::trace(x, y, {dir.x, dir.y, dir.z}, settings);
                const double error = std::hypot(answer.x - place.positionSS.x, answer.y - place.positionSS.y);
                const bool near = answer.hit && truth && error <= 2;
                if (known && near) errors.push_back(error);
                rays += 1;
                answerable += known;
                found += known && near;
                hits += answer.hit;
                right += near;
                wrong += answer.hit && !known;
                fetches += static_cast<double>(answer.fetches);
                iterations += answer.iterations;
            }
        }
        score.recall += found / answerable / rooms;
        score.worstRecall = std::min(score.worstRecall, found / answerable);
        score.precision += right / hits / rooms;
        score.falseShare += wrong / (rays - answerable) / rooms;
        score.fetches += fetches / rays / rooms;
        score.iterations += iterations / rays / rooms;
    }
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    score.medianError = *middle;
    return score;
}

} // namespace

TEST(Yardstick, HizOnRandomRooms)
{
    const Score score = measure(3, 320, 180, 2, {.depthBias = 0.05});
    EXPECT_GT(score.recall, 0.96);
    EXPECT_GT(score.precision, 0.94);
    EXPECT_LT(score.falseShare, 0.06);
    EXPECT_LT(score.medianError, 0.01);
    EXPECT_LT(score.fetches, 60);
}

TEST(Yardstick, DISABLED_Table)
{
    struct Row {
        int width, height, stride;
        yardstick::Settings settings;
    };
    for (const Row& row : {Row{1920, 1080, 4, {0, 99, 1000, 0.2}}, Row{1920, 1080, 4, {0, 99, 1000, 0}},
                           Row{1920, 1080, 4, {2, 6, 256, 0.2}}, Row{1920, 1080, 4, {2, 6, 32, 1}},
                           Row{640, 360, 2, {0, 99, 1000, 0.05}}}) {
        const Score s = measure(24, row.width, row.height, row.stride, row.settings);
        std::printf("| %dx%d | %d to %d | %d | %g | %.3f (%.3f) | %.3f | %.3f | %.2f | %.0f | %.0f |\n", row.width,
                    row.height, row.settings.minLevel, row.settings.maxLevel, row.settings.maxIterations,
                    row.settings.depthBias, s.recall, s.worstRecall, s.precision, s.falseShare, s.medianError,
                    s.fetches, s.iterations);
    }
}
