#include "harness/pass/moved_inputs.h"

#include "harness/pass/bindings.h"
#include "harness/pass/params.h"
#include "harness/pass/pass.h"
#include "tests/unit/pass/floor_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace crossray;

namespace {

const ImageDesc& imageOf(const Job& job, uint32_t number)
{
    for (const Binding& binding : job.dispatches.back().bindings) {
        if (binding.what == Binding::What::kImage && binding.binding == static_cast<uint32_t>(number))
            return job.images[binding.index];
    }
    throw std::runtime_error("no such image");
}

layout32::PassParams paramsOf(const Job& job)
{
    for (const Binding& binding : job.dispatches.back().bindings) {
        if (binding.what != Binding::What::kBuffer || binding.binding != static_cast<uint32_t>(kParamsBinding))
            continue;
        layout32::PassParams params;
        std::memcpy(&params, job.buffers[binding.index].bytes.data(), sizeof(params));
        return params;
    }
    throw std::runtime_error("no parameters");
}

} // namespace

TEST(MovedInputs, spacingIsThatOfFloats)
{
    EXPECT_EQ(floatSpacing(1.0), std::ldexp(1.0, -23));
    EXPECT_EQ(floatSpacing(-1.5), std::ldexp(1.0, -23));
    EXPECT_EQ(floatSpacing(0.1), std::ldexp(1.0, -27));
    EXPECT_EQ(floatSpacing(0.0), 0.0);
    EXPECT_EQ(floatSpacing(std::numeric_limits<double>::infinity()), 0.0);
    EXPECT_EQ(floatSpacing(std::nan("")), 0.0);
}

TEST(MovedInputs, eachMovesByOneUlpAndTheOthersStay)
{
    const Case testCase = makeFloorCase({"RayDirWS", "HitDepth"});
    const Job job = makeJob(testCase, Precision::kFloat);
    const Job moved = moveInputs(testCase, job, Precision::kFloat, {InputGroup::kDepth, 1, false});
    const Job opposite = moveInputs(testCase, job, Precision::kFloat, {InputGroup::kDepth, 1, true});
    int up = 0, down = 0;
    for (size_t i = 0; i < imageOf(job, kDepthBinding).texels.size(); ++i) {
        const double before = imageOf(job, kDepthBinding).texels[i], after = imageOf(moved, kDepthBinding).texels[i];
        EXPECT_EQ(std::fabs(after - before), floatSpacing(before));
        EXPECT_EQ(after - before, before - imageOf(opposite, kDepthBinding).texels[i]);
        up += after > before ? 1 : 0;
        down += after < before ? 1 : 0;
    }
    EXPECT_GT(up, 100); // by a hash: about as many as
    EXPECT_GT(down, 100);
    EXPECT_EQ(imageOf(moved, kNormalBinding).texels, imageOf(job, kNormalBinding).texels);
    EXPECT_EQ(paramsOf(moved).viewFromWorld, paramsOf(job).viewFromWorld);
}

TEST(MovedInputs, theWholeCameraMovesAndNoSizeOrCount)
{
    const Case testCase = makeFloorCase({"RayDirWS", "HitDepth"});
    const Job job = makeJob(testCase, Precision::kFloat);
    const auto before = paramsOf(job);
    const auto after = paramsOf(moveInputs(testCase, job, Precision::kFloat, {InputGroup::kCamera, 0, false}));
    EXPECT_NE(after.viewFromWorld[1], before.viewFromWorld[1]);
    EXPECT_NE(after.worldFromView[3], before.worldFromView[3]);
    EXPECT_EQ(after.imageSizeAndSlope.x, before.imageSizeAndSlope.x);
    EXPECT_EQ(after.imageSizeAndSlope.w, std::nextafter(before.imageSizeAndSlope.w, 1e9F));
    EXPECT_EQ(after.depthTerms.z, std::nextafter(before.depthTerms.z, 1e9F));
    EXPECT_EQ(after.hizLimits, before.hizLimits);
    EXPECT_EQ(after.material, before.material);
    const auto settings = paramsOf(moveInputs(testCase, job, Precision::kFloat, {InputGroup::kSettings, 0, true}));
    EXPECT_EQ(settings.viewFromWorld, before.viewFromWorld);
    EXPECT_EQ(settings.material.x, std::nextafter(before.material.x, 0.0F));
    EXPECT_EQ(settings.linearLimits, before.linearLimits);
}

TEST(MovedInputs, aClearedDepthStaysWhatItIs)
{
    Case testCase = makeFloorCase({"RayDirWS", "HitDepth"});
    testCase.scene.primitives.resize(1); // sky above the floor
    testCase.camera.depthConvention = DepthConvention::kStandard;
    const Job job = makeJob(testCase, Precision::kFloat);
    const Job moved = moveInputs(testCase, job, Precision::kFloat, {InputGroup::kAll, 0, true});
    int cleared = 0;
    for (size_t i = 0; i < imageOf(job, kDepthBinding).texels.size(); ++i) {
        if (imageOf(job, kDepthBinding).texels[i] != 1.0) continue;
        ++cleared;
        EXPECT_EQ(imageOf(moved, kDepthBinding).texels[i], 1.0);
    }
    EXPECT_GT(cleared, 50);
}

TEST(MovedInputs, everyPassReadsTheSameCamera)
{
    Case testCase = makeFloorCase({"HitSuccess"});
    testCase.projection.model = ProjectionModel::kPatches;
    const Job job = makeJob(testCase, Precision::kFloat);
    const Job moved = moveInputs(testCase, job, Precision::kFloat, {InputGroup::kCamera, 3, false});
    layout32::SurfaceParams surface;
    for (const Binding& binding : moved.dispatches.front().bindings) {
        if (binding.what == Binding::What::kBuffer && binding.binding == static_cast<uint32_t>(kParamsBinding))
            std::memcpy(&surface, moved.buffers[binding.index].bytes.data(), sizeof(surface));
    }
    EXPECT_EQ(surface.depthTerms, paramsOf(moved).depthTerms);
    EXPECT_EQ(surface.viewFromWorld, paramsOf(moved).viewFromWorld);
    EXPECT_NE(surface.viewFromWorld, paramsOf(job).viewFromWorld);
}

TEST(MovedInputs, groupsAreThoseOfTheCase)
{
    Case testCase = makeFloorCase({"HitSuccess"});
    const auto has = [&](InputGroup group) {
        const std::vector<InputMove> moves = listInputMoves(testCase);
        return std::any_of(moves.begin(), moves.end(), [&](const InputMove& move) { return move.group == group; });
    };
    EXPECT_TRUE(has(InputGroup::kDepth) && has(InputGroup::kNormal) && has(InputGroup::kCamera));
    EXPECT_TRUE(has(InputGroup::kSettings) && has(InputGroup::kAll));
    EXPECT_FALSE(has(InputGroup::kProbes) || has(InputGroup::kHistory));
    testCase.probes.emplace_back();
    testCase.history.emplace();
    EXPECT_TRUE(has(InputGroup::kProbes) && has(InputGroup::kHistory));
}
