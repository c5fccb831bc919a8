// How a case becomes a job: which passes run, with which shader variant, parameters, images and buffers; and how the
// bytes that come back become named planes. The only place that knows binding numbers and parameter layouts, beside
// shaders/bindings/.
#pragma once

#include "harness/backend/device.h"
#include "harness/base/plane.h"
#include "harness/compile/compile.h"
#include "harness/expect/expect.h"

#include <filesystem>
#include <vector>

namespace crossray {

// Compiles what the case needs (through the compiler's cache) and fills the job. Throws ShaderError.
Job buildJob(const CaseData& data, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
             Precision precision);

// One plane an output of the case, in the order of Case::outputs.
std::vector<Plane> readPlanes(const Case& testCase, const JobResult& result);

} // namespace crossray
