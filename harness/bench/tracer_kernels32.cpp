#include "harness/bench/tracer_kernels.h"

#include <cstddef>

#define CROSSRAY_GLSL_PRECISION 32
#include "harness/backend/cpu/glsl.h"

#define CROSSRAY_BUILD_SURFACE_PYRAMID
#define CROSSRAY_REDUCE_DEPTH_PYRAMID
#include "crossray/project/hiz.glsl"
#include "crossray/project/patch_tracer.glsl"

template <class Cell>
struct CellLevel {
    ivec2 size;
    std::vector<Cell> cells;
    const Cell& at(ivec2 cell) const
    {
        return cells.at(static_cast<size_t>(cell.y) * static_cast<size_t>(size.x) + static_cast<size_t>(cell.x));
    }
};

thread_local TracerImage loaded;
thread_local View loadedView;
thread_local std::vector<CellLevel<vec4>> surfaces;
thread_local std::vector<CellLevel<vec2>> depths;
thread_local size_t finerLevel = 0;
thread_local int fetchCount = 0;

size_t pixelIndex(ivec2 pixel)
{
    return static_cast<size_t>(pixel.y) * static_cast<size_t>(loaded.width) + static_cast<size_t>(pixel.x);
}

vec4 fetchSurfaceCell(ivec2 cell, int level)
{
    ++fetchCount;
    return surfaces[static_cast<size_t>(level)].at(cell);
}
ivec2 surfacePyramidSize(int level)
{
    return surfaces[static_cast<size_t>(level)].size;
}
int surfacePyramidLevelCount()
{
    return static_cast<int>(surfaces.size());
}
void recordPatchStep(PatchStep) {}
float fetchDeviceDepth(ivec2 pixel)
{
    return loaded.deviceDepths.at(pixelIndex(pixel));
}
vec3 fetchNormalWS(ivec2 pixel)
{
    const float* normal = &loaded.normalsWS.at(3 * pixelIndex(pixel));
    return vec3(normal[0], normal[1], normal[2]);
}
vec4 fetchFinerSurface(ivec2 cell, int level)
{
    return surfaces[static_cast<size_t>(level)].at(cell);
}
ivec2 finerSurfaceSize(int level)
{
    return surfaces[static_cast<size_t>(level)].size;
}

vec2 fetchDepthPyramid(ivec2 cell, int level)
{
    ++fetchCount;
    return depths[static_cast<size_t>(level)].at(cell);
}
ivec2 depthPyramidSize(int level)
{
    return depths[static_cast<size_t>(level)].size;
}
int depthPyramidLevelCount()
{
    return static_cast<int>(depths.size());
}
void recordHizStep(HizStep) {}
vec2 fetchFinerDepth(ivec2 cell)
{
    return depths[finerLevel].at(cell);
}
ivec2 finerDepthSize()
{
    return depths[finerLevel].size;
}

// Whose image, and whose pyramids.
thread_local uint64_t loadedSerial = 0, surfaceSerial = 0, depthSerial = 0;

void loadImage(const TracerImage& image)
{
    if (image.serial != 0 && image.serial == loadedSerial) return;
    loadedSerial = image.serial;
    loaded = image;
    View view;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row)
            view.worldFromView[column][row] = image.worldFromView[static_cast<size_t>(column * 4 + row)];
    }
    const mat4& m = view.worldFromView;
    const mat3 rotation = mat3(vec3(m[0].xyz), vec3(m[1].xyz), vec3(m[2].xyz));
    const mat3 inverse = transpose(rotation);
    view.viewFromWorld = mat4(vec4(inverse[0], 0.0), vec4(inverse[1], 0.0), vec4(inverse[2], 0.0),
                              vec4(-(inverse * vec3(m[3].xyz)), 1.0));
    view.clipFromView = mat4(1.0); // no tracer asks for it
    view.imageSize = vec2(ivec2(image.width, image.height));
    view.slope = vec2(image.slopeX, image.slopeY);
    view.depthA = image.depthA;
    view.depthB = image.depthB;
    view.nearDistance = image.nearDistance;
    view.farDistance = image.farDistance;
    view.orthographic = image.orthographic;
    view.reversedDepth = image.reversedDepth;
    loadedView = view;
}

