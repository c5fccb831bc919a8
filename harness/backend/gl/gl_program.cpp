#include "harness/backend/gl/gl_program.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>

namespace crossray {
namespace {

std::string trim(std::string text)
{
    while (!text.empty() && (std::isspace(static_cast<unsigned char>(text.back())) || text.back() == '\0'))
        text.pop_back();
    return text;
}

std::string readShaderLog(GLuint shader)
{
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    return trim(log);
}

std::string readProgramLog(GLuint program)
{
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    return trim(log);
}

// The driver refuses such a shader too, but names no numbers.
void checkLocalSize(const ProgramSource& source, const GlLimits& limits)
{
    const auto size = parseLocalSize(source.glsl);
    const auto& most = limits.groupSize;
    const int64_t invocations = size[0] * size[1] * size[2];
    if (size[0] <= most[0] && size[1] <= most[1] && size[2] <= most[2] && invocations <= limits.groupInvocations)
        return;
    throw ShaderError(fmt::format(
        "{}: a work group of {}x{}x{} = {} invocations; this driver allows {}x{}x{} and {} in all", source.entry,
        size[0], size[1], size[2], invocations, most[0], most[1], most[2], limits.groupInvocations));
}

std::string readResourceName(GLuint program, GLenum interface, GLuint index)
{
    const GLenum property = GL_NAME_LENGTH;
    GLint length = 0;
    glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &length);
    std::string name(static_cast<size_t>(length), '\0');
    glGetProgramResourceName(program, interface, index, length, nullptr, name.data());
    return trim(name);
}

GLuint countResources(GLuint program, GLenum interface)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return static_cast<GLuint>(count);
}

void readBlocks(GLuint program, GlResourceKind kind, std::vector<GlResource>& resources)
{
    const GLenum interface = kind == GlResourceKind::kStorageBlock ? GL_SHADER_STORAGE_BLOCK : GL_UNIFORM_BLOCK;
    const GLuint count = countResources(program, interface);
    for (GLuint index = 0; index < count; ++index) {
        constexpr std::array<GLenum, 2> kProperties = {GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
        std::array<GLint, 2> values{};
        glGetProgramResourceiv(program, interface, index, 2, kProperties.data(), 2, nullptr, values.data());
        resources.push_back(
            {kind, static_cast<uint32_t>(values[0]), values[1], readResourceName(program, interface, index)});
    }
}

// Uniforms outside of blocks: samplers, and nothing else. A push constant that became a plain uniform would silently
// read 0.
void readSamplers(GLuint program, const std::string& entry, std::vector<GlResource>& resources)
{
    const GLuint count = countResources(program, GL_UNIFORM);
    for (GLuint index = 0; index < count; ++index) {
        constexpr std::array<GLenum, 4> kProperties = {GL_BLOCK_INDEX, GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE};
        std::array<GLint, 4> values{};
        glGetProgramResourceiv(program, GL_UNIFORM, index, 4, kProperties.data(), 4, nullptr, values.data());
        if (values[0] != -1) continue;
        const std::string name = readResourceName(program, GL_UNIFORM, index);
        if (values[1] != GL_SAMPLER_2D || values[3] != 1)
            throw ShaderError(fmt::format("{}: the uniform {} stands outside of a block and is no single sampler2D; "
                                          "numbers go into uniform blocks, images are sampler2D",
                                          entry, name));
        GLint unit = 0;
        glGetUniformiv(program, values[2], &unit);
        resources.push_back({GlResourceKind::kSampler, static_cast<uint32_t>(unit), 0, name});
    }
}

} // namespace

const char* nameGlResourceKind(GlResourceKind kind)
{
    switch (kind) {
    case GlResourceKind::kStorageBlock:
        return "storage block";
    case GlResourceKind::kUniformBlock:
        return "uniform block";
    case GlResourceKind::kSampler:
        return "sampler";
    }
    return "";
}

std::array<int64_t, 3> parseLocalSize(std::string_view glsl)
{
    constexpr std::string_view kWord = "local_size_";
    std::array<int64_t, 3> size{1, 1, 1};
    for (size_t at = glsl.find(kWord); at != std::string_view::npos; at = glsl.find(kWord, at + 1)) {
        const auto axis = at + kWord.size();
        if (axis >= glsl.size() || glsl[axis] < 'x' || glsl[axis] > 'z') continue;
        size_t digit = glsl.find_first_not_of(" \t", axis + 1);
        if (digit == std::string_view::npos || glsl[digit] != '=') continue;
        digit = glsl.find_first_not_of(" \t", digit + 1);
        if (digit == std::string_view::npos) continue;
        int64_t value = 0;
        const auto parsed = std::from_chars(glsl.data() + digit, glsl.data() + glsl.size(), value);
        if (parsed.ec == std::errc{}) size[static_cast<size_t>(glsl[axis] - 'x')] = value;
    }
    return size;
}

GlProgram compileGlProgram(const ProgramSource& source, const GlLimits& limits)
{
    if (source.glsl.empty()) throw ShaderError(source.entry + ": the program has no GLSL text, which OpenGL needs");
    checkLocalSize(source, limits);

    const GlShaderName shader(glCreateShader(GL_COMPUTE_SHADER));
    const char* text = source.glsl.data();
    const auto length = static_cast<GLint>(source.glsl.size());
    glShaderSource(shader.id(), 1, &text, &length);
    glCompileShader(shader.id());
    GLint done = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
    if (!done)
        throw ShaderError(
            fmt::format("{}: the OpenGL driver refuses to compile it:\n{}", source.entry, readShaderLog(shader.id())));

    GlProgram program;
    program.name = GlProgramName(glCreateProgram());
    const GLuint id = program.name.id();
    glAttachShader(id, shader.id());
    glLinkProgram(id);
    glDetachShader(id, shader.id());
    glGetProgramiv(id, GL_LINK_STATUS, &done);
    if (!done)
        throw ShaderError(
            fmt::format("{}: the OpenGL driver refuses to link it:\n{}", source.entry, readProgramLog(id)));

    readBlocks(id, GlResourceKind::kStorageBlock, program.resources);
    readBlocks(id, GlResourceKind::kUniformBlock, program.resources);
    readSamplers(id, source.entry, program.resources);
    return program;
}

} // namespace crossray
