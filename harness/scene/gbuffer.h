// G-buffers: from an analytic scene by the ray caster, or from another renderer's EXR.
#pragma once

#include "harness/base/plane.h"
#include "harness/scene/camera.h"
#include "harness/scene/scene.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// The channels a shader may ask for. Values are doubles; float devices receive them rounded once.
enum class GBufferChannel {
    kDeviceDepth, // 1: [0,1], the camera's convention and format; cleared where there is no surface
    kLinearDepth, // 1: metres along the view axis; 0 where there is no surface
    kNormalWS,    // 3: unit, geometric, on the viewer's side (also for planes seen from behind, and inside a solid); 0
                  // without a surface
    kPositionWS,  // 3: metres; 0 where there is no surface
    kColor,       // 3: linear radiance; the sky's where there is no surface
    kObjectIndex, // 1: 0 where there is no surface
};
std::string_view nameOf(GBufferChannel channel);
int channelCount(GBufferChannel channel);

struct GBuffer {
    Camera camera;
    std::map<GBufferChannel, Plane> planes;           // only what was asked for
    const Plane& plane(GBufferChannel channel) const; // throws InputError that names the channel when it is missing
};

// Samples each pixel's centre. Only the channels asked for are computed. Surfaces nearer than the camera's near plane
// or beyond its far plane are cut away, as a rasteriser does. Throws InputError on an invalid camera or scene.
GBuffer renderGBuffer(const Scene& scene, const Camera& camera, std::span<const GBufferChannel> channels);

// How to find the channels in another renderer's EXR: our channel -> "layer.channel" names in order.
using ChannelMap = std::map<GBufferChannel, std::vector<std::string>>;
// Blender's multilayer names (ViewLayer.Depth.Z and so on): the default, a data set from Blender needs no map.
ChannelMap blenderChannelMap();
// The names that writeGBuffer gives: part name and channel ("NormalWS.R").
ChannelMap crossrayChannelMap();

// Reads an EXR's channels and computes what the file lacks and can be computed: device depth, linear depth and
// position, each from either of the others. No surface is a linear depth of 1e10 and more (Blender) or of 0, a cleared
// device depth, or (where the file has neither depth) a position of exactly 0; there the planes hold their "no surface"
// value whatever the file says. A camera's device depths are clamped to [0,1]. Throws InputError naming the file when
// it is truncated, lacks channels (named), has another size than the camera's, a negative or NaN depth, or a header
// beyond the bounds of exr.h.
GBuffer readGBuffer(const std::filesystem::path& file, const Camera& camera, const ChannelMap& map,
                    std::span<const GBufferChannel> channels);
// One part a plane, as exr.h describes.
void writeGBuffer(const std::filesystem::path& file, const GBuffer& gbuffer);

// camera.json of a recorded data set: "size", "camera" {fov_y_deg, near, far}, "camera_to_world_rows", and optionally
// "primitives" (shape, center, half or radius, normal, color, material, ior). The camera is a perspective one with
// reversed depth in [0,1]; its matrix, rounded to float in the file, is made orthonormal again. The world is Z up; a
// plane's first half extent is the horizontal one (along x where the plane itself is horizontal). What the file does
// not tell is black: the sky, a colour. Throws InputError with file and what is wrong.
Camera readCameraJson(const std::filesystem::path& file);
Scene readSceneJson(const std::filesystem::path& file);

} // namespace crossray
