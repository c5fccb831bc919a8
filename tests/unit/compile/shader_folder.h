// A folder of shader sources that lives as long as one test.
#pragma once

#include "harness/base/temporary_folder.h"
#include "harness/compile/compile.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace crossray {

class ShaderFolder {
  public:
    std::filesystem::path write(const std::string& name, const std::string& text) const
    {
        const std::filesystem::path path = root() / "shaders" / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    std::filesystem::path cache() const { return root() / "cache"; }
    CompileOptions options() const
    {
        CompileOptions options;
        options.includeRoot = root() / "shaders";
        return options;
    }
    const std::filesystem::path& root() const { return folder_.path(); }

  private:
    TemporaryFolder folder_{"compile"};
};

// A small shader with every kind of resource and two variants.
inline constexpr const char* kVariantShader = R"(#version 450
layout(local_size_x = 8, local_size_y = 4) in;
layout(constant_id = 0) const int kMode = 0;
layout(constant_id = 1) const bool kFast = false;
layout(constant_id = 7) const float kScale = 2.0;
layout(binding = 2, std140) uniform Params { vec4 tint; ivec2 size; } params;
layout(binding = 5) uniform sampler2D sourceImage;
layout(binding = 3, std430) buffer Result { vec4 values[]; } result;

vec4 expensive(vec2 uv)
{
    vec4 sum = vec4(0.0);
    for (int i = 0; i < params.size.x; ++i) sum += textureLod(sourceImage, uv * float(i), 0.0) * sin(float(i));
    return sum;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    vec4 value = params.tint * kScale;
    if (kMode == 1) value += expensive(vec2(index));
    if (!kFast) value = sqrt(abs(value));
    result.values[index] = value;
}
)";

inline std::string errorOf(ShaderCompiler& compiler, const std::filesystem::path& shader, const CompileOptions& options)
{
    try {
        compiler.compile(shader, options);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "no error";
}

} // namespace crossray
