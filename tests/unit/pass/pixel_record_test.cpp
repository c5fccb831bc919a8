// The record of a pixel says what the planes say, and each step what the depth buffer holds; a release has none of it.
#include "harness/pass/pixel_record.h"

#include "harness/backend/cpu/cpu_device.h"
#include "harness/base/temporary_folder.h"
#include "tests/unit/pass/floor_case.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

// One cache for all jobs of the tests.
ShaderCompiler& sharedCompiler()
{
    static ShaderCompiler compiler(fs::absolute("pixel-record-cache"));
    return compiler;
}

// The floor with every output that the record holds too.
Case makeRecordedCase(ProjectionModel model)
{
    Case testCase = makeFloorCase({"RayDirWS", "RayOriginWS", "HitSuccess", "HitReason", "HitDepth", "TracingModel",
                                   "IterationCount", "MaxUsedMipLevel", "IntersectionKind", "HitWeight", "SampledColor",
                                   "Confidence"});
    testCase.projection.model = model;
    testCase.projection.hiz = {0, 6, 256, 0.25};
    testCase.projection.proxy.halfExtents = {6, 6, 6};
    return testCase;
}

PixelRecord recordPixel(const CaseData& data, Precision precision, glm::ivec2 pixel, int capacity = kMostRecordedSteps)
{
    const Job job = buildRecordJob(data, sharedCompiler(), kShaders, precision, pixel, capacity);
    return readRecord(pixel, makeCpuDevice(precision)->run(job));
}

std::map<std::string, Plane> runPlanes(const CaseData& data, Precision precision)
{
    const Job job = buildJob(data, sharedCompiler(), kShaders, precision);
    std::map<std::string, Plane> planes;
    for (Plane& plane : readPlanes(data.testCase(), makeCpuDevice(precision)->run(job))) {
        const std::string name = plane.name;
        planes.emplace(name, std::move(plane));
    }
    return planes;
}

void expectAgreement(const PixelRecord& record, const std::map<std::string, Plane>& planes)
{
    const int x = record.pixel.x, y = record.pixel.y;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(record.dirWS[axis], planes.at("RayDirWS").at(x, y, axis));
        EXPECT_EQ(record.originWS[axis], planes.at("RayOriginWS").at(x, y, axis));
        EXPECT_EQ(record.sampledColor[axis], planes.at("SampledColor").at(x, y, axis));
    }
    EXPECT_EQ(static_cast<double>(record.hitClass), planes.at("HitSuccess").at(x, y));
    EXPECT_EQ(record.reason, planes.at("HitReason").at(x, y));
    EXPECT_EQ(record.endDepth, planes.at("HitDepth").at(x, y));
    EXPECT_EQ(static_cast<double>(record.model), planes.at("TracingModel").at(x, y));
    EXPECT_EQ(record.iterations, planes.at("IterationCount").at(x, y));
    EXPECT_EQ(record.maxUsedLevel, planes.at("MaxUsedMipLevel").at(x, y));
    EXPECT_EQ(static_cast<double>(record.lastKind), planes.at("IntersectionKind").at(x, y));
    EXPECT_EQ(record.hitWeight, planes.at("HitWeight").at(x, y));
    EXPECT_EQ(record.confidence, planes.at("Confidence").at(x, y));
}

// Replaces in a file; fails where nothing is replaced.
void replaceIn(const fs::path& file, const std::string& pattern, const std::string& text)
{
    std::ifstream stream(file);
    const std::string before{std::istreambuf_iterator<char>(stream), {}};
    const std::string after = std::regex_replace(before, std::regex(pattern), text);
    ASSERT_NE(before, after) << file << ": " << pattern;
    std::ofstream(file) << after;
}

size_t countTraceInstructions(const CaseData& data, const fs::path& shaders, bool records)
{
    ShaderCompiler compiler({});
    const Job job = records ? buildRecordJob(data, compiler, shaders, Precision::kFloat, {0, 0})
                            : buildJob(data, compiler, shaders, Precision::kFloat);
    return ShaderCompiler::countInstructions(job.programs.back().spirv);
}

} // namespace

