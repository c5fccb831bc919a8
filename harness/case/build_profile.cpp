// probe_profile and [profile]: the Built-in and the URP profile, and what of a probe each profile has no use for.
#include "harness/case/build.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace crossray {

namespace {

// Keys that the profile does not read would be taken as if they counted.
void refuseKeys(const TableReader& table, const std::string& profile, std::initializer_list<std::string_view> keys)
{
    for (const std::string_view key : keys) {
        if (!table.has(key)) continue;
        throw InputError(table.position(key),
                         fmt::format("\"{}\" is not allowed where \"probe_profile\" is \"{}\"", key, profile));
    }
}

// These pipelines know one volume a probe: a box along the axes of the world, with one blend distance.
void checkBoxProbe(const Node& node, const std::string& profile)
{
    const TableReader probe(&node, "probe");
    refuseKeys(probe, profile, {"proxy", "weight", "distance_based_roughness", "mirror"});
    const TableReader influence = probe.table("influence");
    if (influence.text("shape") != "box") {
        throw InputError(influence.position("shape"),
                         fmt::format("\"shape\" is \"{}\"; box is allowed where \"probe_profile\" is \"{}\"",
                                     influence.text("shape"), profile));
    }
    refuseKeys(influence, profile,
               {"rotation", "blend_positive", "blend_negative", "blend_normal", "blend_normal_positive",
                "blend_normal_negative", "face_positive", "face_negative"});
}

// The object whose bounds choose the probes is all that traces: it must have an end.
void checkObject(const TableReader& top, const Case& testCase)
{
    if (testCase.recorded) {
        throw InputError(top.position("probe_profile"),
                         "\"probe_profile\" chooses probes by an object's bounds, which a recorded G-buffer does not "
                         "have; hdrp is allowed beside [gbuffer]");
    }
    const std::string traced = testCase.effect == TraceEffect::kRefraction ? "glass" : "mirror";
    for (const Primitive& primitive : testCase.scene.primitives) {
        const bool isEndless = primitive.shape == PrimitiveShape::kPlane &&
                               !(std::isfinite(primitive.halfExtents.x) && std::isfinite(primitive.halfExtents.y));
        if (primitive.material != traced || !isEndless) continue;
        throw InputError(top.position("probe_profile"),
                         fmt::format("\"probe_profile\" chooses probes by the object's bounds, and a plane of {} has "
                                     "none; one with half_extents is allowed",
                                     traced));
    }
}

} // namespace

void buildProfile(const TableReader& top, Case& testCase)
{
    testCase.probeProfile = static_cast<ProbeProfile>(top.choice("probe_profile"));
    const std::string& name = top.text("probe_profile");
    if (testCase.probeProfile == ProbeProfile::kHdrp) {
        refuseKeys(top, name, {"profile"});
        for (const Node& node : top.find("probe")->items)
            refuseKeys(TableReader(&node, "probe"), name, {"box_projection", "rgbm"});
        return;
    }
    refuseKeys(top, name, {"dominant_direction"});
    for (const Probe& probe : testCase.probes) {
        if (probe.kind == ProbeKind::kPlanar)
            throw InputError(top.position("probe_profile"),
                             fmt::format("\"probe_profile\" is \"{}\" and a probe is planar; hdrp is allowed", name));
    }
    for (const Node& node : top.find("probe")->items)
        checkBoxProbe(node, name);
    checkObject(top, testCase);
    const TableReader table = top.table("profile");
    if (testCase.probeProfile != ProbeProfile::kUrpUnity) refuseKeys(table, name, {"forward_plus", "half_precision"});
    ProfileSettings& profile = testCase.profile;
    profile.blending = table.boolean("blending");
    profile.boxProjection = table.boolean("box_projection");
    profile.boxProjectionForm = static_cast<BoxProjectionForm>(table.choice("box_projection_form"));
    profile.forwardPlus = table.boolean("forward_plus");
    profile.halfPrecision = table.boolean("half_precision");
    profile.exactMip = table.text("roughness_mip") == "exact";
    profile.gammaSpace = table.text("color_space") == "gamma";
}

} // namespace crossray
