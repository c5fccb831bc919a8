// The view that a pass was given. Hooks: the block params.
#ifndef PASS_VIEW_OF_PARAMS_GLSL
#define PASS_VIEW_OF_PARAMS_GLSL

#include "crossray/core/view.glsl"

View loadView()
{
    return View(params.viewFromWorld, params.worldFromView, params.clipFromView, params.imageSizeAndSlope.xy,
                params.imageSizeAndSlope.zw, params.depthTerms.x, params.depthTerms.y, params.depthTerms.z,
                params.depthTerms.w, kOrthographic == 1, kReversedDepth == 1);
}

#endif
