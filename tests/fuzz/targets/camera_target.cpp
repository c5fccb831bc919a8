// camera.json of a recorded data set: its camera, and the scene beside it. A camera that is taken gives finite rays.
#include "tests/fuzz/targets/target.h"

#include "harness/scene/gbuffer.h"

#include <cmath>

using namespace crossray;

namespace {

void checkCamera(const Camera& camera)
{
    const glm::dvec2 corner(camera.width, camera.height);
    for (const glm::dvec2& positionSS : {glm::dvec2(0.0), corner, 0.5 * corner}) {
        const Ray ray = computePrimaryRay(camera, positionSS);
        fuzz::expect(std::abs(glm::length(ray.dirWS) - 1.0) < 1e-6, "a ray's direction has length 1");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const fuzz::MemoryFile file(fuzz::textOf(data, size));
    const std::string name = file.path().string();
    if (const auto camera = fuzz::readOrRefuse([&] { return readCameraJson(file.path()); }, name)) checkCamera(*camera);
    fuzz::readOrRefuse([&] { return readSceneJson(file.path()); }, name);
    return 0;
}
