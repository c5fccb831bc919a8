// Model no more than a scene needs: what a variant does not use is not in its SPIR-V, and what it reads is counted
// there.
#include "harness/case/case.h"
#include "harness/compile/spirv_module.h"
#include "harness/pass/bindings.h"
#include "harness/pass/pass.h"
#include "harness/scene/capture.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

const fs::path kSource = CROSSRAY_SOURCE_DIR;

struct Cost {
    size_t instructions = 0;
    std::map<uint32_t, int> fetches; // by binding
    int loops = 0;
    std::set<uint32_t> bindings;
    int variables = 0; // of the invocation, outside its functions
};

// Opcodes and decorations by the SPIR-V specification, version 1.3.
Cost measure(const std::vector<uint32_t>& spirv)
{
    constexpr uint32_t kOpVariable = 59, kPrivate = 6, kOpLoad = 61, kOpDecorate = 71, kOpImageFetch = 95,
                       kOpImage = 100, kOpLoopMerge = 246;
    constexpr uint32_t kBinding = 33;
    Cost cost;
    std::map<uint32_t, uint32_t> bindingOf; // of a variable, and of what is loaded from it
    forEachSpirvInstruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> operands) {
        ++cost.instructions;
        if (opcode == kOpDecorate && operands[1] == kBinding) {
            bindingOf[operands[0]] = operands[2];
            cost.bindings.insert(operands[2]);
        }
        const bool passesOn = opcode == kOpLoad || opcode == kOpImage;
        if (passesOn && bindingOf.contains(operands[2])) bindingOf[operands[1]] = bindingOf[operands[2]];
        if (opcode == kOpImageFetch) ++cost.fetches[bindingOf.at(operands[2])];
        if (opcode == kOpLoopMerge) ++cost.loops;
        if (opcode == kOpVariable && operands[2] == kPrivate) ++cost.variables;
    });
    return cost;
}

Cost costOfTrace(const std::string& name)
{
    ShaderCompiler compiler({});
    const CaseData data(readCaseFile(kSource / "cases" / (name + ".toml")).at(0));
    return measure(buildJob(data, compiler, kSource / "shaders", Precision::kFloat).programs.back().spirv);
}

} // namespace

TEST(Cost, aProxyReadsOneDepthAndHasNoLoop)
{
    for (const char* name : {"reflection/proxy_infinite", "reflection/proxy_error_is_the_distance",
                             "reflection/proxy_sphere_from_outside"}) {
        const Cost cost = costOfTrace(name);
        EXPECT_EQ(cost.fetches.at(kDepthBinding), 1) << name;
        EXPECT_EQ(cost.fetches.at(kNormalBinding), 1) << name;
        EXPECT_EQ(cost.loops, 0) << name;
        EXPECT_FALSE(cost.bindings.contains(kPyramidBinding)) << name;
        EXPECT_FALSE(cost.bindings.contains(kColorBinding)) << name;
    }
}

TEST(Cost, aMarchIsALoopOverThePyramid)
{
    const Cost cost = costOfTrace("reflection/hiz_sky");
    EXPECT_EQ(cost.fetches.at(kDepthBinding), 1);
    EXPECT_GE(cost.loops, 1);
    EXPECT_TRUE(cost.bindings.contains(kPyramidBinding));
}

TEST(Cost, theColourIsReadWhereItIsAskedForAlone)
{
    EXPECT_TRUE(costOfTrace("reflection/hiz_colour").bindings.contains(kColorBinding));
    EXPECT_FALSE(costOfTrace("reflection/hiz_sky").bindings.contains(kColorBinding));
}

