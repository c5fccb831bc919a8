// The measure on functions whose condition is known, on cases whose undecidable pixels a closed form tells, and on
// shaders that are broken.
#include "harness/run/conditioning.h"

#include "harness/backend/cpu/cpu_device.h"
#include "harness/pass/pass.h"
#include "harness/run/case_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace crossray;

namespace {

const std::filesystem::path kSource = CROSSRAY_SOURCE_DIR;

Conditioning measureOnCpu(const Case& testCase)
{
    ShaderCompiler compiler({});
    const CaseData data(testCase);
    const auto floats = makeCpuDevice(Precision::kFloat), doubles = makeCpuDevice(Precision::kDouble);
    return measureConditioning(testCase, buildJob(data, compiler, kSource / "shaders", Precision::kFloat),
                               buildJob(data, compiler, kSource / "shaders", Precision::kDouble),
                               [&](const std::string& backend, const Job& job) {
                                   return readPlanes(testCase, (backend == "cpu64" ? *doubles : *floats).run(job));
                               });
}

// A wall of 4x4 pixels that mirrors, and HitWeight alone of it.
Case makeWall()
{
    Case testCase;
    testCase.camera.width = testCase.camera.height = 4;
    Primitive wall;
    wall.center = {0, 0, -3};
    wall.material = "mirror";
    testCase.scene.primitives = {wall};
    testCase.outputs = {*findOutput("HitWeight")};
    return testCase;
}

// A shader that answers `f` of each pixel's depth; on cpu32 in floats.
Conditioning measureFunction(const std::function<double(double depth, bool isFloat)>& f)
{
    const Case testCase = makeWall();
    ShaderCompiler compiler({});
    const CaseData data(testCase);
    const auto ask = [&](const std::string& backend, const Job& job) {
        Plane plane("HitWeight", 4, 4, 1);
        for (size_t i = 0; i < plane.values.size(); ++i)
            plane.values[i] = f(job.images[0].texels[i], backend == "cpu32");
        return std::vector<Plane>{plane};
    };
    return measureConditioning(testCase, buildJob(data, compiler, kSource / "shaders", Precision::kFloat),
                               buildJob(data, compiler, kSource / "shaders", Precision::kDouble), ask);
}

double depthOfWall()
{
    return CaseData(makeWall()).gbuffer().plane(GBufferChannel::kDeviceDepth).values[0];
}

// Whether pixel centres lie i/2, j/2 from the middle with i*i + j*j == 50.
bool isOnRing(int x, int y)
{
    const int i = 2 * x - 15, j = 2 * y - 15;
    return i * i + j * j == 50;
}

void expectRing(const std::string& file, const std::string& output)
{
    const Case testCase = readCaseFile(kSource / "cases" / file).front();
    const Conditioning conditioning = measureOnCpu(testCase);
    const Mask undecidable = findUndecidable(conditioning, output, kUndecidableAbove);
    ASSERT_EQ(undecidable.size(), 256u);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(undecidable[static_cast<size_t>(y * 16 + x)] != 0, isOnRing(x, y))
                << output << " " << x << "," << y;
    }
}

// Whether a plane that is off by `error` everywhere passes as HitWeight of 0.5, with half the pixels excused.
Comparison judgeExcused(const Conditioning& measured, double actual)
{
    Case testCase = makeWall();
    Expectation expectation;
    expectation.output = *findOutput("HitWeight");
    expectation.source = ConstantSource{{0.5}};
    expectation.tolerance.absolute = 1e-4;
    expectation.undecidable = 0.5;
    testCase.expectations = {expectation};
    CaseJudge judge(std::make_shared<const CaseData>(testCase),
                    std::make_shared<LazyConditioning>([&] { return measured; }));
    const std::vector<Plane> planes{Plane("HitWeight", 4, 4, 1, actual)};
    return judge.judgeAlone("lavapipe", planes).front().comparison;
}

} // namespace

TEST(Conditioning, ofALineIsItsSlope)
{
    const double spacing = floatSpacing(depthOfWall()), unit = std::ldexp(1.0, -23);
    const Conditioning conditioning =
        measureFunction([&](double depth, bool) { return 0.5 + 3.0 * (depth - depthOfWall()); });
    const OutputConditioning& weight = *conditioning.find("HitWeight");
    // One ulp of depth, three times that, in ulps of 1.
    EXPECT_NEAR(weight.condition.values[5], 3.0 * spacing / unit, 1e-6);
    EXPECT_EQ(weight.cause.values[5], static_cast<double>(InputGroup::kDepth));
    EXPECT_EQ(describeConditioning(weight, 5), "HitWeight moves by 0.094 ulp for an ulp of depth");
}

TEST(Conditioning, aStepFlipsWhereItStands)
{
    const double edge = depthOfWall() + 0.5 * floatSpacing(depthOfWall());
    const Conditioning at = measureFunction([&](double depth, bool) { return depth < edge ? 1.0 : 0.0; });
    EXPECT_GT(at.find("HitWeight")->condition.values[0], 8e6); // 1 of 1.2e-7
    const Conditioning beside = measureFunction([&](double depth, bool) { return depth < edge + 1e-6 ? 1.0 : 0.0; });
    EXPECT_EQ(beside.find("HitWeight")->condition.values[0], 0.0);
    EXPECT_EQ(describeConditioning(*beside.find("HitWeight"), 0), "");
}

