#include "harness/bench/bench_case.h"

#include "harness/bench/family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

// A wall along an axis that is half as long as the box bounds it on the side that it faces away from.
void clipByWalls(const Scene& scene, glm::dvec3& low, glm::dvec3& high)
{
    const glm::dvec3 size = high - low;
    for (const Primitive& primitive : scene.primitives) {
        const glm::dvec3& normal = primitive.worldFromLocal[2];
        if (primitive.shape != PrimitiveShape::kPlane || primitive.halfExtents.x < 0.25 * std::max(size.x, size.z))
            continue;
        for (int axis = 0; axis < 3; ++axis) {
            if (normal[axis] > 0.999) low[axis] = std::max(low[axis], primitive.center[axis]);
            if (normal[axis] < -0.999) high[axis] = std::min(high[axis], primitive.center[axis]);
        }
    }
}

// A box around all that is finite: what an artist would draw as a proxy.
ProxyVolume boundScene(const Scene& scene)
{
    glm::dvec3 low(kNoLimit), high(-kNoLimit);
    for (const Primitive& primitive : scene.primitives) {
        const glm::dvec3 reach = localHalfExtents(primitive);
        if (std::max({reach.x, reach.y, reach.z}) >= kNoLimit) continue;
        glm::dvec3 extent(0.0);
        for (int axis = 0; axis < 3; ++axis)
            extent += glm::abs(primitive.worldFromLocal[axis]) * reach[axis];
        low = glm::min(low, primitive.center - extent);
        high = glm::max(high, primitive.center + extent);
    }
    ProxyVolume proxy;
    if (low.x > high.x) return proxy;
    clipByWalls(scene, low, high);
    proxy.center = 0.5 * (low + high);
    proxy.halfExtents = glm::max(0.5 * (high - low), glm::dvec3(1e-3));
    proxy.radius = std::max({proxy.halfExtents.x, proxy.halfExtents.y, proxy.halfExtents.z});
    return proxy;
}

void addProxies(const Case& testCase, std::vector<BenchMethod>& methods)
{
    const bool hasOwn = testCase.projection.model == ProjectionModel::kProxyBox ||
                        testCase.projection.model == ProjectionModel::kProxySphere;
    const ProxyVolume proxy = hasOwn ? testCase.projection.proxy : boundScene(testCase.scene);
    const std::pair<const char*, ProjectionModel> models[] = {{"proxy, infinite", ProjectionModel::kProxyInfinite},
                                                              {"proxy, sphere", ProjectionModel::kProxySphere},
                                                              {"proxy, box", ProjectionModel::kProxyBox}};
    for (const auto& [name, model] : models) {
        methods.push_back({name, "proxy", [proxy, model = model](Case& varied) {
                               varied.projection.model = model;
                               varied.projection.proxy = proxy;
                           }});
    }
}

void addHiz(std::vector<BenchMethod>& methods, double thickness)
{
    const auto add = [&](const std::string& name, HizSettings settings, int scale) {
        methods.push_back({name, "hiz",
                           [settings](Case& varied) {
                               varied.projection.model = ProjectionModel::kHiz;
                               varied.projection.hiz = settings;
                           },
                           scale});
    };
    for (const int minLevel : {0, 1, 2}) {
        for (const int iterations : {32, 64, 256}) {
            add(fmt::format("HiZ, levels {} to 6, {} steps", minLevel, iterations),
                {minLevel, 6, iterations, thickness}, 1);
        }
    }
    add("HiZ, levels 0 to 3, 256 steps", {0, 3, 256, thickness}, 1);
    add("HiZ, levels 0 to 6, 256 steps, half size", {0, 6, 256, thickness}, 2);
}

void addLinear(std::vector<BenchMethod>& methods, double thickness)
{
    for (const int stride : {1, 2, 4, 8, 16}) {
        methods.push_back({fmt::format("linear, stride {}, 5 halvings", stride), "linear", [=](Case& varied) {
                               varied.projection.model = ProjectionModel::kLinear;
                               varied.projection.linear = LinearSettings{.stride = static_cast<double>(stride),
                                                                         .steps = 0,
                                                                         .maxIterations = 2048,
                                                                         .depthBias = thickness,
                                                                         .bisections = 5};
                           }});
    }
}

void addPatches(std::vector<BenchMethod>& methods)
{
    const auto add = [&](const std::string& name, double caution, int scale) {
        methods.push_back({name, "patches",
                           [caution](Case& varied) {
                               varied.projection.model = ProjectionModel::kPatches;
                               varied.projection.patches = PatchSettings{.caution = caution};
                           },
                           scale});
    };
    for (const double caution : {0.25, 0.5, 1.0})
        add(fmt::format("patches, caution {}", caution), caution, 1);
    add("patches, caution 0.5, half size", 0.5, 2);
}

} // namespace

BenchMethod makeOwnMethod(const std::string& text)
{
    const size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) {
        throw InputError(fmt::format("--method {}: allowed is NAME=FILE, as mine=path/to/tracer.glsl", text));
    }
    const std::filesystem::path file = std::filesystem::absolute(text.substr(sign + 1)).lexically_normal();
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed)) {
        throw InputError({text.substr(sign + 1)}, fmt::format("--method {}: there is no such file", text));
    }
    return {text.substr(0, sign), "own", [file](Case& varied) {
                varied.projection.model = ProjectionModel::kOwn;
                varied.projection.own.tracer = file;
            }};
}

std::vector<BenchMethod> makeBenchMethods(const Case& testCase)
{
    if (const BenchFamily* family = findBenchFamily(testCase.benchFamily)) return family->makeMethods(testCase);
    std::vector<BenchMethod> methods;
    if (testCase.effect == TraceEffect::kRefraction) {
        const std::tuple<const char*, const char*, RefractionModel> models[] = {
            {"None", "none", RefractionModel::kNone},
            {"Thin", "thin", RefractionModel::kThin},
            {"Box", "box", RefractionModel::kBox},
            {"Sphere", "sphere", RefractionModel::kSphere}};
        for (const auto& [name, kind, model] : models) {
            methods.push_back({name, kind, [model = model](Case& varied) { varied.material.refractionModel = model; }});
        }
        return methods;
    }
    addProxies(testCase, methods);
    addLinear(methods, testCase.projection.hiz.depthBias);
    addHiz(methods, testCase.projection.hiz.depthBias);
    addPatches(methods);
    return methods;
}

} // namespace crossray
