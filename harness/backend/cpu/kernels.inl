// The harness's passes as C++, for one precision: the C++ form of shaders/bindings/, then the passes themselves, then the table
// that the CPU device looks them up in. Included by kernels32.cpp and kernels64.cpp after CROSSRAY_GLSL_PRECISION is defined.

#include "harness/backend/cpu/kernels.h"

#include <cstring>

#include "harness/backend/cpu/glsl.h"

#include "crossray/shared/pass_params.glsl"
#include "crossray/shared/probe_params.glsl"
#include "crossray/shared/planar_params.glsl"

using Real = decltype(vec2::x);

thread_local CpuBindings<Real> bound;
thread_local PassParams params;
thread_local PyramidParams pyramidParams;
thread_local ProbeParams probeParams;
thread_local SurfaceParams surfaceParams;
thread_local PlanarParams planarParams;
thread_local int fetchCount = 0;

#define CROSSRAY_VARIANT(id, name, value) thread_local int name = value;
#include "bindings/variants.glsl"
#undef CROSSRAY_VARIANT

#include "bindings/binding_numbers.glsl"

// Texels outside the image are what robust image access gives on a GPU: zero.
const Real* texelOf(uint32_t binding, ivec2 pixel)
{
    static constexpr Real kZero[4] = {};
    const CpuResource<Real>& image = bound.resources[binding];
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= image.width || pixel.y >= image.height) return kZero;
    return image.values + (static_cast<size_t>(pixel.y) * static_cast<size_t>(image.width) + static_cast<size_t>(pixel.x)) *
                              static_cast<size_t>(image.channels);
}

vec3 texelRgb(uint32_t binding, ivec2 pixel)
{
    const Real* texel = texelOf(binding, pixel);
    return vec3(texel[0], texel[1], texel[2]);
}

float fetchDeviceDepth(ivec2 pixel) { return texelOf(kDepthBinding, pixel)[0]; }
vec3 fetchNormalWS(ivec2 pixel) { return texelRgb(kNormalBinding, pixel); }
vec3 fetchColor(ivec2 pixel) { return texelRgb(kColorBinding, pixel); }
vec3 fetchProbeAtlas(ivec2 texel) { return texelRgb(kProbeAtlasBinding, texel); }
vec3 fetchPlanarAtlas(ivec2 texel) { return texelRgb(kPlanarAtlasBinding, texel); }
bool fetchTraced(ivec2 pixel) { return texelOf(kMaskBinding, pixel)[0] > 0.5; }

vec2 fetchMotionUV(ivec2 pixel)
{
    const Real* texel = texelOf(kMotionBinding, pixel);
    return vec2(texel[0], texel[1]);
}
float fetchThickness(ivec2 pixel) { return texelOf(kThicknessBinding, pixel)[0]; }
vec3 fetchHistoryColor(ivec2 pixel) { return texelRgb(kHistoryColorBinding, pixel); }

vec4 loadColorCell(int index)
{
    const CpuResource<Real>& cells = bound.resources[kColorPyramidBinding];
    const auto first = static_cast<size_t>(index) * 4;
    if (index < 0 || first + 4 > cells.scalarCount) return vec4(0.0, 0.0, 0.0, 0.0);
    return vec4(cells.values[first], cells.values[first + 1], cells.values[first + 2], cells.values[first + 3]);
}

void storeColorCell(int index, vec4 value)
{
    const CpuResource<Real>& cells = bound.resources[kColorPyramidBinding];
    const auto first = static_cast<size_t>(index) * 4;
    if (index < 0 || first + 4 > cells.scalarCount) return;
    const Real components[4] = {value.x, value.y, value.z, value.w};
    std::memcpy(cells.values + first, components, sizeof(components));
}

vec2 loadPyramidCell(int index)
{
    const CpuResource<Real>& cells = bound.resources[kPyramidBinding];
    const auto first = static_cast<size_t>(index) * 2;
    if (index < 0 || first + 2 > cells.scalarCount) return vec2(0.0, 0.0);
    return vec2(cells.values[first], cells.values[first + 1]);
}

