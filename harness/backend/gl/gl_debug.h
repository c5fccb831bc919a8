// GL's own complaints, collected while they happen.
#pragma once

#include <glad/gl.h>

#include <string>
#include <vector>

namespace crossray {

// From its making on, messages of the current context gather here: those above the severity "notification", without the
// shader compiler's. One a context; the context outlives it and is current when it dies.
class GlDebugLog {
  public:
    // Throws EnvironmentError when a deliberate error of the API goes unreported.
    GlDebugLog();
    ~GlDebugLog();
    GlDebugLog(const GlDebugLog&) = delete;
    GlDebugLog& operator=(const GlDebugLog&) = delete;

    // The messages since the last call, oldest first.
    std::vector<std::string> take();

  private:
    static void GLAD_API_PTR receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                     const GLchar* text, const void* self);

    std::vector<std::string> messages_;
};

} // namespace crossray
