// A person's own tracer among those of the yardstick: it runs on a device, and answers each ray by its pixel.
#pragma once

#include "harness/bench/bench_case.h"
#include "harness/bench/tracer_yardstick.h"

namespace crossray {

// What runs it. All must outlive the tracers made with it.
struct DeviceForTracers {
    std::string backend;
    WorkerPool& pool;
    ShaderCompiler& compiler;
    const Folders& folders;
    double thickness = 0; // handed on as depth_bias, metres
};

// `caseOf` makes the case whose G-buffer and mirror rays are those of a scene. Throws InputError where the backend runs
// no GLSL; the tracer's prepare() throws ShaderError when the file is wrong, EnvironmentError when the device fails.
TracerMethod makeDeviceTracer(const BenchMethod& method, std::function<Case(const YardstickScene&)> caseOf,
                              const DeviceForTracers& device);

// The case of a family's scene, all of whose surfaces are mirrors.
Case makeFamilyCase(SceneFamily family, const YardstickScene& scene);

} // namespace crossray
