// What processor this is: part of every fingerprint, because expected data of software rasterisers depend on it.
#pragma once

#include <string>
#include <string_view>

namespace crossray {

// "AuthenticAMD AMD EPYC 7B13" from the text of /proc/cpuinfo: the first processor's vendor and model name, white space
// collapsed. Falls back on the fields that ARM kernels write ("ARM implementer 0x41 part 0xd0c"), and on "unknown".
std::string parseCpuInfo(std::string_view text);

// The same of this machine.
std::string readCpuInfo();

} // namespace crossray