TEST(Conditioning, isInfiniteForAClassAndWhereANumberGoes)
{
    const Camera camera;
    const double one = 1, two = 2, none = 0, nan = std::nan("");
    EXPECT_EQ(measureMove(*findOutput("HitSuccess"), camera, &one, &one), 0.0);
    EXPECT_TRUE(std::isinf(measureMove(*findOutput("HitSuccess"), camera, &one, &two)));
    EXPECT_TRUE(std::isinf(measureMove(*findOutput("IterationCount"), camera, &one, &two)));
    EXPECT_TRUE(std::isinf(measureMove(*findOutput("HitDepth"), camera, &one, &none)));
    EXPECT_TRUE(std::isinf(measureMove(*findOutput("HitDepth"), camera, &one, &nan)));
    EXPECT_EQ(measureMove(*findOutput("HitDepth"), camera, &nan, &nan), 0.0);
    EXPECT_EQ(measureMove(*findOutput("HitDepth"), camera, &one, &two), std::ldexp(1.0, 23));
    const double direction[] = {0, 0, 1}, zero[] = {0, 0, 0};
    EXPECT_TRUE(std::isinf(measureMove(*findOutput("RayDirWS"), camera, direction, zero)));
}

TEST(Conditioning, aComponentNearZeroIsMeasuredAgainstTheWhole)
{
    Camera camera;
    camera.width = 64;
    camera.height = 32;
    const double before[] = {1e-9, 0, 1}, after[] = {1e-9 + std::ldexp(1.0, -23), 0, 1};
    EXPECT_EQ(measureMove(*findOutput("RayDirWS"), camera, before, after), 1.0);
    const double place[] = {0.001, 0.001}, moved[] = {0.001 + std::ldexp(1.0, -17), 0.001};
    EXPECT_EQ(measureMove(*findOutput("HitPositionSS"), camera, place, moved), 1.0); // an ulp of 64 px
}

TEST(Conditioning, atTheCriticalAngleThePixelsOfItsRingAreUndecidable)
{
    expectRing("stability/undecidable_critical_angle.toml", "HitReason");
    expectRing("stability/undecidable_critical_angle.toml", "RayDirWS");
}

TEST(Conditioning, onASilhouetteThePixelsOfItsRingAreUndecidable)
{
    expectRing("stability/undecidable_silhouette.toml", "HitDepth");
}

TEST(Conditioning, aPlaneHasNone)
{
    const Case testCase = readCaseFile(kSource / "cases/reflection/ray_plane.toml").front();
    const Conditioning conditioning = measureOnCpu(testCase);
    const CaseData data(testCase);
    for (const ConditioningResult::Output& output : summarize(conditioning, data.tracedPixels()).outputs) {
        EXPECT_GT(output.pixels, 1000u);
        EXPECT_EQ(output.undecidable + output.fragile, 0u) << output.output;
        EXPECT_GT(output.median, 0.1) << output.output;
    }
}

TEST(Conditioning, aShaderThatIsWrongIsNotExcused)
{
    // Wrong by as much everywhere: nothing about it is undecidable.
    const Conditioning wrong = measureFunction([](double, bool) { return 0.7; });
    const Comparison comparison = judgeExcused(wrong, 0.7);
    EXPECT_FALSE(comparison.passed);
    EXPECT_EQ(comparison.undecidable, 0u);
    EXPECT_EQ(comparison.failed, 16u);
}

TEST(Conditioning, aShaderThatLosesDigitsInFloatIsFragileAndNotExcused)
{
    // (1 + d) - 1, divided by a small d: cancellation that doubles do not see.
    const Conditioning loses = measureFunction([](double depth, bool isFloat) {
        const double small = depth * 1e-5;
        const double sum = isFloat ? static_cast<double>(static_cast<float>(1.0 + small)) : 1.0 + small;
        return (sum - 1.0) / small * 0.5;
    });
    const ConditioningResult::Output output = summarize(loses, std::vector<bool>(16, true)).outputs.front();
    EXPECT_EQ(output.undecidable, 0u);
    EXPECT_EQ(output.fragile, 16u);
    EXPECT_FALSE(judgeExcused(loses, 0.48).passed);
}

TEST(Conditioning, aShaderOfNoiseExcusesNoMoreThanTheShare)
{
    const Conditioning noise = measureFunction([](double depth, bool) { return std::fmod(depth * 1e9, 1.0); });
    EXPECT_EQ(summarize(noise, std::vector<bool>(16, true)).outputs.front().undecidable, 16u);
    const Comparison comparison = judgeExcused(noise, 0.9);
    EXPECT_FALSE(comparison.passed);
    EXPECT_NE(comparison.reason.find("16 of them (100.00 %) are undecidable, and the case excuses 50 %"),
              std::string::npos)
        << comparison.reason;
}

TEST(Conditioning, isAskedForWhereAVerdictNeedsItAlone)
{
    int measured = 0;
    Case testCase = makeWall();
    Expectation expectation;
    expectation.output = *findOutput("HitWeight");
    expectation.source = ConstantSource{{0.5}};
    expectation.tolerance.absolute = 1e-4;
    expectation.undecidable = 0.5;
    testCase.expectations = {expectation};
    CaseJudge judge(std::make_shared<const CaseData>(testCase), std::make_shared<LazyConditioning>([&] {
                        ++measured;
                        return Conditioning{"cpu64 gave no answer: signal 11", {}};
                    }));
    const std::vector<Plane> right{Plane("HitWeight", 4, 4, 1, 0.5)}, wrong{Plane("HitWeight", 4, 4, 1, 0.9)};
    EXPECT_TRUE(judge.judgeAlone("lavapipe", right).front().comparison.passed);
    EXPECT_EQ(measured, 0);
    const Comparison comparison = judge.judgeAlone("lavapipe", wrong).front().comparison;
    EXPECT_FALSE(comparison.passed);
    EXPECT_NE(comparison.reason.find("; nothing is excused: cpu64 gave no answer: signal 11"), std::string::npos);
    judge.judgeAlone("osmesa", wrong);
    EXPECT_EQ(measured, 1);
}
