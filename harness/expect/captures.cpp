#include "harness/expect/captures.h"

#include "harness/base/error.h"
#include "harness/scene/capture.h"

#include <fmt/format.h>

namespace crossray {

namespace {

std::optional<Primitive> makeProxyPrimitive(const ProbeVolume& proxy)
{
    if (proxy.shape == VolumeShape::kInfinite) return std::nullopt;
    Primitive primitive;
    primitive.shape = proxy.shape == VolumeShape::kBox ? PrimitiveShape::kBox : PrimitiveShape::kSphere;
    primitive.center = proxy.center;
    primitive.worldFromLocal = proxy.worldFromVolume;
    primitive.halfExtents = proxy.halfExtents;
    primitive.radius = proxy.halfExtents.x;
    return primitive;
}

Cubemap readBaked(const Case& testCase, const SceneCapture& capture, int size)
{
    const std::string file = capture.bakedFile.string();
    const auto refuse = [&](const std::string& what) {
        throw InputError(capture.position,
                         fmt::format("{}; `crossray bake {}` writes it", what, testCase.file.string()));
    };
    std::error_code error;
    if (!std::filesystem::is_regular_file(capture.bakedFile, error))
        refuse(fmt::format("the baked cubemap {} is not there", file));
    Cubemap cubemap = readCubemap(capture.bakedFile);
    if (cubemap.size != size)
        refuse(
            fmt::format("the baked cubemap {} has {} texels a side, the case asks for {}", file, cubemap.size, size));
    return cubemap;
}

} // namespace

std::optional<Cubemap> loadCubemap(const Case& testCase, const Environment& environment, const Probe* probe)
{
    if (const auto* own = std::get_if<CubemapFile>(&environment.content)) return readCubemap(own->file);
    const auto* capture = std::get_if<SceneCapture>(&environment.content);
    if (capture == nullptr || probe == nullptr) return std::nullopt;
    if (capture->mode == SceneCapture::Mode::kBaked) return readBaked(testCase, *capture, environment.size);
    return captureProbe(testCase, *probe);
}

Cubemap captureProbe(const Case& testCase, const Probe& probe)
{
    const auto& capture = std::get<SceneCapture>(probe.environment.content);
    CaptureSettings settings;
    settings.positionWS = probe.capturePosition;
    settings.size = probe.environment.size;
    settings.face = capture.face;
    settings.bounces = capture.bounces;
    settings.proxy = makeProxyPrimitive(probe.proxy);
    return captureCubemap(testCase.scene, settings);
}

PlanarCaptureSettings makePlanarSettings(const Probe& probe)
{
    const ProbeMirror& mirror = probe.mirror;
    return {{mirror.position, mirror.normal}, mirror.width, mirror.height, mirror.fovYDegrees};
}

} // namespace crossray