TEST(Cost, growsWithTheModel)
{
    const size_t ray = costOfTrace("reflection/ray_plane").instructions;
    const size_t infinite = costOfTrace("reflection/proxy_infinite").instructions;
    const size_t box = costOfTrace("reflection/proxy_error_is_the_distance").instructions;
    const size_t hiz = costOfTrace("reflection/hiz_sky").instructions;
    EXPECT_LT(ray, infinite);
    EXPECT_LT(infinite, box);
    EXPECT_LT(box, hiz);
    const size_t none = costOfTrace("refraction/none_goes_straight").instructions;
    const size_t slab = costOfTrace("refraction/box_true_slab").instructions;
    const size_t sphere = costOfTrace("refraction/sphere_depth_conventions").instructions;
    EXPECT_LT(none, slab);
    EXPECT_LT(slab, sphere);
}

TEST(Cost, probesAreReadWhereTheyAreAskedForAlone)
{
    const Cost with = costOfTrace("probe/backends_agree");
    EXPECT_TRUE(with.bindings.contains(kProbeParamsBinding));
    EXPECT_EQ(with.fetches.at(kProbeAtlasBinding), 1); // in a loop over the footprint
    const Cost without = costOfTrace("reflection/hiz_sky");
    EXPECT_FALSE(without.bindings.contains(kProbeParamsBinding));
    EXPECT_FALSE(without.bindings.contains(kProbeAtlasBinding));
}

TEST(Cost, aProfileHasTheCodeThatItNeeds)
{
    const Cost builtIn = costOfTrace("probe/builtin_two_probes");
    EXPECT_EQ(builtIn.fetches.at(kProbeAtlasBinding), 1); // in a loop over probes and footprint
    EXPECT_EQ(builtIn.loops, 3);                          // with the one that chooses the object's pair
    EXPECT_EQ(costOfTrace("probe/urp_forward").loops, 3);
    EXPECT_EQ(costOfTrace("probe/urp_forward_plus").loops, 3); // no pair; who comes before, for each probe
    const size_t along = costOfTrace("probe/profile_box_projection_switched_off").instructions;
    EXPECT_LT(along, costOfTrace("probe/urp_weighs_per_pixel").instructions); // the sky, and box projection
}

// The documents call refraction from the screen and from baked probes cheap, and captures at run time dear with their
// resolution. In what is counted: a baked probe and a real-time one are the same shader with the same reads, and the
// latter adds a ray a texel of all six faces, at each run.
TEST(Cost, aRealtimeCaptureCastsARayATexelAndABakedOneNone)
{
    const Cost baked = costOfTrace("capture/baked");
    const Cost realtime = costOfTrace("capture/realtime");
    EXPECT_EQ(baked.instructions, realtime.instructions);
    EXPECT_EQ(baked.fetches, realtime.fetches);

    const auto capturedTexels = [](int size) {
        CaptureSettings settings;
        settings.size = size;
        const Cubemap cubemap = captureCubemap(Scene{}, settings);
        return static_cast<size_t>(kCubeFaces) * static_cast<size_t>(cubemap.size) * static_cast<size_t>(cubemap.size);
    };
    EXPECT_EQ(capturedTexels(16), 6u * 16u * 16u);
    EXPECT_EQ(capturedTexels(256) / capturedTexels(16), 256u); // sixteen times the side
}

// A person's own tracer has the variables and the buffer that watch over it; nobody else has.
TEST(Cost, aTracerOfOnesOwnCostsTheOthersNothing)
{
    const Cost own = costOfTrace("own/pixel_walk");
    EXPECT_TRUE(own.bindings.contains(kOwnStatusBinding));
    EXPECT_FALSE(own.bindings.contains(kPyramidBinding)); // it does not ask for it
    EXPECT_TRUE(costOfTrace("own/interface").bindings.contains(kPyramidBinding));
    for (const char* name : {"reflection/ray_plane", "reflection/proxy_infinite", "reflection/hiz_sky",
                             "reflection/linear_mirror_floor", "reflection/patches_sky", "probe/backends_agree"}) {
        const Cost cost = costOfTrace(name);
        EXPECT_FALSE(cost.bindings.contains(kOwnStatusBinding)) << name;
        EXPECT_EQ(cost.variables, 0) << name << ": reads are counted where the output is asked for alone";
    }
}
