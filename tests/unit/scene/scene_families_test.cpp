#include "harness/scene/scene_families.h"

#include "harness/scene/camera_frame.h"

#include <gtest/gtest.h>

#include <set>

using namespace crossray;

TEST(SceneFamilies, NamesFindTheirFamily)
{
    std::set<std::string_view> names;
    for (const SceneFamily family : allSceneFamilies()) {
        EXPECT_EQ(findSceneFamily(nameOf(family)), family);
        names.insert(nameOf(family));
    }
    EXPECT_EQ(names.size(), allSceneFamilies().size());
    EXPECT_EQ(findSceneFamily("meadow"), std::nullopt);
}

TEST(SceneFamilies, ScenesAreValidAllMirrorsAndOwnToTheirSeed)
{
    for (const SceneFamily family : allSceneFamilies()) {
        for (uint64_t seed = 1; seed <= 20; ++seed) {
            const Scene scene = makeRandomScene(family, seed);
            validateScene(scene);
            const Camera camera = makeRandomSceneCamera(family, seed, 64, 36);
            validateCamera(camera);
            for (const Primitive& primitive : scene.primitives)
                EXPECT_EQ(primitive.material, "mirror");
            const Scene again = makeRandomScene(family, seed);
            const Scene other = makeRandomScene(family, seed + 100);
            ASSERT_EQ(again.primitives.size(), scene.primitives.size());
            EXPECT_EQ(again.primitives.back().center, scene.primitives.back().center);
            EXPECT_NE(other.primitives.back().radiance.colorA, scene.primitives.back().radiance.colorA);
            EXPECT_EQ(makeRandomSceneCamera(family, seed, 320, 180).worldFromView, camera.worldFromView);
        }
    }
}

TEST(SceneFamilies, CamerasSeeTheirScene)
{
    for (const SceneFamily family : allSceneFamilies()) {
        for (uint64_t seed = 1; seed <= 20; ++seed) {
            const Scene scene = makeRandomScene(family, seed);
            const CameraFrame frame(makeRandomSceneCamera(family, seed, 32, 18));
            int surfaces = 0;
            std::set<int> seen;
            for (int y = 0; y < 18; ++y) {
                for (int x = 0; x < 32; ++x) {
                    const auto hit = castPrimaryRay(scene, frame, frame.primaryRay({x + 0.5, y + 0.5}));
                    if (!hit) continue;
                    ++surfaces;
                    seen.insert(hit->primitive);
                }
            }
            EXPECT_GT(surfaces, 32 * 18 / 5) << nameOf(family) << " " << seed;
            EXPECT_GT(seen.size(), 2U) << nameOf(family) << " " << seed;
        }
    }
}
