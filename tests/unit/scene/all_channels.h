// All that a G-buffer can have.
#pragma once

#include "harness/scene/gbuffer.h"

#include <array>

namespace crossray {

inline constexpr std::array<GBufferChannel, 6> kAllChannels = {
    GBufferChannel::kDeviceDepth, GBufferChannel::kLinearDepth, GBufferChannel::kNormalWS,
    GBufferChannel::kPositionWS,  GBufferChannel::kColor,       GBufferChannel::kObjectIndex};

} // namespace crossray
