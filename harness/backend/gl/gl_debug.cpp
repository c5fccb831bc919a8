#include "harness/backend/gl/gl_debug.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace crossray {
namespace {

const char* nameSource(GLenum source)
{
    switch (source) {
    case GL_DEBUG_SOURCE_API:
        return "API";
    case GL_DEBUG_SOURCE_SHADER_COMPILER:
        return "shader compiler";
    case GL_DEBUG_SOURCE_WINDOW_SYSTEM:
        return "window system";
    case GL_DEBUG_SOURCE_THIRD_PARTY:
        return "third party";
    case GL_DEBUG_SOURCE_APPLICATION:
        return "application";
    default:
        return "driver";
    }
}

const char* nameType(GLenum type)
{
    switch (type) {
    case GL_DEBUG_TYPE_ERROR:
        return "error";
    case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
        return "deprecated behaviour";
    case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
        return "undefined behaviour";
    case GL_DEBUG_TYPE_PORTABILITY:
        return "portability";
    case GL_DEBUG_TYPE_PERFORMANCE:
        return "performance";
    default:
        return "message";
    }
}

const char* nameSeverity(GLenum severity)
{
    switch (severity) {
    case GL_DEBUG_SEVERITY_HIGH:
        return "high";
    case GL_DEBUG_SEVERITY_MEDIUM:
        return "medium";
    default:
        return "low";
    }
}

} // namespace

GlDebugLog::GlDebugLog()
{
    // OSMesa cannot be asked for a debug context; Mesa reports in any context once the output is enabled.
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&GlDebugLog::receive, this);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glEnable(GL_INVALID_ENUM); // not a capability: the error that has to be reported
    while (glGetError() != GL_NO_ERROR) {
    }
    if (take().empty()) {
        glDebugMessageCallback(nullptr, nullptr);
        throw EnvironmentError("this OpenGL driver reports no debug messages: validation needs a working GL_KHR_debug");
    }
}

GlDebugLog::~GlDebugLog()
{
    glDebugMessageCallback(nullptr, nullptr);
}

std::vector<std::string> GlDebugLog::take()
{
    return std::exchange(messages_, {});
}

void GLAD_API_PTR GlDebugLog::receive(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length,
                                      const GLchar* text, const void* self)
{
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    // Warnings of the compiler come only when neither this process nor Mesa's cache on disk knows the shader: a verdict
    // would depend on what ran before. Its errors come back as the program's log.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
    std::string_view line = length < 0 ? std::string_view(text) : std::string_view(text, static_cast<size_t>(length));
    while (!line.empty() && (line.back() == '\n' || line.back() == '\0'))
        line.remove_suffix(1);
    // The pointer crossed C as const; it is the object that registered itself.
    auto* log = static_cast<GlDebugLog*>(const_cast<void*>(self));
    log->messages_.push_back(
        fmt::format("OpenGL {} {} ({}): {}", nameSource(source), nameType(type), nameSeverity(severity), line));
}

} // namespace crossray
