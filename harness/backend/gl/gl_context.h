// Where a GL context comes from. Mesa 25.1 dropped OSMesa, and EGL without a surface is its heir: the device sees
// neither.
#pragma once

#include <memory>

namespace crossray {

class GlContext {
  public:
    using Procedure = void (*)();

    virtual ~GlContext() = default;
    // Makes the context the current one of this thread. Throws EnvironmentError.
    virtual void makeCurrent() = 0;
    // A GL function by name; null when the driver lacks it.
    virtual Procedure findProcedure(const char* name) const = 0;
};

// Both throw EnvironmentError with what to install or to set. `debug` asks for a debug context where the provider has
// such.
std::unique_ptr<GlContext> makeOsmesaContext();
std::unique_ptr<GlContext> makeEglContext(bool debug);

} // namespace crossray
