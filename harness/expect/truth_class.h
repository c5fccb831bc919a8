// The hit class that a tracer should answer, by what the screen could have known.
#pragma once

#include "harness/base/outputs.h"
#include "harness/scene/truth.h"

namespace crossray {

// Visible: hit; hidden or off screen: unknown; the sky: miss; no ray: no raycast.
inline HitClass classOf(ScreenKnowledge knowledge)
{
    switch (knowledge) {
    case ScreenKnowledge::kVisible:
        return HitClass::kHit;
    case ScreenKnowledge::kHidden:
    case ScreenKnowledge::kOffScreen:
        return HitClass::kUnknown;
    case ScreenKnowledge::kSky:
        return HitClass::kMiss;
    case ScreenKnowledge::kNoRay:
        break;
    }
    return HitClass::kNoRaycast;
}

} // namespace crossray
