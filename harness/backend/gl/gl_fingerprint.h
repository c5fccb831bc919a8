// What a GL result depends on, read from the strings that the driver gives.
#pragma once

#include "harness/backend/device.h"

#include <string>
#include <string_view>

namespace crossray {

// `version` is GL_VERSION ("4.5 (Core Profile) Mesa 22.3.6"), `renderer` GL_RENDERER ("llvmpipe (LLVM 15.0.6, 256
// bits)"). The processor's field stays empty. A driver that is not Mesa is named by its whole version string.
Fingerprint parseGlFingerprint(const std::string& backend, std::string_view version, std::string_view renderer);

// Of the current context, with the processor.
Fingerprint readGlFingerprint(const std::string& backend);

} // namespace crossray
