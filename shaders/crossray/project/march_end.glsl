// What a march over the screen that met no surface has found out.
// Hooks: none.
// Source: own: the three-valued end. What left the image or passed the near plane in sight is unknown by that reason;
// what was hidden by then may have hit something there, so that neither a miss nor the border is the reason.
#ifndef CROSSRAY_PROJECT_MARCH_END_GLSL
#define CROSSRAY_PROJECT_MARCH_END_GLSL

#include "crossray/core/math.glsl"
#include "crossray/shared/outputs.glsl"

// The reason to report of a march that ended without a hit for `reason` (kHitReason...): `inFront`: it was in front of
// all surfaces at its end; `wasHidden`: it was behind one on the way.
int computeMarchReason(int reason, bool inFront, bool wasHidden)
{
    bool leaves = reason == kHitReasonOffScreen || reason == kHitReasonNearPlane;
    bool endsHidden = leaves && !inFront;
    bool missesUnseen = reason == kHitReasonSky && (wasHidden || !inFront);
    bool isHidden = endsHidden || missesUnseen;
    return choose(isHidden, kHitReasonBehindSurface, reason);
}

// The class (kHitClass...) that goes with a reason.
int computeMarchClass(int reason)
{
    int hitClass = choose(reason == kHitReasonSky, kHitClassMiss, kHitClassUnknown);
    hitClass = choose(reason == kHitReasonDegenerateRay, kHitClassNoRaycast, hitClass);
    return choose(reason == kHitReasonNone, kHitClassHit, hitClass);
}

#endif
