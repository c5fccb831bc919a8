// The shader library and the harness's passes as C++: cpu32 computes in float, cpu64 in double.
#pragma once

#include "harness/backend/device.h"

#include <memory>

namespace crossray {

// Runs on the calling thread. A program is looked up by its entry's name; an unknown one is a ShaderError.
std::unique_ptr<Device> makeCpuDevice(Precision precision);

} // namespace crossray
