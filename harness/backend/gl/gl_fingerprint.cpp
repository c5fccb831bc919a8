#include "harness/backend/gl/gl_fingerprint.h"

#include "harness/base/cpu_info.h"

#include <fmt/format.h>
#include <glad/gl.h>

namespace crossray {
namespace {

// The word after `mark`, up to a blank, a comma or a bracket; empty when the mark is not there.
std::string findWordAfter(std::string_view text, std::string_view mark)
{
    const size_t at = text.find(mark);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + mark.size());
    return std::string(text.substr(0, text.find_first_of(" ,)")));
}

std::string_view readString(GLenum name)
{
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

} // namespace

Fingerprint parseGlFingerprint(const std::string& backend, std::string_view version, std::string_view renderer)
{
    Fingerprint print;
    print.backend = backend;
    print.api = fmt::format("OpenGL {} core", version.substr(0, version.find(' ')));
    print.device = std::string(renderer);
    const std::string mesa = findWordAfter(version, "Mesa ");
    print.driver = mesa.empty() ? std::string(version) : "Mesa " + mesa;
    print.llvm = findWordAfter(renderer, "LLVM ");
    return print;
}

Fingerprint readGlFingerprint(const std::string& backend)
{
    Fingerprint print = parseGlFingerprint(backend, readString(GL_VERSION), readString(GL_RENDERER));
    print.cpu = readCpuInfo();
    return print;
}

} // namespace crossray