// Level 0 by `makeTexel(pixel)`, the others by `reduce(cell, finer level)`.
template <class Cell, class MakeTexel, class Reduce>
void buildLevels(std::vector<CellLevel<Cell>>& levels, MakeTexel makeTexel, Reduce reduce)
{
    const ivec2 size = ivec2(loaded.width, loaded.height);
    levels.clear();
    const int count = computeDepthPyramidLevelCount(size);
    for (int level = 0; level < count; ++level) {
        finerLevel = static_cast<size_t>(level > 0 ? level - 1 : 0);
        CellLevel<Cell> made{computeDepthPyramidSize(size, level), {}};
        for (int y = 0; y < made.size.y; ++y) {
            for (int x = 0; x < made.size.x; ++x) {
                const ivec2 cell = ivec2(x, y);
                made.cells.push_back(level == 0 ? makeTexel(cell) : reduce(cell, level - 1));
            }
        }
        levels.push_back(std::move(made));
    }
}

vec3 surfacePositionWS(ivec2 pixel)
{
    const float linearDepth = linearDepthFromDevice(loadedView, fetchDeviceDepth(pixel));
    return positionWSFromSS(loadedView, vec2(pixel) + 0.5, linearDepth);
}

vec3 rayOriginWS(const crossray::KernelRay& ray)
{
    if (ray.startsElsewhere) return vec3(ray.originWS[0], ray.originWS[1], ray.originWS[2]);
    return surfacePositionWS(ivec2(ray.x, ray.y));
}

vec3 rayDirWS(const crossray::KernelRay& ray)
{
    return vec3(ray.dirWS[0], ray.dirWS[1], ray.dirWS[2]);
}

#include "harness/backend/cpu/glsl_end.h"

namespace crossray {

using namespace cpu32;

bool isTracerImageLoaded(uint64_t serial)
{
    return serial != 0 && serial == loadedSerial;
}

void loadPatchTracer(const TracerImage& image, float depthError)
{
    loadImage(image);
    if (image.serial != 0 && image.serial == surfaceSerial) return;
    surfaceSerial = image.serial;
    buildLevels(
        surfaces, [&](ivec2 pixel) { return buildSurfacePixel(loadedView, pixel, depthError); },
        [](ivec2 cell, int finer) { return reduceSurfaceCell(cell, finer, ivec2(loaded.width, loaded.height)); });
}

void loadHizTracer(const TracerImage& image)
{
    loadImage(image);
    if (image.serial != 0 && image.serial == depthSerial) return;
    depthSerial = image.serial;
    buildLevels(
        depths, [](ivec2 pixel) { return makeDepthPyramidTexel(loadedView, fetchDeviceDepth(pixel)); },
        [](ivec2 cell, int) { return reduceDepthPyramidCell(cell); });
}

KernelAnswer tracePatchRay(const KernelRay& ray, int maxIterations, float caution, float depthError)
{
    const vec3 origin = rayOriginWS(ray);
    fetchCount = 0;
    const PatchTraceResult r =
        tracePatches(loadedView, origin, rayDirWS(ray), PatchTracerSettings(31, maxIterations, caution, depthError));
    return {r.hitClass == kHitClassHit,
            r.reason == kHitReasonIterationCap,
            r.positionSS.x,
            r.positionSS.y,
            r.linearDepth,
            r.confidence,
            fetchCount,
            r.iterations};
}

KernelAnswer traceHizRay(const KernelRay& ray, const HizKernelSettings& settings)
{
    const vec3 origin = rayOriginWS(ray);
    fetchCount = 0;
    const TraceResult r =
        traceHiz(loadedView, origin, rayDirWS(ray),
                 HizSettings(settings.minLevel, settings.maxLevel, settings.maxIterations, settings.depthBias));
    return {r.hitClass == kHitClassHit,
            r.reason == kHitReasonIterationCap,
            r.positionSS.x,
            r.positionSS.y,
            r.linearDepth,
            0.0,
            fetchCount,
            r.iterations};
}

} // namespace crossray
