// Families of random scenes, so that no tracer is judged by rooms alone. As with the rooms, a seed gives the same scene
// on every machine, and every surface is a mirror.
#pragma once

#include "harness/scene/random_scene.h"

#include <optional>
#include <span>
#include <string_view>

namespace crossray {

enum class SceneFamily {
    kRandomRoom, // floor, two walls, boxes, thin poles and spheres
    kForest,     // 60 thin poles on a floor: most rays pass behind something
    kStaircase,  // steps up to a wall, with a parapet at one side and a few spheres on the steps
    kTerrain,    // a field of box columns of different heights
    kCurvedHall, // a vault (a sphere seen from inside) over a floor, with balls and domes: no straight wall
    kPanels,     // thin panels at all angles in a room
};
std::span<const SceneFamily> allSceneFamilies();
std::string_view nameOf(SceneFamily family); // as cases and the command line name it: "random_room", ...
std::optional<SceneFamily> findSceneFamily(std::string_view name);

Scene makeRandomScene(SceneFamily family, uint64_t seed);

// A camera of the same seed, at least 0.4 m from every object; 60 degrees vertically, reversed depth from 0.1 to 100 m.
Camera makeRandomSceneCamera(SceneFamily family, uint64_t seed, int width, int height);

} // namespace crossray
