// OpenGL 4.5 core compute as a Device, on a context that needs no window.
//
//   "osmesa"    OSMesa on llvmpipe
//   "softpipe"  OSMesa on Mesa's reference rasteriser; the process starts with GALLIUM_DRIVER=softpipe,
//               MESA_GL_VERSION_OVERRIDE=4.5 and MESA_GLSL_VERSION_OVERRIDE=450
//   "egl"       EGL without a surface, on the driver that EGL finds
//
// Mesa reads its environment when the first context is made, so the caller sets the variables before; and one process
// opens one of the three, since their libraries share global state. Several devices of the same name may live at once.
#pragma once

#include "harness/backend/device.h"

#include <memory>
#include <string>

namespace crossray {

// The libraries are loaded here, not when the program starts. Throws EnvironmentError when the library, a 4.5 core
// context, the driver that the name promises or (with options.validation) GL's debug output is not to be had.
//
// The device is used from the thread that made it. Beyond the contract of Device, run() throws ShaderError when a
// dispatch leaves a resource of its program unbound or exceeds a limit of the driver, and InputError when an image or a
// buffer of the job is malformed. A driver's compile log stands unchanged at the end of a ShaderError.
std::unique_ptr<Device> makeGlDevice(const std::string& backendName, const DeviceOptions& options);

} // namespace crossray
