#include "harness/pass/pass_params.h"

#include "harness/pass/params.h"

#include <algorithm>

namespace crossray {

namespace {

// deviceDepth = x + y / linearDepth (perspective) or x + y * linearDepth (orthographic); always [0,1] storage.
glm::dvec4 computeDepthTerms(const Camera& camera)
{
    const double nearZ = camera.nearDistance;
    const double farZ = camera.farDistance;
    const double range = farZ - nearZ;
    // Far enough for any scene, small enough for half floats: HDRP's stand-in for infinity.
    constexpr double kInfiniteFar = 65504.0;
    if (camera.projection == ProjectionKind::kOrthographic) {
        if (camera.depthConvention == DepthConvention::kStandard) return {-nearZ / range, 1.0 / range, nearZ, farZ};
        return {farZ / range, -1.0 / range, nearZ, farZ};
    }
    switch (camera.depthConvention) {
    case DepthConvention::kStandard:
        return {farZ / range, -farZ * nearZ / range, nearZ, farZ};
    case DepthConvention::kReversed:
        return {-nearZ / range, farZ * nearZ / range, nearZ, farZ};
    case DepthConvention::kInfiniteReversed:
        return {0.0, nearZ, nearZ, kInfiniteFar};
    }
    return {};
}

glm::dvec2 computeSlope(const Camera& camera)
{
    const double aspect = static_cast<double>(camera.width) / camera.height;
    const double vertical = camera.projection == ProjectionKind::kPerspective
                                ? std::tan(glm::radians(camera.fovYDegrees) * 0.5)
                                : camera.orthographicHeight * 0.5;
    return {vertical * aspect, vertical};
}

// Levels that roughness is spread over.
int countColorLevels(const Case& testCase, const std::vector<PyramidLevel>& levels)
{
    const int all = static_cast<int>(levels.size());
    const int asked = testCase.history ? testCase.history->levels : 0;
    return asked > 0 ? std::min(asked, all) : all;
}

template <class Params>
Params fillPassParams(const Case& testCase, const std::vector<PyramidLevel>& levels, const PixelQuery& query)
{
    using Vec4 = decltype(Params::material);
    using Mat4 = decltype(Params::viewFromWorld);
    const Camera& camera = testCase.camera;
    const Material& material = testCase.material;
    const Projection& projection = testCase.projection;
    const glm::dvec2 slope = computeSlope(camera);

    Params params{};
    params.viewFromWorld = Mat4(computeViewFromWorld(camera));
    params.worldFromView = Mat4(camera.worldFromView);
    params.clipFromView = Mat4(computeClipFromView(camera));
    params.worldFromProxy = Mat4(glm::dmat4(projection.proxy.worldFromProxy));
    params.imageSizeAndSlope = Vec4(glm::dvec4(camera.width, camera.height, slope.x, slope.y));
    params.depthTerms = Vec4(computeDepthTerms(camera));
    params.material = Vec4(glm::dvec4(material.ior, material.thickness * material.thicknessMultiplier,
                                      material.roughness, material.thicknessMultiplier));
    params.absorption = Vec4(glm::dvec4(material.transmittanceColor, material.absorptionDistance));
    const Camera& previous = testCase.history ? testCase.history->camera : camera;
    const glm::dvec2 previousSlope = computeSlope(previous);
    params.previousViewFromWorld = Mat4(computeViewFromWorld(previous));
    params.history = Vec4(glm::dvec4(previousSlope, countColorLevels(testCase, levels), 0.0));
    params.proxyCenterWS = Vec4(glm::dvec4(projection.proxy.center, 0.0));
    params.proxyExtents = Vec4(glm::dvec4(projection.proxy.halfExtents, projection.proxy.radius));
    params.tracing = Vec4(glm::dvec4(projection.hiz.depthBias, projection.screenWeightDistance, 0.0, 0.0));
    params.linearTracing = Vec4(glm::dvec4(projection.linear.stride, projection.linear.depthBias, 0.0, 0.0));
    params.linearLimits =
        glm::ivec4(projection.linear.steps, projection.linear.maxIterations, projection.linear.bisections, 0);
    params.hizLimits = glm::ivec4(projection.hiz.minLevel, projection.hiz.maxLevel, projection.hiz.maxIterations,
                                  static_cast<int>(levels.size()));
    if (projection.model == ProjectionModel::kPatches) {
        params.hizLimits.x = 0;
        params.hizLimits.y = projection.patches.maxLevel;
        params.hizLimits.z = projection.patches.maxIterations;
        params.tracing.x = 0;
    }
    if (projection.model == ProjectionModel::kLinear) {
        params.hizLimits.x = params.hizLimits.y = 0;
        params.hizLimits.z = projection.linear.maxIterations;
        params.tracing.x = static_cast<decltype(params.tracing.x)>(projection.linear.depthBias);
    }
    if (projection.model == ProjectionModel::kOwn) {
        params.hizLimits.x = 0;
        params.hizLimits.y = static_cast<int>(levels.size()) - 1;
        params.hizLimits.z = projection.own.maxIterations;
    }
    params.patches = Vec4(glm::dvec4(projection.patches.caution, projection.patches.depthError, 0.0, 0.0));
    params.record = glm::ivec4(query.x, query.y, query.stepCapacity, 0);
    for (size_t level = 0; level < levels.size(); ++level) {
        params.pyramidLevels[level] = {levels[level].firstCell, levels[level].width, levels[level].height, 0};
    }
    return params;
}

template <class Params>
Params fillPyramidParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t target)
{
    using Vec4 = decltype(Params::depthTerms);
    const PyramidLevel& source = levels[target == 0 ? 0 : target - 1];
    Params params{};
    params.depthTerms = Vec4(computeDepthTerms(testCase.camera));
    params.sourceLevel = {source.firstCell, source.width, source.height, static_cast<int>(target) - 1};
    params.targetLevel = {levels[target].firstCell, levels[target].width, levels[target].height,
                          static_cast<int>(target)};
    params.imageSize = {levels[0].width, levels[0].height, 0, 0};
    return params;
}

template <class Params>
Params fillSurfaceParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t first, size_t last)
{
    using Vec4 = decltype(Params::depthTerms);
    using Mat4 = decltype(Params::viewFromWorld);
    const Camera& camera = testCase.camera;
    const glm::dvec2 slope = computeSlope(camera);
    Params params{};
    params.viewFromWorld = Mat4(computeViewFromWorld(camera));
    params.imageSizeAndSlope = Vec4(glm::dvec4(camera.width, camera.height, slope.x, slope.y));
    params.depthTerms = Vec4(computeDepthTerms(camera));
    params.patches = Vec4(glm::dvec4(0.0, testCase.projection.patches.depthError, 0.0, 0.0));
    params.range = {static_cast<int>(first), static_cast<int>(last), 0, 0};
    for (size_t level = 0; level < levels.size(); ++level)
        params.levels[level] = {levels[level].firstCell, levels[level].width, levels[level].height, 0};
    return params;
}

} // namespace

