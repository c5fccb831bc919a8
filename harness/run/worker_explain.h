// A driver's complaint about generated GLSL, told in lines of the source that a person wrote.
#pragma once

#include "harness/compile/compile.h"
#include "harness/run/worker_pool.h"

#include <filesystem>

namespace crossray {

// WorkerPool::run; where a GL driver refuses a program, its source is compiled again with lines, given to the driver
// once more, and the message of that is mapped to "file:line". The first message is kept where that finds nothing.
JobReport runExplained(WorkerPool& pool, ShaderCompiler& compiler, const std::filesystem::path& shaderRoot,
                       const std::string& backend, int core, const Job& job, std::chrono::duration<double> timeout);

} // namespace crossray
