// Random rooms: the family of scenes that the yardstick for tracers is measured on. The same seed gives the same room
// on every machine: the generator is our own, and uses no function whose rounding a library may choose.
#pragma once

#include "harness/scene/camera.h"
#include "harness/scene/scene.h"

#include <cstdint>

namespace crossray {

// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014): a counter and a mixing
// function.
class RandomStream {
  public:
    explicit RandomStream(uint64_t seed) : state_(seed) {}
    uint64_t nextBits();
    double next(double low, double high); // uniform in [low, high), from the upper 53 bits
    bool chance(double probability) { return next(0.0, 1.0) < probability; }

  private:
    uint64_t state_;
};

// A room of mirrors, +Y up: the floor y = 0 and the walls z = -6 and x = -7, all cut at |x|, |z| <= 10 and y <= 6; 4
// boxes of which some float, 6 thin poles, 4 spheres of which some float. Every surface is a mirror with a checker of
// its own colours. Primitives stand in this order: floor, walls, boxes, poles, spheres.
Scene makeRandomRoom(uint64_t seed);

// A camera in the room of the same seed, at least 0.4 m from every object; 60 degrees vertically, reversed depth from
// 0.1 to 100 m. The image's size moves nothing.
Camera makeRandomRoomCamera(uint64_t seed, int width, int height);

} // namespace crossray