std::vector<PyramidLevel> layOutPyramid(int width, int height)
{
    std::vector<PyramidLevel> levels{{0, width, height}};
    while (levels.back().width > 1 || levels.back().height > 1) {
        const PyramidLevel& finer = levels.back();
        levels.push_back({finer.firstCell + finer.width * finer.height, std::max(1, finer.width / 2),
                          std::max(1, finer.height / 2)});
    }
    return levels;
}

std::vector<std::byte> makePassParams(const Case& testCase, const std::vector<PyramidLevel>& levels,
                                      Precision precision, const std::optional<PixelQuery>& query)
{
    const PixelQuery recorded = query.value_or(PixelQuery{});
    return precision == Precision::kFloat ? bytesOf(fillPassParams<layout32::PassParams>(testCase, levels, recorded))
                                          : bytesOf(fillPassParams<layout64::PassParams>(testCase, levels, recorded));
}

std::vector<std::byte> makePyramidParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t target,
                                         Precision precision)
{
    return precision == Precision::kFloat
               ? bytesOf(fillPyramidParams<layout32::PyramidParams>(testCase, levels, target))
               : bytesOf(fillPyramidParams<layout64::PyramidParams>(testCase, levels, target));
}

std::vector<std::byte> makeSurfaceParams(const Case& testCase, const std::vector<PyramidLevel>& levels, size_t first,
                                         size_t last, Precision precision)
{
    return precision == Precision::kFloat
               ? bytesOf(fillSurfaceParams<layout32::SurfaceParams>(testCase, levels, first, last))
               : bytesOf(fillSurfaceParams<layout64::SurfaceParams>(testCase, levels, first, last));
}

} // namespace crossray
