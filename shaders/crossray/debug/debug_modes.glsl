// What a debug mode looks like on a display. Raw values are what is stored and compared; these are for people.
// Hooks: none. Source: the encodings of Unity HDRP's screen-space debug modes (2018 documentation).
//
// All results are in [0,1] for finite input within its range; NaN and infinity show as kDebugNotANumber.
#ifndef CROSSRAY_DEBUG_DEBUG_MODES_GLSL
#define CROSSRAY_DEBUG_DEBUG_MODES_GLSL

#include "crossray/core/math.glsl"
#include "crossray/shared/outputs.glsl"

const vec3 kDebugNotANumber = vec3(1.0, 0.0, 1.0);
const vec3 kDebugHit = vec3(0.5, 1.0, 0.5);
const vec3 kDebugFailed = vec3(0.5, 0.5, 1.0);
const vec3 kDebugNoRaycast = vec3(0.0, 0.0, 0.0);

// Unit vector to colour: 0.5 grey is no component.
vec3 encodeDirection(vec3 dirWS)
{
    return isFinite(dirWS) ? saturate(dirWS * 0.5 + vec3(0.5)) : kDebugNotANumber;
}

// Grey that repeats every 10 m.
vec3 encodeLinearDepth(float linearDepth)
{
    return isFinite(linearDepth) ? vec3(fract(linearDepth * 0.1)) : kDebugNotANumber;
}

// Hit green, miss and unknown blue, no raycast black.
vec3 encodeHitClass(int hitClass)
{
    if (hitClass == kHitClassHit) return kDebugHit;
    return hitClass == kHitClassMiss || hitClass == kHitClassUnknown ? kDebugFailed : kDebugNoRaycast;
}

// Small numbers as colours that are told apart at a glance; 0 is black, and numbers above 7 begin again at 1.
vec3 encodeIndex(int index)
{
    int bits = index <= 0 ? 0 : (index - 1) % 7 + 1;
    return vec3(float(bits % 2), float(bits / 2 % 2), float(bits / 4 % 2));
}

vec3 encodePositionNDC(vec3 positionNDC)
{
    return isFinite(positionNDC.xy) ? vec3(saturate(positionNDC.xy), 0.0) : kDebugNotANumber;
}

// xy of the direction around grey, and z as fract(0.1/z); z = 0 shows as 0.
vec3 encodeRayDirNDC(vec3 rayDirNDC)
{
    vec2 direction = saturate(rayDirNDC.xy * 0.5 + vec2(0.5));
    return isFinite(rayDirNDC) ? vec3(direction, fract(safeDivide(0.1, rayDirNDC.z, 0.0))) : kDebugNotANumber;
}

// Counts by their maximum; a maximum of 0 and less shows 0.
vec3 encodeCount(int count, int maximum)
{
    return vec3(saturate(safeDivide(float(count), float(maximum > 0 ? maximum : 0), 0.0)));
}

// As it is.
vec3 encodeColor(vec3 color)
{
    return isFinite(color) ? color : kDebugNotANumber;
}

vec3 encodeWeight(float weight)
{
    return isFinite(weight) ? vec3(weight) : kDebugNotANumber;
}

#endif
