// GL through EGL with no window system and no surface.
#include "harness/backend/gl/gl_context.h"

#include "harness/backend/gl/dynamic_library.h"
#include "harness/base/error.h"

#include <fmt/format.h>
#include <glad/egl.h>

#include <array>

namespace crossray {
namespace {

class EglContext final : public GlContext {
  public:
    explicit EglContext(bool debug)
        : library_({"libEGL.so.1", "libEGL.so"}, "libegl1"),
          getPlatformDisplay_(library_.find<PFNEGLGETPLATFORMDISPLAYPROC>("eglGetPlatformDisplay")),
          initialize_(library_.find<PFNEGLINITIALIZEPROC>("eglInitialize")),
          bindApi_(library_.find<PFNEGLBINDAPIPROC>("eglBindAPI")),
          create_(library_.find<PFNEGLCREATECONTEXTPROC>("eglCreateContext")),
          destroy_(library_.find<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")),
          makeCurrent_(library_.find<PFNEGLMAKECURRENTPROC>("eglMakeCurrent")),
          current_(library_.find<PFNEGLGETCURRENTCONTEXTPROC>("eglGetCurrentContext")),
          getError_(library_.find<PFNEGLGETERRORPROC>("eglGetError")),
          findProcedure_(library_.find<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress"))
    {
        display_ = getPlatformDisplay_(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display_ == EGL_NO_DISPLAY || !initialize_(display_, nullptr, nullptr))
            throw EnvironmentError(fmt::format("EGL has no surfaceless display (error 0x{:04x}): install the package "
                                               "libegl-mesa0",
                                               getError_()));
        bindApi_(EGL_OPENGL_API);
        const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                  4,
                                                  EGL_CONTEXT_MINOR_VERSION,
                                                  5,
                                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                  EGL_CONTEXT_OPENGL_DEBUG,
                                                  debug ? EGL_TRUE : EGL_FALSE,
                                                  EGL_NONE};
        context_ = create_(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT)
            throw EnvironmentError(
                fmt::format("EGL gives no OpenGL 4.5 core context without a surface (error 0x{:04x})", getError_()));
    }
    // The display stays initialised: EGL hands out the same one to every context of the process.
    ~EglContext() override
    {
        if (current_() == context_) makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        destroy_(display_, context_);
    }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void makeCurrent() override
    {
        if (current_() == context_) return;
        if (!makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw EnvironmentError(fmt::format("EGL cannot make its context current (error 0x{:04x})", getError_()));
    }

    Procedure findProcedure(const char* name) const override { return findProcedure_(name); }

  private:
    DynamicLibrary library_;
    PFNEGLGETPLATFORMDISPLAYPROC getPlatformDisplay_;
    PFNEGLINITIALIZEPROC initialize_;
    PFNEGLBINDAPIPROC bindApi_;
    PFNEGLCREATECONTEXTPROC create_;
    PFNEGLDESTROYCONTEXTPROC destroy_;
    PFNEGLMAKECURRENTPROC makeCurrent_;
    PFNEGLGETCURRENTCONTEXTPROC current_;
    PFNEGLGETERRORPROC getError_;
    PFNEGLGETPROCADDRESSPROC findProcedure_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<GlContext> makeEglContext(bool debug)
{
    return std::make_unique<EglContext>(debug);
}

} // namespace crossray
