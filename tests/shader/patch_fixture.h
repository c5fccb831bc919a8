// A surface pyramid in memory behind the hooks of project/patch_tracer.glsl, and the walk over every pixel that the
// tracer is held against. For use between glsl.h and glsl_end.h after patch_tracer.glsl and views.h.

struct SurfaceLevel {
    ivec2 size;
    std::vector<vec4> cells;
};
struct DepthImage {
    ivec2 size;
    std::vector<Real> deviceDepths;
    std::vector<vec3> normalsWS;
};

static DepthImage gImage;
static std::vector<SurfaceLevel> gSurfaces;
static size_t gFinerSurface = 0;
static int gSurfaceReads = 0;
static int gBadSurfaceReads = 0; // outside a level
static std::vector<PatchStep> gPatchSteps;

inline size_t cellIndex(ivec2 cell, ivec2 size)
{
    return static_cast<size_t>(cell.y) * static_cast<size_t>(size.x) + static_cast<size_t>(cell.x);
}
vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    ++gSurfaceReads;
    const SurfaceLevel& l = gSurfaces.at(static_cast<size_t>(level));
    if (cell.x < 0 || cell.y < 0 || cell.x >= l.size.x || cell.y >= l.size.y) {
        ++gBadSurfaceReads;
        return vec4(0, 0, 0, -1);
    }
    return l.cells[cellIndex(cell, l.size)];
}
ivec2 surfacePyramidSize(int level)
{
    return gSurfaces.at(static_cast<size_t>(level)).size;
}
int surfacePyramidLevelCount()
{
    return static_cast<int>(gSurfaces.size());
}
void recordPatchStep(PatchStep step)
{
    gPatchSteps.push_back(step);
}
float fetchDeviceDepth(ivec2 pixel)
{
    return gImage.deviceDepths.at(cellIndex(pixel, gImage.size));
}
vec3 fetchNormalWS(ivec2 pixel)
{
    return gImage.normalsWS.at(cellIndex(pixel, gImage.size));
}
vec4 fetchFinerSurface(ivec2 cell)
{
    return gSurfaces[gFinerSurface].cells.at(cellIndex(cell, gSurfaces[gFinerSurface].size));
}
ivec2 finerSurfaceSize()
{
    return gSurfaces[gFinerSurface].size;
}

inline void buildSurfacePyramid(const View& view, Real depthError = 0)
{
    gBadSurfaceReads = 0;
    const ivec2 size = gImage.size;
    gSurfaces = {SurfaceLevel{size, {}}};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            gSurfaces[0].cells.push_back(buildSurfacePixel(view, ivec2(x, y), depthError));
    }
    const int levels = computeDepthPyramidLevelCount(size);
    for (int level = 1; level < levels; ++level) {
        gFinerSurface = static_cast<size_t>(level - 1);
        SurfaceLevel next{computeDepthPyramidSize(size, level), {}};
        for (int y = 0; y < next.size.y; ++y) {
            for (int x = 0; x < next.size.x; ++x)
                next.cells.push_back(reduceSurfaceCell(ivec2(x, y), level - 1, size));
        }
        gSurfaces.push_back(std::move(next));
    }
}

// Every pixel in turn, by the simplest loop there is: over the nearer border of the pixel, in x first where both are
// as near. Shares with the tracer what one pixel decides, and nothing of how it moves.
inline PatchTraceResult traceEveryPixel(const View& view, vec3 originWS, vec3 dirWS, PatchTracerSettings settings)
{
    const ScreenRay ray = makeScreenRay(view, originWS, dirWS);
    const PatchTraceResult none = PatchTraceResult(0, 0, vec2(0.0), 0.0, 0, 0, 0, 0.0);
    if (ray.status != kHitReasonNone) return makePatchEnd(view, ray, 0, ray.status, none);
    if (!isOnScreen(view, ray.startSS)) return makePatchEnd(view, ray, 0, kHitReasonOffScreen, none);
    const ivec2 size(view.imageSize);
    const ivec2 start = min(ivec2(floor(ray.startSS)), size - ivec2(1));
    const PatchWalk walk = makePatchWalk(ray, start, settings.depthError);
    PatchState state = PatchState(start, 0, true, HiddenStart(start, 0), kNoClearance);
    const int stepX = ray.deltaSS.x > 0 ? 1 : -1;
    const int stepY = ray.deltaSS.y > 0 ? 1 : -1;
    for (;;) {
        const Real toX = ray.deltaSS.x == 0
                             ? kNever
                             : (static_cast<Real>(state.pixel.x + (stepX > 0)) - ray.startSS.x) / ray.deltaSS.x;
        const Real toY = ray.deltaSS.y == 0
                             ? kNever
                             : (static_cast<Real>(state.pixel.y + (stepY > 0)) - ray.startSS.y) / ray.deltaSS.y;
        const PatchCell cell = enterPatchCell(view, walk, state);
        const PixelTest test = testPixel(view, walk, cell, state, settings.caution);
        if (test.isHit) return makePatchHit(view, walk, cell, test, none);
        if (test.isRefused) return makePatchEnd(view, ray, cell.enter, kHitReasonBehindSurface, none);
        state = PatchState(state.pixel, 0, test.inFront, test.hidden, test.clearance);
        const bool ends = !(std::min(toX, toY) < 1);
        if (toX <= toY)
            state.pixel.x += stepX;
        else
            state.pixel.y += stepY;
        const bool leaves =
            state.pixel.x < 0 || state.pixel.y < 0 || state.pixel.x >= size.x || state.pixel.y >= size.y;
        if (!ends && !leaves) continue;
        const int reason = ends ? ray.endReason : kHitReasonOffScreen;
        return makePatchEnd(view, ray, cell.leave, test.inFront ? reason : kHitReasonBehindSurface, none);
    }
}
