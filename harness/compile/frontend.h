// GLSL to SPIR-V 1.3 by glslang, with rooted includes.
#pragma once

#include "harness/compile/source.h"

#include <cstdint>
#include <vector>

namespace crossray {

struct FrontendResult {
    std::vector<uint32_t> spirv; // names kept, lines too when asked for; neither optimised nor validated
    SourceSet sources;           // the entry first
};

// `ownTracer` is the person's file behind the include kOwnTracerInclude; empty: there is none. `known`: files that are
// not read again, whatever the disk has. Throws ShaderError (the source is wrong) or InputError (it is missing, too
// large, of an unknown kind).
FrontendResult parseShader(const ShaderLocation& shader, const std::filesystem::path& includeRoot, bool lines,
                           const std::filesystem::path& ownTracer = {}, SourceSet known = {});

} // namespace crossray
