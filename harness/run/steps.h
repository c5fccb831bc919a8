// The steps of a run on real devices: cases through the shader compiler to the workers.
#pragma once

#include "harness/run/execute.h"

#include <filesystem>
#include <span>

namespace crossray {

// The pool and the compiler must outlive the steps.
ExecuteSteps makeSteps(WorkerPool& pool, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                       std::span<const std::string> backends);

} // namespace crossray
