// The scene that the tests of this folder make their jobs of, and how.
#pragma once

#include "harness/case/case.h"
#include "harness/pass/pass.h"

#include <filesystem>
#include <initializer_list>

namespace crossray {

// A mirror floor under a camera, with a wall behind it, at an odd size.
inline Case makeFloorCase(std::initializer_list<const char*> outputs)
{
    Case testCase;
    testCase.name = "test/floor";
    testCase.camera.width = 37;
    testCase.camera.height = 23;
    testCase.camera.worldFromView = makeLookAt({0, 2, 5}, {0, 0.5, -2}, {0, 1, 0});
    Primitive floor;
    floor.worldFromLocal = glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
    floor.material = "mirror";
    Primitive wall;
    wall.center = {0, 0, -6};
    testCase.scene.primitives = {floor, wall};
    for (const char* name : outputs)
        testCase.outputs.push_back(*findOutput(name));
    return testCase;
}

inline const std::filesystem::path kShaders = std::filesystem::path(CROSSRAY_SOURCE_DIR) / "shaders";

inline Job makeJob(const Case& testCase, Precision precision)
{
    ShaderCompiler compiler({});
    const CaseData data(testCase);
    return buildJob(data, compiler, kShaders, precision);
}

} // namespace crossray
