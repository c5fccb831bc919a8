// The walk that the tracer over planes is held against: every pixel in turn, by the simplest loop there is, over the
// nearer border of the pixel, in x first where both are as near. It shares with the tracer what one pixel decides, and
// nothing of how it moves. C++ and GLSL; included after project/patch_tracer.glsl.
// Hooks: those of project/patch_tracer.glsl.
#ifndef TESTS_PROPERTY_EVERY_PIXEL_WALK_GLSL
#define TESTS_PROPERTY_EVERY_PIXEL_WALK_GLSL

PatchTraceResult traceEveryPixel(View view, vec3 originWS, vec3 dirWS, PatchTracerSettings settings)
{
    ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    PatchTraceResult counts = PatchTraceResult(0, 0, vec2(0.0), 0.0, 0, 0, 0, 0.0);
    if (ray.status != kHitReasonNone) return makePatchEnd(view, ray, 0.0, ray.status, counts);
    if (!isOnScreen(view, ray.startSS)) return makePatchEnd(view, ray, 0.0, kHitReasonOffScreen, counts);
    ivec2 size = ivec2(view.imageSize);
    ivec2 start = min(ivec2(floor(ray.startSS)), size - ivec2(1));
    float caution = settings.caution > 0.0 ? settings.caution : 0.0;
    PatchWalk walk = makePatchWalk(ray, start, settings.depthError > 0.0 ? settings.depthError : 0.0);
    PatchState state = PatchState(start, 0, true, HiddenStart(start, 0.0), kNoClearance);
    bool toRight = ray.deltaSS.x > 0.0;
    bool toBelow = ray.deltaSS.y > 0.0;
    // No way is longer than the image is wide and high.
    for (int i = 0; i < size.x + size.y; ++i) {
        float toX = (float(toRight ? state.pixel.x + 1 : state.pixel.x) - ray.startSS.x) / ray.deltaSS.x;
        float toY = (float(toBelow ? state.pixel.y + 1 : state.pixel.y) - ray.startSS.y) / ray.deltaSS.y;
        PatchCell cell = enterPatchCell(view, walk, state);
        counts.iterations = i + 1;
        PixelTest test = testPixel(view, walk, cell, state, caution);
        if (test.isHit) return makePatchHit(view, walk, cell, test, counts);
        if (test.isRefused) return makePatchEnd(view, ray, cell.enter, kHitReasonBehindSurface, counts);
        ivec2 overX = state.pixel + ivec2(toRight ? 1 : -1, 0);
        ivec2 overY = state.pixel + ivec2(0, toBelow ? 1 : -1);
        ivec2 next = toX <= toY ? overX : overY;
        bool goesOn = min(toX, toY) < 1.0;
        bool leaves = next.x < 0 || next.y < 0 || next.x >= size.x || next.y >= size.y;
        if (!goesOn || leaves) {
            int reason = goesOn ? kHitReasonOffScreen : ray.endReason;
            return makePatchEnd(view, ray, cell.leave, test.inFront ? reason : kHitReasonBehindSurface, counts);
        }
        state = PatchState(next, 0, test.inFront, test.hidden, test.clearance);
    }
    return makePatchEnd(view, ray, 0.0, kHitReasonIterationCap, counts);
}

#endif
