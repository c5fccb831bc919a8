#include "harness/pass/pass.h"

#include "harness/backend/cpu/cpu_device.h"
#include "harness/pass/params.h"
#include "tests/unit/pass/floor_case.h"

#include <gtest/gtest.h>

using namespace crossray;

TEST(Pass, aRayAloneNeedsOneDispatchAndNoPyramid)
{
    const Job job = makeJob(makeFloorCase({"RayDirWS"}), Precision::kFloat);
    EXPECT_EQ(job.dispatches.size(), 1u);
    EXPECT_EQ(job.programs.size(), 1u);
    EXPECT_EQ(job.readbacks.size(), 1u);
    EXPECT_EQ(job.dispatches[0].groupsX, 5u); // ceil(37 / 8)
    EXPECT_EQ(job.dispatches[0].groupsY, 3u);
}

TEST(Pass, hizBuildsEachLevelDownToOneCell)
{
    Case testCase = makeFloorCase({"HitSuccess"});
    testCase.projection.model = ProjectionModel::kHiz;
    const Job job = makeJob(testCase, Precision::kFloat);
    // 37x23, 18x11, 9x5, 4x2, 2x1, 1x1 and the trace
    EXPECT_EQ(job.dispatches.size(), 7u);
}

TEST(Pass, planesBuildFourLevelsAtOnce)
{
    Case testCase = makeFloorCase({"HitSuccess"});
    testCase.projection.model = ProjectionModel::kPatches;
    const Job job = makeJob(testCase, Precision::kFloat);
    // 37x23, 18x11, 9x5, 4x2; 2x1, 1x1; the trace
    EXPECT_EQ(job.dispatches.size(), 3u);
    EXPECT_EQ(job.dispatches[0].groupsX, 1u); // 4x2 cells with all below them
}

TEST(Pass, aVariantCarriesOnlyWhatItUses)
{
    const Job ray = makeJob(makeFloorCase({"RayDirWS"}), Precision::kFloat);
    Case hiz = makeFloorCase({"RayDirWS", "HitSuccess", "HitDepth"});
    hiz.projection.model = ProjectionModel::kHiz;
    const Job traced = makeJob(hiz, Precision::kFloat);
    EXPECT_LT(ShaderCompiler::countInstructions(ray.programs[0].spirv) * 2,
              ShaderCompiler::countInstructions(traced.programs[1].spirv));
}

TEST(Pass, planesComeBackInTheOrderOfTheCase)
{
    // The order differs from that of the output ids, in which the device stores them.
    const Case testCase = makeFloorCase({"RayOriginWS", "RayDirWS", "TracingModel"});
    for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
        const Job job = makeJob(testCase, precision);
        const std::vector<Plane> planes = readPlanes(testCase, makeCpuDevice(precision)->run(job));
        ASSERT_EQ(planes.size(), 3u);
        EXPECT_EQ(planes[0].name, "RayOriginWS");
        EXPECT_EQ(planes[0].channels, 3);
        // Bottom row: the floor, y = 0; its mirror ray goes up and away.
        EXPECT_NEAR(planes[0].at(18, 22, 1), 0.0, 1e-5);
        EXPECT_GT(planes[1].at(18, 22, 1), 0.1);
        EXPECT_LT(planes[1].at(18, 22, 2), -0.1);
        EXPECT_EQ(planes[2].at(18, 22), 0.0);
        // Top row: the wall, which traces no ray.
        EXPECT_EQ(planes[1].at(18, 0, 1), 0.0);
    }
}

TEST(Pass, doubleParametersKeepTheirBits)
{
    Case testCase = makeFloorCase({"RayDirWS"});
    testCase.material.ior = 1.0 / 3.0;
    const Job job = makeJob(testCase, Precision::kDouble);
    layout64::PassParams params{};
    for (const BufferDesc& buffer : job.buffers) {
        if (buffer.bytes.size() == sizeof(params))
            std::memcpy(static_cast<void*>(&params), buffer.bytes.data(), sizeof(params));
    }
    EXPECT_EQ(params.material.x, 1.0 / 3.0);
}

TEST(Pass, aShortAnswerOfTheDeviceIsAnError)
{
    const Case testCase = makeFloorCase({"RayDirWS"});
    JobResult result;
    result.readbacks.push_back(std::vector<double>(7));
    EXPECT_THROW(readPlanes(testCase, result), EnvironmentError);
}
