// Reflection probes and the sky: [[probe]], [sky] and [environment].
#include "harness/case/probe.h"
#include "harness/case/schema_key.h"
#include "harness/scene/capture.h"

namespace crossray {

using enum KeyType;

namespace {

std::vector<KeySpec> influenceKeys()
{
    const auto distances = [](std::string_view key, std::string_view summary) {
        return Key("probe.influence", key, kVec3).atLeast(0).withoutIt("all faces as without sign").says(summary);
    };
    const auto faces = [](std::string_view key, std::string_view summary) {
        return Key("probe.influence", key, kVec3).atLeast(0).atMost(1).byDefault("[1, 1, 1]").says(summary);
    };
    return {
        Key("probe.influence", "shape", kChoice).oneOf({"box", "sphere"}).required().says("Shape of the volume."),
        Key("probe.influence", "center", kVec3).byDefault("[0, 0, 0]").says("World space, metres."),
        Key("probe.influence", "rotation", kRotation)
            .withoutIt("none")
            .says("World from influence: Euler degrees [x, y, z], or { axis, degrees }."),
        Key("probe.influence", "half_extents", kVec3)
            .atLeast(0)
            .withoutIt("required by box")
            .says("Along the volume's own axes, metres."),
        Key("probe.influence", "radius", kNumber).atLeast(0).withoutIt("required by sphere").says("Metres."),
        Key("probe.influence", "blend", kNumber)
            .atLeast(0)
            .byDefault("0.0")
            .says("Metres inwards over which the weight rises from 0 to 1."),
        distances("blend_positive", "Box: the same for the faces at +x, +y, +z, each its own."),
        distances("blend_negative", "Box: for the faces at -x, -y, -z."),
        Key("probe.influence", "blend_normal", kNumber)
            .atLeast(0)
            .byDefault("0.0")
            .says("Metres inwards to the blend-normal volume, outside which the surface's normal counts."),
        distances("blend_normal_positive", "Box: the same for the faces at +x, +y, +z, each its own."),
        distances("blend_normal_negative", "Box: for the faces at -x, -y, -z."),
        faces("face_positive", "Box: share of the reflections towards +x, +y, +z that is let through."),
        faces("face_negative", "Box: share of those towards -x, -y, -z."),
    };
}

std::vector<KeySpec> proxyKeys()
{
    return {
        Key("probe.proxy", "shape", kChoice)
            .oneOf({"box", "sphere", "infinite"})
            .required()
            .says("That of the influence, or infinite."),
        Key("probe.proxy", "center", kVec3).withoutIt("the influence's").says("World space, metres."),
        Key("probe.proxy", "rotation", kRotation)
            .withoutIt("the influence's")
            .says("World from proxy: Euler degrees [x, y, z], or { axis, degrees }."),
        Key("probe.proxy", "half_extents", kVec3)
            .atLeast(0)
            .withoutIt("the influence's")
            .says("Along the proxy's own axes, metres."),
        Key("probe.proxy", "radius", kNumber).atLeast(0).withoutIt("the influence's").says("Metres."),
        Key("probe.proxy", "min_distance", kNumber)
            .atLeast(0)
            .atMost(65504)
            .byDefault("0.0")
            .says("Metres; nearer hits are taken as being that far."),
    };
}

std::vector<KeySpec> environmentKeys()
{
    return {
        Key("environment", "solid", kVec3)
            .atLeast(0)
            .withoutIt("one content is required")
            .says("Content: one linear RGB radiance."),
        Key("environment", "faces", kVec3List)
            .atLeast(0)
            .allowed("6 colours: +x, -x, +y, -y, +z, -z")
            .withoutIt("one content is required")
            .says("Content: a radiance a face."),
        Key("environment", "levels", kVec3List)
            .atLeast(0)
            .allowed("1 colour or more, the finest level's first")
            .withoutIt("one content is required")
            .says("Content: a radiance a mip level; the last goes on."),
        Key("environment", "gradient", kTable)
            .withoutIt("one content is required")
            .says("Content: keys of [scene.sky], about the scene's up."),
        Key("environment", "file", kString)
            .allowed("an EXR inside the case's folder")
            .withoutIt("one content is required")
            .says("Content: a cubemap file of your own. Beside `capture = \"baked\"`: where the baked one is, "
                  "FILE.probeN.exr beside the case unless given."),
        Key("environment", "capture", kChoice)
            .oneOf({"baked", "realtime"})
            .withoutIt("one content is required")
            .says("Content: the scene, seen from the capture position; baked: as `crossray bake` last wrote it, "
                  "realtime: "
                  "at each run."),
        Key("environment", "bounces", kInteger)
            .atLeast(0)
            .atMost(kMaxBounces)
            .withoutIt("mirrors show their own radiance")
            .says("Capture: reflections that mirrors show; at 0 they are black."),
        Key("environment", "face", kChoice)
            .oneOf({"all", "+x", "-x", "+y", "-y", "+z", "-z"})
            .byDefault("\"all\"")
            .says("Capture: one face alone; the others stay black."),
        Key("environment", "size", kInteger)
            .atLeast(1)
            .atMost(kLargestEnvironment)
            .byDefault("16")
            .says("Texels a side of the finest level, a power of two; the mip chain ends at one texel."),
    };
}

std::vector<KeySpec> mirrorKeys()
{
    return {
        Key("probe.mirror", "position", kVec3)
            .withoutIt("the influence's center")
            .says("A point of the mirror plane, world space, metres."),
        Key("probe.mirror", "rotation", kRotation)
            .withoutIt("none")
            .says("World from mirror: Euler degrees [x, y, z], or { axis, degrees }; the normal is its +z."),
        Key("probe.mirror", "normal", kVec3)
            .withoutIt("[0, 0, 1]")
            .says("In the place of a rotation: the side from which the mirror is seen; any length but 0."),
        Key("probe.mirror", "fov", kNumber)
            .atLeast(0)
            .below(180)
            .withoutIt("the camera's")
            .says("Vertical field of view of the capture in degrees, perspective; 0 captures nothing."),
        Key("probe.mirror", "size", kSize)
            .atLeast(1)
            .atMost(1024)
            .withoutIt("the image's")
            .says("Width and height of the capture, pixels."),
        Key("probe.mirror", "filter", kChoice)
            .oneOf({"nearest", "linear"})
            .byDefault("\"linear\"")
            .says("The nearest pixel of the capture, or between the nearest four."),
    };
}

std::vector<KeySpec> rgbmKeys()
{
    const auto number = [](std::string_view key, double most, std::string_view summary) {
        return Key("probe.rgbm", key, kNumber).atLeast(0).atMost(most).byDefault("1.0").says(summary);
    };
    return {
        number("alpha", 1, "Of all texels."),
        number("range", 65504, "Decode constant x: factor."),
        number("exponent", 65504, "Decode constant y: power of the alpha, in linear colour space."),
        number("alpha_weight", 65504, "Decode constant w: how much alpha counts; 0 is not at all."),
    };
}

std::vector<KeySpec> profileKeys()
{
    return {
        Key("profile", "blending", kBoolean)
            .byDefault("true")
            .says("Probes are mixed; without it the object's first probe alone shows, in full."),
        Key("profile", "box_projection", kBoolean)
            .byDefault("true")
            .says("Probes that enable it are projected on their box; without it none is."),
        Key("profile", "box_projection_form", kChoice)
            .oneOf({"division", "select"})
            .byDefault("\"division\"")
            .says("By dividing by both faces of an axis, or by choosing the face ahead first."),
        Key("profile", "forward_plus", kBoolean)
            .byDefault("false")
            .says("urp_unity: every probe at the pixel, in order, until their weights reach 0.99."),
        Key("profile", "half_precision", kBoolean)
            .byDefault("false")
            .says("urp_unity: sizes overflow beyond a diagonal of 255.9 m, and are then equal."),
        Key("profile", "roughness_mip", kChoice)
            .oneOf({"approximate", "exact"})
            .byDefault("\"approximate\"")
            .says("Mip level by 1.7r - 0.7r^2, or by what that stands for."),
        Key("profile", "color_space", kChoice)
            .oneOf({"linear", "gamma"})
            .byDefault("\"linear\"")
            .says("In gamma space the alpha of RGBM texels has no exponent."),
    };
}

} // namespace

std::vector<KeySpec> probeKeys()
{
    std::vector<KeySpec> keys{
        Key("probe", "kind", kChoice)
            .oneOf({"reflection", "planar"})
            .byDefault("\"reflection\"")
            .says("A cubemap, or what a mirror plane shows to the camera."),
        Key("probe", "influence", kTable).required().says("Where the probe counts."),
        Key("probe", "proxy", kTable)
            .withoutIt("infinite")
            .says("What stands for the surroundings: reflections are projected on it."),
        Key("probe", "capture_position", kVec3)
            .withoutIt("the influence's center")
            .says("Where the environment was seen from, world space, metres."),
        Key("probe", "weight", kNumber)
            .atLeast(0)
            .atMost(1000)
            .byDefault("1.0")
            .says("Factor; above 1 it counts as 1."),
        Key("probe", "multiplier", kNumber).atLeast(0).atMost(65504).byDefault("1.0").says("Factor on the colour."),
        Key("probe", "importance", kInteger)
            .atLeast(-32768)
            .atMost(32767)
            .byDefault("1")
            .says("Order among probes where the profile goes by it; HDRP does not."),
        Key("probe", "distance_based_roughness", kBoolean)
            .byDefault("true")
            .says("Sharper where the reflecting surface is nearer to what it reflects than the capture was."),
        Key("probe", "box_projection", kBoolean)
            .byDefault("false")
            .says("builtin and urp: the influence's box is what reflections are projected on."),
        Key("probe", "rgbm", kTable)
            .withoutIt("the environment is radiance")
            .says("builtin and urp: the environment's colours are RGBM texels, which are decoded."),
        Key("probe", "environment", kTable)
            .withoutIt("required by reflection")
            .says("What the probe shows; keys of [environment]."),
        Key("probe", "mirror", kTable).withoutIt("required by planar").says("The mirror plane and its capture."),
    };
    for (std::vector<KeySpec> group :
         {influenceKeys(), proxyKeys(), mirrorKeys(), rgbmKeys(), environmentKeys(), profileKeys()}) {
        keys.insert(keys.end(), std::make_move_iterator(group.begin()), std::make_move_iterator(group.end()));
    }
    return keys;
}

std::vector<KeySpec> skyKeys()
{
    return {
        Key("sky", "model", kChoice)
            .oneOf({"none", "gradient", "cubemap"})
            .byDefault("\"gradient\"")
            .says("What the last tier of the hierarchy shows; none gives nothing."),
        Key("sky", "gradient", kTable)
            .withoutIt("that of [scene.sky]")
            .says("Keys of [scene.sky], about the scene's up."),
        Key("sky", "environment", kTable).withoutIt("required by cubemap").says("Keys of [environment]."),
    };
}

} // namespace crossray
