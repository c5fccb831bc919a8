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
vec4 fetchFinerSurface(ivec2 cell, int level)
{
    const SurfaceLevel& finer = gSurfaces.at(static_cast<size_t>(level));
    return finer.cells.at(cellIndex(cell, finer.size));
}
ivec2 finerSurfaceSize(int level)
{
    return gSurfaces.at(static_cast<size_t>(level)).size;
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
        SurfaceLevel next{computeDepthPyramidSize(size, level), {}};
        for (int y = 0; y < next.size.y; ++y) {
            for (int x = 0; x < next.size.x; ++x)
                next.cells.push_back(reduceSurfaceCell(ivec2(x, y), level - 1, size));
        }
        gSurfaces.push_back(std::move(next));
    }
}

#include "tests/property/every_pixel_walk.glsl"