void storePyramidCell(int index, vec2 value)
{
    const CpuResource<Real>& cells = bound.resources[kPyramidBinding];
    const auto first = static_cast<size_t>(index) * 2;
    if (index < 0 || first + 2 > cells.scalarCount) return;
    cells.values[first] = value.x;
    cells.values[first + 1] = value.y;
}

void storeVector(uint32_t binding, int index, vec4 value)
{
    const CpuResource<Real>& values = bound.resources[binding];
    const auto first = static_cast<size_t>(index) * 4;
    if (index < 0 || first + 4 > values.scalarCount) return;
    const Real components[4] = {value.x, value.y, value.z, value.w};
    std::memcpy(values.values + first, components, sizeof(components));
}

void storeOutputValue(int index, vec4 value) { storeVector(kOutputBinding, index, value); }
void storeRecordValue(int index, vec4 value) { storeVector(kRecordBinding, index, value); }

vec4 loadSurfaceCell(int index)
{
    const CpuResource<Real>& cells = bound.resources[kSurfaceBinding];
    const auto first = static_cast<size_t>(index) * 4;
    if (index < 0 || first + 4 > cells.scalarCount) return vec4(0.0, 0.0, 0.0, 0.0);
    return vec4(cells.values[first], cells.values[first + 1], cells.values[first + 2], cells.values[first + 3]);
}

void storeSurfaceCell(int index, vec4 value) { storeVector(kSurfaceBinding, index, value); }

#include "pass/depth_pyramid.glsl"
#include "pass/surface_pyramid.glsl"
#include "pass/color_pyramid.glsl"
#include "pass/screen_trace.glsl"

template <class Params>
void readUniform(Params& target, uint32_t binding)
{
    const std::span<const std::byte> bytes = bound.uniforms[binding];
    if (bytes.size() == sizeof(Params)) std::memcpy(static_cast<void*>(&target), bytes.data(), sizeof(Params));
}

constexpr CpuKernel<Real> kKernels[] = {
    {"entry/depth_pyramid.comp", 8, 8,
     [](const CpuBindings<Real>& bindings) {
         bound = bindings;
         readUniform(pyramidParams, kParamsBinding);
     },
     [](int x, int y) { buildPyramidCell(ivec2(x, y)); }},
    {"entry/surface_pyramid.comp", 8, 8,
     [](const CpuBindings<Real>& bindings) {
         bound = bindings;
         readUniform(surfaceParams, kParamsBinding);
     },
     [](int x, int y) { buildSurfaceCells(ivec2(x, y)); }},
    {"entry/color_pyramid.comp", 8, 8,
     [](const CpuBindings<Real>& bindings) {
         bound = bindings;
         readUniform(pyramidParams, kParamsBinding);
     },
     [](int x, int y) { buildColorCell(ivec2(x, y)); }},
    {"entry/screen_trace.comp", 8, 8,
     [](const CpuBindings<Real>& bindings) {
         bound = bindings;
         readUniform(params, kParamsBinding);
         readUniform(probeParams, kProbeParamsBinding);
         readUniform(planarParams, kPlanarParamsBinding);
     },
     [](int x, int y) {
         fetchCount = 0; // a variable of the invocation
         traceScreenPixel(ivec2(x, y));
     }},
};

#include "harness/backend/cpu/glsl_end.h"

#if CROSSRAY_GLSL_PRECISION == 64
namespace crossray::cpu64 {
#else
namespace crossray::cpu32 {
#endif

std::span<const CpuKernel<Real>> kernels() { return kKernels; }

bool setVariant(std::string_view variant, double value)
{
#define CROSSRAY_VARIANT(id, name, initial) \
    if (variant == #name) { \
        name = static_cast<int>(value); \
        return true; \
    }
#include "bindings/variants.glsl"
#undef CROSSRAY_VARIANT
    return false;
}

void resetVariants()
{
#define CROSSRAY_VARIANT(id, name, initial) name = initial;
#include "bindings/variants.glsl"
#undef CROSSRAY_VARIANT
}

} // namespace crossray::cpu32 or cpu64
