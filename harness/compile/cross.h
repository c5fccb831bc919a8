// SPIRV-Cross: SPIR-V as the text of another shading language.
#pragma once

#include "harness/compile/compile.h"

namespace crossray {

// kSpirv gives the disassembly. Bindings keep their numbers in every language. Throws ShaderError.
std::string crossCompile(const std::vector<uint32_t>& spirv, CompileTarget target, bool lineDirectives);

} // namespace crossray
