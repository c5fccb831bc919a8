// The binding numbers of the passes, from the file that the shaders read.
#pragma once

namespace crossray {
#include "shaders/bindings/binding_numbers.glsl"
} // namespace crossray
