// GL in memory through OSMesa. GL/osmesa.h brings GL/gl.h, which cannot stand beside glad's header: only this file sees
// it.
#include "harness/backend/gl/gl_context.h"

#include "harness/backend/gl/dynamic_library.h"
#include "harness/base/error.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdint>

namespace crossray {
namespace {

class OsmesaContext final : public GlContext {
  public:
    OsmesaContext()
        : library_({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, "libosmesa6"),
          create_(library_.find<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs")),
          destroy_(library_.find<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext")),
          makeCurrent_(library_.find<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent")),
          current_(library_.find<decltype(&OSMesaGetCurrentContext)>("OSMesaGetCurrentContext")),
          findProcedure_(library_.find<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress"))
    {
        // Without the profile and the version OSMesa makes a compatibility context, which ends at 3.1 and has no
        // compute.
        constexpr std::array<int, 13> kAttributes = {OSMESA_FORMAT,
                                                     OSMESA_RGBA,
                                                     OSMESA_DEPTH_BITS,
                                                     0,
                                                     OSMESA_PROFILE,
                                                     OSMESA_CORE_PROFILE,
                                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                                     4,
                                                     OSMESA_CONTEXT_MINOR_VERSION,
                                                     5,
                                                     0,
                                                     0,
                                                     0};
        context_ = create_(kAttributes.data(), nullptr);
        if (!context_)
            throw EnvironmentError("OSMesa gives no OpenGL 4.5 core context: it needs Mesa with llvmpipe, or "
                                   "GALLIUM_DRIVER=softpipe with MESA_GL_VERSION_OVERRIDE=4.5 and "
                                   "MESA_GLSL_VERSION_OVERRIDE=450");
    }
    ~OsmesaContext() override
    {
        if (current_() == context_) makeCurrent_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        destroy_(context_);
    }
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    void makeCurrent() override
    {
        if (current_() == context_) return;
        if (!makeCurrent_(context_, color_.data(), GL_UNSIGNED_BYTE, kSide, kSide))
            throw EnvironmentError("OSMesa cannot make its context current");
    }

    Procedure findProcedure(const char* name) const override { return findProcedure_(name); }

  private:
    static constexpr int kSide = 4; // a context is current with a colour buffer, which nothing here draws to

    DynamicLibrary library_;
    decltype(&OSMesaCreateContextAttribs) create_;
    decltype(&OSMesaDestroyContext) destroy_;
    decltype(&OSMesaMakeCurrent) makeCurrent_;
    decltype(&OSMesaGetCurrentContext) current_;
    decltype(&OSMesaGetProcAddress) findProcedure_;
    std::array<uint32_t, static_cast<size_t>(kSide) * kSide> color_{};
    OSMesaContext context_ = nullptr;
};

} // namespace

std::unique_ptr<GlContext> makeOsmesaContext()
{
    return std::make_unique<OsmesaContext>();
}

} // namespace crossray

#ifdef __SANITIZE_ADDRESS__
// OSMesa never frees the 480 bytes that it keeps of a context's colour buffer. The name is the leak checker's.
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libOSMesa.so\n";
}
#endif
