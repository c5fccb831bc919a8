// What is traced and what it is held to: [material], [projection], [[expect]], [expand] and [[known_failure]].
#include "harness/case/schema_key.h"

namespace crossray {

using enum KeyType;

std::vector<KeySpec> materialKeys()
{
    return {
        Key("material", "refraction_model", kChoice)
            .oneOf({"none", "sphere", "box", "thin"})
            .byDefault("\"none\"")
            .says("Shape that the light is taken to cross; other than none it implies trace = \"refraction\"."),
        Key("material", "ior", kNumber)
            .above(0)
            .atMost(10)
            .byDefault("1.5")
            .says("Index of refraction of the shader's material."),
        Key("material", "thickness", kNumber)
            .atLeast(0)
            .atMost(1e4)
            .byDefault("1.0")
            .says("Sphere: the diameter; box: the slab; metres."),
        Key("material", "thickness_multiplier", kNumber)
            .atLeast(0)
            .atMost(1e4)
            .byDefault("1.0")
            .says("Factor on the thickness."),
        Key("material", "thickness_map", kTable)
            .withoutIt("none")
            .says("Thickness by the place on screen, in the place of thickness; the multiplier counts."),
        Key("material", "roughness", kNumber)
            .atLeast(0)
            .atMost(2)
            .byDefault("0.0")
            .says("Perceptual roughness; chooses the colour's mip level."),
        Key("material", "transmittance_color", kVec3)
            .atLeast(0)
            .atMost(65504)
            .byDefault("[1, 1, 1]")
            .says("Colour that white light has after absorption_distance; above 1 it counts as 1."),
        Key("material", "absorption_distance", kNumber)
            .atLeast(0)
            .atMost(65504)
            .byDefault("1.0")
            .says("Metres inside after which white light has transmittance_color; below 1e-5 it counts as that."),
        Key("material", "fresnel", kChoice)
            .oneOf({"none", "exact", "schlick"})
            .byDefault("\"none\"")
            .says("What the refracting surface reflects and takes off Color: nothing, Fresnel's share, or Schlick's."),
        Key("material.thickness_map", "from", kNumber)
            .atLeast(0)
            .atMost(1e4)
            .withoutIt("file or from and to are required")
            .says("Gradient: metres at the image's left or top border."),
        Key("material.thickness_map", "to", kNumber)
            .atLeast(0)
            .atMost(1e4)
            .withoutIt("file or from and to are required")
            .says("Gradient: metres at the opposite border."),
        Key("material.thickness_map", "axis", kChoice)
            .oneOf({"x", "y"})
            .byDefault("\"x\"")
            .says("Gradient: from left to right, or from top to bottom."),
        Key("material.thickness_map", "file", kString)
            .allowed("an EXR inside the case's folder")
            .withoutIt("file or from and to are required")
            .says("One channel of the image's size, metres."),
    };
}

std::vector<KeySpec> projectionKeys()
{
    return {
        Key("projection", "model", kChoice)
            .oneOf({"none", "proxy_infinite", "proxy_box", "proxy_sphere", "hiz", "linear", "patches", "proxy_probe",
                    "own"})
            .byDefault("\"none\"")
            .says("What the ray is projected on; none computes the ray alone, proxy_probe takes the proxy of the first "
                  "[[probe]] "
                  "that counts at the pixel, else the infinite one; own is the tracer of your own in tracer."),
        Key("projection", "tracer", kString)
            .allowed("a GLSL file inside the case's folder")
            .withoutIt("required by own")
            .says("Own: the file that defines traceOwn (docs/own-tracer.md); not for cpu32 and cpu64."),
        Key("projection", "proxy", kTable)
            .withoutIt("required by proxy_box and proxy_sphere")
            .says("The proxy volume."),
        Key("projection", "linear", kTable).withoutIt("all defaults").says("Settings of the linear march."),
        Key("projection", "min_level", kInteger)
            .atLeast(0)
            .atMost(14)
            .byDefault("2")
            .says("HiZ: finest pyramid level that the march reads."),
        Key("projection", "max_level", kInteger)
            .atLeast(0)
            .atMost(14)
            .withoutIt("6; patches: 14")
            .says("Coarsest level; not below min_level; beyond the pyramid's last it is the last."),
        Key("projection", "max_iterations", kInteger)
            .atLeast(1)
            .atMost(65535)
            .withoutIt("32; patches: 512; own: 2048")
            .says("Steps after which the answer is unknown."),
        Key("projection", "depth_bias", kNumber)
            .atLeast(0)
            .atMost(1e6)
            .byDefault("1.0")
            .says("HiZ: thickness of what the depth buffer shows, metres; own: handed on."),
        Key("projection", "caution", kNumber)
            .atLeast(0)
            .atMost(1e6)
            .byDefault("0.4")
            .says("Patches: clearance that a hidden ray needs to have passed behind what hid it; 0 is greedy."),
        Key("projection", "depth_error", kNumber)
            .atLeast(0)
            .atMost(1)
            .byDefault("0.0")
            .says("Patches: affine depth by which the depth buffer may be wrong, 1/m."),
        Key("projection", "screen_weight_distance", kNumber)
            .atLeast(0)
            .atMost(1)
            .byDefault("0.1")
            .says("Width of the fade at each border, as a share of the screen; 0 is no fade."),
        Key("projection", "screen_weight_form", kChoice)
            .oneOf({"linear", "smooth_2018", "smooth_today"})
            .byDefault("\"smooth_2018\"")
            .says("Linear ramp, smoothed ramp, or smoothed ramp of half the width."),
        Key("projection.proxy", "center", kVec3).byDefault("[0, 0, 0]").says("World space, metres."),
        Key("projection.proxy", "half_extents", kVec3)
            .above(0)
            .withoutIt("required by proxy_box")
            .says("Along the proxy's own axes, metres."),
        Key("projection.proxy", "radius", kNumber).above(0).withoutIt("required by proxy_sphere").says("Metres."),
        Key("projection.proxy", "rotation", kRotation)
            .withoutIt("none")
            .says("World from proxy: Euler degrees [x, y, z], or { axis, degrees }."),
        Key("projection.linear", "stride", kNumber)
            .above(0)
            .atMost(16384)
            .byDefault("4.0")
            .says("Pixels between samples along the longer axis, where steps is 0."),
        Key("projection.linear", "steps", kInteger)
            .atLeast(0)
            .atMost(65535)
            .byDefault("0")
            .says("Equal parts into which the way to the image's border is cut; 0: by stride."),
        Key("projection.linear", "max_iterations", kInteger)
            .atLeast(1)
            .atMost(65535)
            .byDefault("256")
            .says("Samples and halvings after which the answer is unknown."),
        Key("projection.linear", "depth_bias", kNumber)
            .atLeast(0)
            .atMost(1e6)
            .byDefault("1.0")
            .says("Thickness of what the depth buffer shows, metres."),
        Key("projection.linear", "bisections", kInteger)
            .atLeast(0)
            .atMost(32)
            .byDefault("0")
            .says("Halvings of the stretch in which the ray crossed a surface."),
    };
}

std::vector<KeySpec> historyKeys()
{
    return {
        Key("history", "eye", kVec3).withoutIt("that of [camera]").says("Position of the previous camera."),
        Key("history", "target", kVec3).withoutIt("that of [camera]").says("What it looked at."),
        Key("history", "up", kVec3).withoutIt("that of [camera]").says("Direction that was up."),
        Key("history", "fov", kNumber)
            .above(0)
            .below(180)
            .withoutIt("that of [camera]")
            .says("Its vertical field of view in degrees, perspective."),
        Key("history", "height", kNumber)
            .above(0)
            .withoutIt("that of [camera]")
            .says("Its metres from bottom to top, orthographic."),
        Key("history", "reprojection", kChoice)
            .oneOf({"motion_vectors", "previous_view_projection"})
            .byDefault("\"motion_vectors\"")
            .says("How a hit is found in the previous frame: by the motion vector at it, or by the previous camera."),
        Key("history", "levels", kInteger)
            .atLeast(0)
            .atMost(15)
            .byDefault("0")
            .says("Levels of the colour pyramid that roughness is spread over, from the finest; 0: all."),
        Key("history", "poison", kChoice)
            .oneOf({"none", "nan", "infinity", "negative"})
            .byDefault("\"none\"")
            .says("What broken pixels of the previous frame hold."),
        Key("history", "poison_every", kInteger)
            .atLeast(1)
            .atMost(16384)
            .byDefault("8")
            .says("One pixel of so many is broken, both ways; 1: all are."),
        Key("history", "moved", kTableList).byDefault("[]").says("Primitives that moved since the previous frame."),
        Key("history.moved", "primitive", kInteger)
            .atLeast(0)
            .atMost(65535)
            .required()
            .says("Number of the primitive in the scene, from 0."),
        Key("history.moved", "by", kVec3).required().says("Metres from the previous frame to this one."),
    };
}

std::vector<KeySpec> expectKeys()
{
    return {
        Key("expect", "output", kChoice)
            .oneOf(outputNames())
            .withoutIt("required; finite: every output of the case")
            .says("The output that is held to something."),
        Key("expect", "analytic", kString).withoutIt("one source is required").says("Source: a closed form, by name."),
        Key("expect", "truth", kString)
            .withoutIt("one source is required")
            .says("Source: a quantity of the ray caster, or of the recorded truth."),
        Key("expect", "constant", kConstant)
            .allowed("a number a channel; HitSuccess: no_raycast, hit, miss, unknown")
            .withoutIt("one source is required")
            .says("Source: one value for every compared pixel."),
        Key("expect", "golden", kString)
            .allowed("an EXR inside the case's folder")
            .withoutIt("one source is required")
            .says("Source: a recorded file; `review --accept` alone writes it."),
        Key("expect", "agree", kChoiceList)
            .oneOf(backendNames())
            .allowed("two names or more")
            .withoutIt("one source is required")
            .says("Source: these backends, each against the last."),
        Key("expect", "at_most", kNumber)
            .withoutIt("one source is required")
            .says(
                "Source: a bound; every value is a number that does not exceed it. Depths, colours, scalars, counts."),
        Key("expect", "finite", kBoolean)
            .allowed("true")
            .withoutIt("one source is required")
            .says("Source: every value is a number of single precision: neither NaN nor infinite."),
        Key("expect", "tolerance", kTableOrPreset)
            .withoutIt("required, but for HitSuccess and counts: exact; at_most and finite have none")
            .says("Bounds of a pixel's error; a name is [tolerance.NAME] of presets.toml."),
        Key("expect", "budget", kTable)
            .withoutIt("none")
            .says("HitSuccess against the truth, by shares; replaces a pixel by pixel comparison."),
        Key("expect", "undecidable", kNumber)
            .above(0)
            .atMost(0.5)
            .withoutIt("none")
            .says(
                "Share of the compared pixels that may be beyond the tolerance where the answer is undecidable: an ulp "
                "of input becomes more than undecidable_above ulps of this output."),
        Key("expect", "undecidable_above", kNumber)
            .atLeast(16)
            .byDefault("1024")
            .says("Output ulps for an input ulp above which a pixel is undecidable; needs undecidable."),
        Key("expect", "where", kChoice)
            .oneOf({"traced", "all", "answerable", "answerable_hits", "hits"})
            .withoutIt("\"traced\"; finite: \"all\"")
            .says("Pixels that are compared: those that trace; every one; those whose hit the screen could have known; "
                  "of these or of all those that say hit."),
        Key("expect", "backends", kChoiceList)
            .oneOf(backendNames())
            .withoutIt("all")
            .says("The only backends that are held to it."),
        Key("expect.tolerance", "degrees", kNumber)
            .atLeast(0)
            .atMost(180)
            .withoutIt("no bound")
            .says("Directions: angle between the two."),
        Key("expect.tolerance", "relative", kNumber)
            .atLeast(0)
            .withoutIt("no bound")
            .says("Share of the expected magnitude."),
        Key("expect.tolerance", "absolute", kNumber)
            .atLeast(0)
            .withoutIt("no bound")
            .says("Difference in the output's own unit."),
        Key("expect.tolerance", "ulps", kNumber)
            .atLeast(0)
            .withoutIt("no bound")
            .says("Units in the last place of a float."),
        Key("expect.tolerance", "floor", kNumber)
            .atLeast(0)
            .byDefault("0.0")
            .says("Magnitude below which both values count as zero."),
        Key("expect.tolerance", "double", kBoolean).byDefault("false").says("Measures ulps in doubles."),
        Key("expect.tolerance", "outliers", kNumber)
            .atLeast(0)
            .atMost(1)
            .byDefault("0.0")
            .says("Share of the compared pixels that may lie beyond the bounds; needs worst."),
        Key("expect.tolerance", "worst", kNumber)
            .atLeast(0)
            .withoutIt("none")
            .says("Bound of each outlier: degrees, relative error (depths), or absolute error; needs outliers."),
        Key("expect.budget", "recall", kNumber)
            .atLeast(0)
            .atMost(1)
            .withoutIt("no bound")
            .says("Least share of the answerable rays whose hit is right."),
        Key("expect.budget", "precision", kNumber)
            .atLeast(0)
            .atMost(1)
            .withoutIt("no bound")
            .says("Least share of the claimed hits that are right."),
        Key("expect.budget", "false_hits", kNumber)
            .atLeast(0)
            .atMost(1)
            .withoutIt("no bound")
            .says("Largest share of the unanswerable rays that claim a hit."),
        Key("expect.budget", "position_px", kNumber)
            .above(0)
            .byDefault("2.0")
            .says("Distance on screen within which a hit is right."),
    };
}

std::vector<KeySpec> otherKeys()
{
    return {
        Key("expand", "TABLE.KEY", kExpansion)
            .allowed("values of that key")
            .withoutIt("none")
            .says("Dotted path of a key, such as material.ior or scene.primitives.0.radius; several make the product."),
        Key("known_failure", "backends", kChoiceList)
            .oneOf(backendNames())
            .withoutIt("all")
            .says("Backends that may fail."),
        Key("known_failure", "issue", kString).allowed("not empty").required().says("Link or number of the report."),
        Key("known_failure", "until", kDate)
            .allowed("YYYY-MM-DD")
            .required()
            .says("Last day on which the failure is excused."),
        Key("known_failure", "reason", kString).allowed("not empty").required().says("Why it fails."),
    };
}

} // namespace crossray