TEST(PixelRecord, saysWhatThePlanesSay)
{
    for (const ProjectionModel model :
         {ProjectionModel::kHiz, ProjectionModel::kPatches, ProjectionModel::kProxyBox, ProjectionModel::kNone}) {
        const CaseData data(makeRecordedCase(model));
        for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
            const auto planes = runPlanes(data, precision);
            for (const glm::ivec2 pixel :
                 {glm::ivec2(18, 22), glm::ivec2(18, 14), glm::ivec2(3, 17), glm::ivec2(30, 19)})
                expectAgreement(recordPixel(data, precision, pixel), planes);
        }
    }
}

TEST(PixelRecord, headerHoldsTheRayAsItSetsOut)
{
    const CaseData data(makeRecordedCase(ProjectionModel::kHiz));
    const PixelRecord record = recordPixel(data, Precision::kDouble, {18, 17});
    EXPECT_TRUE(record.isTraced);
    EXPECT_EQ(record.hitClass, HitClass::kHit);
    // A reflected ray starts at its pixel's centre, at the depth that the G-buffer has there.
    EXPECT_NEAR(record.startSS.x, 18.5, 1e-9);
    EXPECT_NEAR(record.startSS.y, 17.5, 1e-9);
    EXPECT_NEAR(glm::length(record.dirSS), 1.0, 1e-12);
    EXPECT_NEAR(record.dirSS.x, 0.0, 1e-9); // the middle column: straight up the image
    EXPECT_LT(record.dirSS.y, 0.0);
    EXPECT_LT(record.depthChange, 0.0); // away from the eye
    EXPECT_EQ(record.minLevel, 0);
    EXPECT_EQ(record.maxLevel, 6);
    EXPECT_EQ(record.maxIterations, 256);
    EXPECT_EQ(record.depthBias, 0.25);
    // The ray on screen runs through the hit: where it ends lies on its line, at the depth that its line has there.
    const glm::dvec2 way = record.endSS - record.startSS;
    EXPECT_NEAR(way.x * record.dirSS.y - way.y * record.dirSS.x, 0.0, 1e-9);
    EXPECT_NEAR(1.0 / record.startDepth + record.depthChange * glm::length(way), 1.0 / record.endDepth, 1e-9);
}

TEST(PixelRecord, stepsFollowTheRayThroughTheDepthBuffer)
{
    const CaseData data(makeRecordedCase(ProjectionModel::kHiz));
    const PixelRecord record = recordPixel(data, Precision::kDouble, {11, 19});
    ASSERT_EQ(record.hitClass, HitClass::kHit);
    ASSERT_EQ(static_cast<int>(record.steps.size()), record.iterations);
    EXPECT_EQ(record.lostSteps, 0);
    EXPECT_NEAR(glm::distance(record.steps.front().positionSS, record.startSS), 0.0, 1e-9);
    EXPECT_EQ(record.steps.back().kind, IntersectionKind::kDepth);
    const Plane& depth = data.gbuffer().plane(GBufferChannel::kDeviceDepth); // reversed: 1 at near, 0 at far
    const double nearZ = data.testCase().camera.nearDistance, farZ = data.testCase().camera.farDistance;
    double wayBefore = -1;
    for (const RecordedStep& step : record.steps) {
        const double way = glm::distance(step.positionSS, record.startSS);
        EXPECT_GE(way, wayBefore - 1e-9);
        wayBefore = way;
        EXPECT_NEAR(1.0 / step.rayLinearDepth, 1.0 / record.startDepth + record.depthChange * way, 1e-9);
        EXPECT_EQ(step.thick, step.nearest + 0.25);
        EXPECT_GE(step.positionSS.x, step.cell.x << step.level);
        EXPECT_GE(step.cellSize.x, 1 << step.level);
        if (step.level == 0) {
            EXPECT_EQ(step.cellSize, glm::ivec2(1, 1));
            const double linear = farZ * nearZ / (depth.at(step.cell.x, step.cell.y) * (farZ - nearZ) + nearZ);
            EXPECT_NEAR(step.nearest, linear, 1e-9 * linear);
            EXPECT_EQ(step.nearest, step.farthest);
        } else {
            EXPECT_LT(step.nearest, step.farthest);
        }
    }
}

