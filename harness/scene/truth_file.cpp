#include "harness/base/error.h"
#include "harness/scene/camera_frame.h"
#include "harness/scene/exr.h"
#include "harness/scene/refraction.h"
#include "harness/scene/truth.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

namespace crossray {

namespace {

constexpr double kPositionOffset = 64.0; // what a position is stored with, so that it is never 0
constexpr double kRelativeDepthBound = 1e-3;
constexpr double kCurvatureShare = 0.25; // of the depth that a pixel's plane changes over one pixel

glm::dvec3 vectorAt(const Plane& plane, int x, int y)
{
    return {plane.at(x, y, 0), plane.at(x, y, 1), plane.at(x, y, 2)};
}

// Positions by pixel; a stored 0 is left as it is.
Plane readPositions(const std::filesystem::path& file, const Camera& camera)
{
    const std::map<std::string, Plane> channels = readExrChannels(file);
    const auto fail = [&](const std::string& what) { throw InputError({file.string(), 0, 0}, what); };
    Plane positions("Truth", camera.width, camera.height, 3);
    size_t c = 0;
    for (const char* name : {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"}) {
        const auto found = channels.find(name);
        if (found == channels.end()) {
            fail(fmt::format("missing channel {}; allowed: positions + 64 as ViewLayer.Combined.RGB", name));
            break;
        }
        const Plane& stored = found->second;
        if (stored.width != camera.width || stored.height != camera.height)
            fail(fmt::format("{}x{} pixels; allowed: the camera's {}x{}", stored.width, stored.height, camera.width,
                             camera.height));
        for (size_t i = 0; i < stored.values.size(); ++i) {
            if (!std::isfinite(stored.values[i])) fail("a position is NaN or infinite; allowed: finite positions + 64");
            positions.values[3 * i + c] = stored.values[i];
        }
        ++c;
    }
    return positions;
}

class RecordedTruth {
  public:
    RecordedTruth(const GBuffer& gbuffer, const Scene& primitives, TraceEffect effect)
        : frame_(gbuffer.camera), linearDepth_(gbuffer.plane(GBufferChannel::kLinearDepth)),
          position_(gbuffer.plane(GBufferChannel::kPositionWS)), normal_(gbuffer.plane(GBufferChannel::kNormalWS)),
          color_(gbuffer.planes.contains(GBufferChannel::kColor) ? &gbuffer.plane(GBufferChannel::kColor) : nullptr)
    {
        if (effect == TraceEffect::kReflection) return;
        for (const Primitive& primitive : primitives.primitives)
            if (primitive.material == "glass") glass_ = primitive;
        if (!glass_) throw InputError("the camera file has no primitive of glass; allowed: one sphere or box of glass");
    }

    TruthPixel trace(int x, int y, const glm::dvec3& stored) const
    {
        TruthPixel pixel;
        if (!startRay(pixel, x, y)) return pixel;
        if (color_ != nullptr) pixel.radiance = vectorAt(*color_, x, y);
        if (stored == glm::dvec3(0.0)) {
            pixel.screen = ScreenKnowledge::kSky;
            return pixel;
        }
        pixel.hitPositionWS = stored - kPositionOffset;
        const glm::dvec3 toHit = pixel.hitPositionWS - pixel.rayOriginWS;
        if (glm::length(toHit) > 0.0) pixel.rayDirWS = glm::normalize(toHit);
        const ScreenPoint point = frame_.project(pixel.hitPositionWS);
        pixel.hitPositionSS = point.positionSS;
        pixel.hitLinearDepth = point.linearDepth;
        pixel.screen = classify(point, pixel.rayDirWS);
        return pixel;
    }

  private:
    // Origin and closed-form direction; false when no ray leaves.
    bool startRay(TruthPixel& pixel, int x, int y) const
    {
        if (linearDepth_.at(x, y) == 0.0) return false;
        const glm::dvec3 surfaceWS = vectorAt(position_, x, y);
        // Through the recorded position: a renderer's sample may miss the pixel's centre by a thousandth of a pixel.
        const Ray view = frame_.primaryRay(frame_.project(surfaceWS).positionSS);
        if (!glass_) {
            pixel.rayOriginWS = surfaceWS;
            pixel.rayDirWS = reflectDirection(view.dirWS, vectorAt(normal_, x, y));
            return true;
        }
        glm::dvec3 entryWS = surfaceWS;
        glm::dvec3 normalWS(0.0);
        if (glass_->shape == PrimitiveShape::kSphere) { // also on the outline, where the ray may miss by rounding
            normalWS = glm::normalize(surfaceWS - glass_->center);
            entryWS = glass_->center + glass_->radius * normalWS;
        } else {
            const auto hits = intersectPrimitive(*glass_, view);
            if (hits.empty()) return false;
            entryWS = hits.front().positionWS;
            normalWS = hits.front().normalWS;
        }
        const auto path = refractThrough(*glass_, entryWS, normalWS, view.dirWS);
        pixel.totalInternalReflection = !path;
        if (!path) return false;
        pixel.rayOriginWS = path->exitWS;
        pixel.rayDirWS = path->exitDirWS;
        pixel.pathLength = path->length;
        return true;
    }

    ScreenKnowledge classify(const ScreenPoint& point, const glm::dvec3& rayDirWS) const
    {
        const Camera& camera = frame_.camera();
        if (!frame_.covers(point)) return ScreenKnowledge::kOffScreen;
        const int left = static_cast<int>(std::floor(point.positionSS.x - 0.5));
        const int top = static_cast<int>(std::floor(point.positionSS.y - 0.5));
        for (int y = top; y <= top + 1; ++y)
            for (int x = left; x <= left + 1; ++x) {
                if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
                if (agrees(x, y, point) && glm::dot(rayDirWS, vectorAt(normal_, x, y)) < 0.0)
                    return ScreenKnowledge::kVisible;
            }
        return ScreenKnowledge::kHidden;
    }

    // Depth at a point of the image of the plane that a pixel stands for; nothing where the plane is not seen.
    std::optional<double> planeDepth(int x, int y, const glm::dvec2& positionSS) const
    {
        const Ray ray = frame_.primaryRay(positionSS);
        const glm::dvec3 normal = vectorAt(normal_, x, y);
        const double descent = glm::dot(normal, ray.dirWS);
        if (!(descent < 0.0)) return std::nullopt;
        const double distance = glm::dot(normal, vectorAt(position_, x, y) - ray.originWS) / descent;
        return distance * glm::dot(ray.dirWS, frame_.forwardWS());
    }

    bool agrees(int x, int y, const ScreenPoint& point) const
    {
        const double center = linearDepth_.at(x, y);
        if (center == 0.0) return false;
        const std::optional<double> here = planeDepth(x, y, point.positionSS);
        const std::optional<double> right = planeDepth(x, y, {x + 1.0, y + 0.5});
        const std::optional<double> below = planeDepth(x, y, {x + 0.5, y + 1.0});
        if (!here || !right || !below) return false;
        const double slope = 2.0 * (std::abs(*right - center) + std::abs(*below - center)); // metres a pixel
        return std::abs(*here - point.linearDepth) <= kRelativeDepthBound * point.linearDepth + kCurvatureShare * slope;
    }

    CameraFrame frame_;
    const Plane& linearDepth_;
    const Plane& position_;
    const Plane& normal_;
    const Plane* color_;
    std::optional<Primitive> glass_;
};

} // namespace

Truth readTruth(const std::filesystem::path& truthFile, const GBuffer& gbuffer, const Scene& primitives,
                TraceEffect effect, int objectIndex)
{
    const Plane& index = gbuffer.plane(GBufferChannel::kObjectIndex);
    const Plane positions = readPositions(truthFile, gbuffer.camera);
    const RecordedTruth recorded(gbuffer, primitives, effect);
    Truth truth;
    truth.width = gbuffer.camera.width;
    truth.height = gbuffer.camera.height;
    truth.pixels.resize(positions.pixelCount());
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            if (std::lround(index.at(x, y)) == objectIndex)
                truth.pixels[static_cast<size_t>(y) * static_cast<size_t>(truth.width) + static_cast<size_t>(x)] =
                    recorded.trace(x, y, vectorAt(positions, x, y));
    return truth;
}

} // namespace crossray
