// The keys of the case format, table by table, in the order of docs/case-format.md.
#include "harness/base/outputs.h"
#include "harness/case/schema_key.h"
#include "harness/scene/scene_families.h"

#include <iterator>

namespace crossray {

namespace {

using enum KeyType;

std::vector<KeySpec> topKeys()
{
    return {
        Key("", "schema", kInteger).atLeast(1).atMost(1).required().says("Version of this format."),
        Key("", "name", kString)
            .allowed("words of a-z, 0-9 and _, joined by /")
            .required()
            .says("Unique name of the case."),
        Key("", "summary", kString)
            .allowed("not empty")
            .required()
            .says("The claim that the case checks, as a sentence."),
        Key("", "tags", kStringList)
            .allowed("words of a-z, 0-9, _ and -")
            .byDefault("[]")
            .says("What `--tag` selects by."),
        Key("", "use", kStringList)
            .allowed("names of [preset.NAME]")
            .byDefault("[]")
            .says("Presets that are laid under the case; of two that set one key the later wins."),
        Key("", "trace", kChoice)
            .oneOf({"reflection", "refraction"})
            .withoutIt("refraction where refraction_model is not \"none\", else reflection")
            .says("The ray: mirrors trace reflection, glass traces refraction."),
        Key("", "outputs", kChoiceList)
            .oneOf(outputNames())
            .byDefault("[]")
            .says("Outputs to write beside the expected ones."),
        Key("", "backends", kChoiceList)
            .oneOf(backendNames())
            .withoutIt("all")
            .says("The only backends that run the case."),
        Key("", "timeout", kNumber).above(0).atMost(600).byDefault("20").says("Seconds that one backend may take."),
        Key("", "must_fail", kBoolean)
            .byDefault("false")
            .says("Passes when the judge fails the case on every backend."),
        Key("", "bench", kChoice)
            .oneOf({"projection", "refraction_models", "refraction_techniques", "glossy", "depth_formats"})
            .withoutIt("projection for reflections, refraction_models for refractions")
            .says("Family of methods that `crossray bench` measures on the case's scene."),
        Key("", "needs", kChoice)
            .oneOf({"proxy", "linear", "hiz", "patches", "none", "thin", "box", "sphere", "screen", "baked", "realtime",
                    "approximate", "exact", "depth16", "depth24", "depth32"})
            .withoutIt("no claim")
            .says("The cheapest kind of method that keeps budget; `crossray bench` fails the case when another does."),
        Key("", "budget", kString)
            .allowed("ERROR<=NUMBER, several by commas")
            .withoutIt("none; required beside needs")
            .says("Bounds on the errors that `crossray bench` measures."),
        Key("", "camera", kTable).withoutIt("all defaults").says("The camera of an analytic scene."),
        Key("", "scene", kTable).withoutIt("none; this or gbuffer is required").says("An analytic scene."),
        Key("", "gbuffer", kTable).withoutIt("none; this or scene is required").says("A G-buffer of another renderer."),
        Key("", "material", kTable).withoutIt("all defaults").says("The material of the traced pixels."),
        Key("", "projection", kTable).withoutIt("all defaults").says("How the ray finds its hit."),
        Key("", "history", kTable)
            .withoutIt("none: colour is read from this frame")
            .says("The previous frame, which colour is read from."),
        Key("", "hierarchy", kChoiceList)
            .oneOf({"screen", "probes", "sky"})
            .withoutIt("the projection's colour alone")
            .says("Tiers that are asked in turn: each takes its weight, what is left goes on."),
        Key("", "probe", kTableList).byDefault("[]").says("Reflection probes, at most 8."),
        Key("", "probe_profile", kChoice)
            .oneOf({"hdrp", "builtin", "urp_doc", "urp_unity"})
            .byDefault("\"hdrp\"")
            .says("Pipeline whose rules order, weigh and read the probes; URP by its manual, or by its code."),
        Key("", "profile", kTable)
            .withoutIt("all defaults")
            .says("Settings of the profiles builtin, urp_doc and urp_unity."),
        Key("", "dominant_direction", kChoice)
            .oneOf({"off", "plain", "squared"})
            .byDefault("\"squared\"")
            .says(
                "Rough reflections are read nearer to the normal: not at all, by N.V, or by its square as HDRP's code "
                "has it."),
        Key("", "sky", kTable).withoutIt("all defaults").says("The hierarchy's last tier."),
        Key("", "expect", kTableList).required().says("What the outputs are held to."),
        Key("", "expand", kTable)
            .withoutIt("none")
            .says("Parameter lists: one sub-case a value, or a combination of values."),
        Key("", "known_failure", kTableList).byDefault("[]").says("Failures that are excused until a date."),
    };
}

std::vector<KeySpec> cameraKeys()
{
    return {
        Key("camera", "projection", kChoice)
            .oneOf({"perspective", "orthographic"})
            .byDefault("\"perspective\"")
            .says("Kind of camera."),
        Key("camera", "depth", kChoice)
            .oneOf({"reversed", "standard", "infinite_reversed"})
            .byDefault("\"reversed\"")
            .says("Depth buffer: from 1 at the near plane to 0; from 0 there to 1; or from 1 there to 0 at infinity "
                  "(perspective)."),
        Key("camera", "depth_format", kChoice)
            .oneOf({"float32", "unorm24", "unorm16"})
            .byDefault("\"float32\"")
            .says("What an analytic scene's depth buffer stores: floats, or whole numbers of 24 or 16 bits."),
        Key("camera", "ndc_depth", kChoice)
            .oneOf({"zero_to_one", "minus_one_to_one"})
            .byDefault("\"zero_to_one\"")
            .says("Range of z in normalised device coordinates."),
        Key("camera", "eye", kVec3).byDefault("[0, 0, 0]").says("Position in world space, metres."),
        Key("camera", "target", kVec3).byDefault("[0, 0, -1]").says("A point in the middle of the image; not the eye."),
        Key("camera", "up", kVec3)
            .byDefault("[0, 1, 0]")
            .says("Direction that is up in the image; not along the view."),
        Key("camera", "fov", kNumber)
            .above(0)
            .below(180)
            .byDefault("60")
            .says("Vertical field of view in degrees, perspective."),
        Key("camera", "height", kNumber).above(0).byDefault("2").says("Metres from bottom to top, orthographic."),
        Key("camera", "near", kNumber).above(0).byDefault("0.1").says("Distance of the near plane, metres."),
        Key("camera", "far", kNumber)
            .above(0)
            .byDefault("100")
            .says("Distance of the far plane, metres; beyond near; not read by infinite_reversed."),
    };
}

std::vector<std::string> sceneFamilyNames()
{
    std::vector<std::string> names;
    for (const SceneFamily family : allSceneFamilies())
        names.emplace_back(nameOf(family));
    return names;
}

std::vector<KeySpec> sceneKeys()
{
    return {
        Key("scene", "size", kSize)
            .atLeast(1)
            .atMost(16384)
            .byDefault("[64, 64]")
            .says("Width and height of the image, pixels."),
        Key("scene", "up", kVec3).byDefault("[0, 1, 0]").says("Direction of the sky's zenith."),
        Key("scene", "generator", kChoice)
            .oneOf(sceneFamilyNames())
            .withoutIt("none")
            .says(
                "A random scene of mirrors; its primitives come before those listed, and its camera stands in for eye, "
                "target and up."),
        Key("scene", "seed", kInteger)
            .atLeast(0)
            .atMost(1000000000)
            .byDefault("1")
            .says("Of the generator: the same seed is the same scene on every machine."),
        Key("scene", "screen", kChoice)
            .oneOf({"all", "opaque"})
            .byDefault("\"all\"")
            .says("What rays are traced in, depth and colour: every surface, or those that are not of glass, as where "
                  "what is transparent is drawn last."),
        Key("scene", "poison", kChoice)
            .oneOf({"none", "nan", "infinity", "minus_infinity", "negative", "zero", "huge"})
            .byDefault("\"none\"")
            .says("What broken texels of the G-buffer hold: no number, -1, 0, 3e38; a normal in each component. The "
                  "truth knows nothing of it."),
        Key("scene", "poison_channel", kChoice)
            .oneOf({"both", "depth", "normal"})
            .byDefault("\"both\"")
            .says("Which of a broken pixel's texels are broken; a depth is the stored one."),
        Key("scene", "poison_every", kInteger)
            .atLeast(1)
            .atMost(16384)
            .byDefault("8")
            .says("One pixel of so many is broken, both ways; 1: all are."),
        Key("scene", "primitives", kTableList).byDefault("[]").says("Primitives as inline tables."),
        Key("scene", "primitive", kTableList)
            .byDefault("[]")
            .says("The same as [[scene.primitive]]; they follow those of primitives."),
        Key("scene", "sky", kTable).withoutIt("all defaults").says("Radiance where no primitive is."),
        Key("scene.sky", "zenith", kVec3).atLeast(0).byDefault("[0.25, 0.45, 0.85]").says("Straight up, linear RGB."),
        Key("scene.sky", "horizon", kVec3).atLeast(0).byDefault("[0.75, 0.85, 0.95]").says("At a right angle to up."),
        Key("scene.sky", "nadir", kVec3).atLeast(0).byDefault("[0.2, 0.18, 0.16]").says("Straight down."),
        Key("scene.primitives", "shape", kChoice)
            .oneOf({"plane", "sphere", "box", "lens", "torus"})
            .required()
            .says("A plane is the local x-y plane, its normal local +z; the axis of a lens and of a torus is local z."),
        Key("scene.primitives", "center", kVec3).byDefault("[0, 0, 0]").says("Position, metres."),
        Key("scene.primitives", "rotation", kRotation)
            .withoutIt("none")
            .says("World from local: Euler degrees [x, y, z], or { axis, degrees }."),
        Key("scene.primitives", "normal", kVec3)
            .withoutIt("[0, 0, 1]")
            .says("Plane, in the place of a rotation: turns +z there the short way."),
        Key("scene.primitives", "half_extents", kExtents)
            .above(0)
            .withoutIt("without bounds (plane); required (box)")
            .says("Plane: local x and y; box: all three; metres."),
        Key("scene.primitives", "radius", kNumber)
            .above(0)
            .withoutIt("required (sphere, lens, torus)")
            .says("Sphere; lens: of both its faces; torus: from its middle to the middle of the tube; metres."),
        Key("scene.primitives", "thickness", kNumber)
            .above(0)
            .withoutIt("required (lens)")
            .says("Lens: metres along its axis, at most twice the radius."),
        Key("scene.primitives", "tube_radius", kNumber)
            .above(0)
            .withoutIt("required (torus)")
            .says("Torus: metres, less than the radius."),
        Key("scene.primitives", "wall", kNumber)
            .above(0)
            .withoutIt("none: solid")
            .says("Sphere of glass: metres of glass around air, a bubble; less than the radius."),
        Key("scene.primitives", "pattern", kChoice)
            .oneOf({"solid", "checker", "gradient"})
            .byDefault("\"solid\"")
            .says("Unlit radiance over the surface."),
        Key("scene.primitives", "color", kVec3)
            .atLeast(0)
            .byDefault("[0.8, 0.8, 0.8]")
            .says("Linear RGB; checker: even cells; gradient: the low end."),
        Key("scene.primitives", "color_b", kVec3)
            .atLeast(0)
            .byDefault("[0.2, 0.2, 0.2]")
            .says("Checker: odd cells; gradient: the high end."),
        Key("scene.primitives", "cell_size", kNumber).above(0).byDefault("0.5").says("Checker: metres a cell."),
        Key("scene.primitives", "axis", kChoice)
            .oneOf({"x", "y", "z"})
            .byDefault("\"y\"")
            .says("Gradient: local axis that it runs along."),
        Key("scene.primitives", "material", kChoice)
            .oneOf({"diffuse", "mirror", "glass"})
            .byDefault("\"diffuse\"")
            .says("Reflection is traced by mirrors, refraction by glass."),
        Key("scene.primitives", "ior", kNumber)
            .above(0)
            .atMost(10)
            .withoutIt("that of [material]")
            .says("Glass: index of refraction, for the truth alone."),
        Key("scene.primitives", "object", kInteger)
            .atLeast(0)
            .atMost(65535)
            .byDefault("0")
            .says("Object index in the G-buffer; 0 numbers by order, from 1."),
    };
}

std::vector<KeySpec> rotationKeys()
{
    return {
        Key("rotation", "axis", kVec3).required().says("Axis; any length but 0."),
        Key("rotation", "degrees", kNumber).required().says("Angle, counter-clockwise seen from the axis's tip."),
    };
}

std::vector<KeySpec> gbufferKeys()
{
    const auto channel = [](std::string_view name, std::string_view meaning) {
        return Key("gbuffer.channels", name, kStringList).withoutIt("Blender's name").says(meaning);
    };
    return {
        Key("gbuffer", "file", kString).allowed("an EXR inside the case's folder").required().says("The channels."),
        Key("gbuffer", "camera", kString)
            .allowed("a JSON inside the case's folder")
            .required()
            .says("Camera and primitives."),
        Key("gbuffer", "truth", kString)
            .allowed("an EXR inside the case's folder")
            .withoutIt("none")
            .says("World position + 64 of what each pixel shows; 0 is nothing."),
        Key("gbuffer", "object", kInteger)
            .atLeast(1)
            .atMost(65535)
            .required()
            .says("Object index of the pixels that trace."),
        Key("gbuffer", "channels", kTable).withoutIt("Blender's multilayer names").says("Channel names in the EXR."),
        channel("device_depth", "One channel, 0 to 1."),
        channel("linear_depth", "One channel, metres along the view axis."),
        channel("normal_ws", "Three channels, world space."),
        channel("position_ws", "Three channels, world space, metres."),
        channel("color", "Three channels, linear radiance."),
        channel("object_index", "One channel, 0 where there is no surface."),
    };
}

} // namespace

std::vector<std::string> outputNames()
{
    std::vector<std::string> names;
    for (const OutputInfo& info : allOutputs())
        names.emplace_back(info.name);
    return names;
}

const std::vector<std::string>& backendNames()
{
    static const std::vector<std::string> names{"lavapipe", "swiftshader", "osmesa", "softpipe",
                                                "egl",      "cpu32",       "cpu64",  "vulkan:NAME"};
    return names;
}

std::span<const KeySpec> keySpecs()
{
    static const std::vector<KeySpec> specs = [] {
        std::vector<KeySpec> all;
        for (auto* group : {topKeys, cameraKeys, sceneKeys, rotationKeys, gbufferKeys, materialKeys, projectionKeys,
                            historyKeys, probeKeys, skyKeys, expectKeys, otherKeys}) {
            std::vector<KeySpec> keys = group();
            all.insert(all.end(), std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end()));
        }
        return all;
    }();
    return specs;
}

} // namespace crossray