TEST(PixelRecord, aProxyHasADistanceAndNoSteps)
{
    const CaseData data(makeRecordedCase(ProjectionModel::kProxyInfinite));
    const PixelRecord record = recordPixel(data, Precision::kDouble, {11, 19});
    EXPECT_EQ(record.model, ProjectionModel::kProxyInfinite);
    EXPECT_TRUE(record.meetsProxy);
    EXPECT_EQ(record.projectionDistance, 65504.0);
    EXPECT_TRUE(record.steps.empty());
}

TEST(PixelRecord, stepsBeyondItsRoomAreCounted)
{
    const CaseData data(makeRecordedCase(ProjectionModel::kHiz));
    const PixelRecord whole = recordPixel(data, Precision::kFloat, {11, 19});
    const PixelRecord cut = recordPixel(data, Precision::kFloat, {11, 19}, 3);
    ASSERT_GT(whole.iterations, 3);
    EXPECT_EQ(cut.steps.size(), 3u);
    EXPECT_EQ(cut.lostSteps, whole.iterations - 3);
    EXPECT_EQ(cut.endSS, whole.endSS);
    EXPECT_EQ(cut.steps[2].positionSS, whole.steps[2].positionSS);
}

TEST(PixelRecord, aPixelThatTracesNothingSaysSo)
{
    const CaseData data(makeRecordedCase(ProjectionModel::kHiz));
    const PixelRecord record = recordPixel(data, Precision::kFloat, {18, 0}); // the wall
    EXPECT_FALSE(record.isTraced);
    EXPECT_EQ(record.hitClass, HitClass::kNoRaycast);
    EXPECT_TRUE(record.steps.empty());
}

TEST(PixelRecord, pixelsOutsideTheImageAreRefused)
{
    const CaseData data(makeRecordedCase(ProjectionModel::kHiz));
    for (const glm::ivec2 pixel : {glm::ivec2(37, 0), glm::ivec2(0, 23), glm::ivec2(-1, 0), glm::ivec2(0, -1)})
        EXPECT_THROW(recordPixel(data, Precision::kFloat, pixel), InputError);
    EXPECT_THROW(readRecord({0, 0}, JobResult{}), EnvironmentError);
}

TEST(PixelRecord, aReleaseHasNothingOfIt)
{
    const TemporaryFolder folder("record");
    const fs::path copy = folder.path() / "shaders";
    fs::copy(kShaders, copy, fs::copy_options::recursive);
    for (const char* file : {"projection.glsl", "screen_trace.glsl"})
        replaceIn(copy / "pass" / file, "\n +record[A-Za-z]+\\([^;]*\\);", "\n");
    replaceIn(copy / "pass/pixel_record.glsl", "\\{\n    recordStep[^;]*;\n\\}", "{\n}");
    replaceIn(copy / "pass/screen_trace.glsl", "\n[^\n]*kRecordPixel == 1 && [^\n]*return;", "");
    replaceIn(copy / "pass/screen_trace.glsl", "kRecordPixel == 1 \\? [^:]*: invocation", "invocation");
    for (const ProjectionModel model : {ProjectionModel::kHiz, ProjectionModel::kPatches, ProjectionModel::kProxyBox}) {
        const CaseData data(prepareForRecord(makeRecordedCase(model)));
        const size_t release = countTraceInstructions(data, kShaders, false);
        EXPECT_EQ(release, countTraceInstructions(data, copy, false));
        EXPECT_NE(release, countTraceInstructions(data, kShaders, true));
    }
}
