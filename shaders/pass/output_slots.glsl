// The planes of a pass: only those that the variant asks for are stored, in the order of their ids.
// Hooks: storeOutputValue, and the block params.
#ifndef PASS_OUTPUT_SLOTS_GLSL
#define PASS_OUTPUT_SLOTS_GLSL

#include "crossray/shared/outputs.glsl"

bool wantsOutput(int id) { return (kOutputMask & (1 << id)) != 0; }

void storeOutput(int id, ivec2 pixel, vec4 value)
{
    if (kRecordPixel == 1) return; // records one pixel, stores no plane
    int slot = bitCount(kOutputMask & ((1 << id) - 1));
    ivec2 size = ivec2(int(params.imageSizeAndSlope.x), int(params.imageSizeAndSlope.y));
    storeOutputValue((slot * size.y + pixel.y) * size.x + pixel.x, value);
}

#endif
