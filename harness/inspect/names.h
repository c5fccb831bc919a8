// The shaders' numbers in words; crossray/shared/outputs.glsl.
#pragma once

#include <string>

namespace crossray {

// "iteration cap"; "none" for 0; "number 99" for what the shaders do not know.
std::string nameOfReason(int reason);
// "HiZ", "proxy, box"
std::string nameOfTracingModel(int model);
// "none", "cell", "depth"
std::string nameOfIntersection(int kind);

} // namespace crossray
