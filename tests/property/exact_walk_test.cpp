// On each driver: the walk through the levels of a pyramid ends each ray where the walk over every pixel ends it, bit
// for bit, over random images. tests/shader/ (patch_tracer_test.cpp, hiz_test.cpp) holds the C++ forms to the same.
#include "tests/property/random_image.h"

#include "harness/base/temporary_folder.h"
#include "harness/compile/compile.h"
#include "harness/pass/bindings.h"
#include "harness/pass/pass.h"
#include "harness/run/worker_pool.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

constexpr uint32_t kRayBinding = 15; // compare_walks.comp
constexpr int kGroup = 64;
constexpr size_t kScalarsPerRay = 8;
constexpr double kHitClassHit = 1; // crossray/shared/outputs.glsl

// Seeds from 1 on, or those that are asked for: CROSSRAY_SEED=17 or CROSSRAY_SEED=100-400.
constexpr const char* kSeedVariable = "CROSSRAY_SEED";
std::vector<uint64_t> chooseSeeds(uint64_t count)
{
    uint64_t first = 1, last = count;
    if (const char* asked = std::getenv(kSeedVariable)) {
        char* end = nullptr;
        first = last = std::strtoull(asked, &end, 10);
        if (*end == '-') last = std::strtoull(end + 1, nullptr, 10);
    }
    std::vector<uint64_t> seeds;
    for (uint64_t seed = first; seed <= last; ++seed)
        seeds.push_back(seed);
    return seeds;
}

// The library's folders beside this one, since includes may not leave their root.
void linkShaders(const fs::path& root)
{
    const fs::path source = fs::absolute(CROSSRAY_SOURCE_DIR);
    for (const char* name : {"crossray", "bindings", "pass", "entry"})
        fs::create_directory_symlink(source / "shaders" / name, root / name);
    fs::create_directory_symlink(source / "tests/property", root / "walks");
}

ImageDesc makeRayImage(const std::vector<RandomRay>& rays)
{
    ImageDesc image{static_cast<int>(rays.size()), 2, 4, 1, ImageFilter::kNearest, {}};
    for (const RandomRay& ray : rays) {
        image.texels.insert(image.texels.end(),
                            {ray.originWS.x, ray.originWS.y, ray.originWS.z, static_cast<double>(ray.maxLevel)});
    }
    for (const RandomRay& ray : rays)
        image.texels.insert(image.texels.end(), {ray.dirWS.x, ray.dirWS.y, ray.dirWS.z, ray.caution});
    return image;
}

class ExactWalk : public testing::TestWithParam<std::string> {
  protected:
    static void SetUpTestSuite()
    {
        folder_ = std::make_unique<TemporaryFolder>("walks");
        linkShaders(folder_->path());
    }
    static void TearDownTestSuite() { folder_.reset(); }

    void SetUp() override
    {
        for (const BackendInfo& info : listBackends()) {
            if (info.name == GetParam() && !info.found) GTEST_SKIP() << "not installed: " << info.missing;
        }
        WorkerOptions options;
        options.executable = CROSSRAY_BINARY_DIR "/worker_program";
        options.mesaCacheFolder = CROSSRAY_BINARY_DIR "/mesa-cache";
        pool_ = std::make_unique<WorkerPool>(options);
    }

    // The pass that a case of this image has, with its trace replaced by the two walks.
    Job makeJob(const RandomImage& image, ProjectionModel model)
    {
        Case testCase;
        testCase.name = fmt::format("seed {}", image.seed);
        testCase.camera = image.camera;
        testCase.scene.primitives = {Primitive{}};
        testCase.projection.model = model;
        testCase.projection.patches.maxIterations = testCase.projection.hiz.maxIterations = 65535;
        testCase.projection.patches.depthError = image.depthError;
        testCase.outputs.push_back(*findOutput("HitSuccess"));
        const CaseData data(testCase);
        Job job = buildJob(data, compiler_, fs::path(CROSSRAY_SOURCE_DIR) / "shaders", Precision::kFloat);

        DispatchDesc walk = job.dispatches.back();
        job.dispatches.pop_back();
        job.programs.pop_back();
        job.images.push_back(makeRayImage(image.rays));
        walk.bindings.push_back({kRayBinding, Binding::What::kImage, job.images.size() - 1});
        walk.groupsX = 1;
        walk.groupsY = static_cast<uint32_t>(image.rays.size() + kGroup - 1) / kGroup;
        job.readbacks.clear();
        for (const int every : {0, 1}) {
            job.buffers.push_back({BufferKind::kStorage, {}, image.rays.size() * kScalarsPerRay});
            job.readbacks.push_back(job.buffers.size() - 1);
            for (Binding& binding : walk.bindings) {
                if (binding.binding == kOutputBinding) binding.index = job.buffers.size() - 1;
                if (binding.binding == kDepthBinding) job.images[binding.index].texels = image.deviceDepths;
                if (binding.binding == kNormalBinding) job.images[binding.index].texels = image.normalsWS;
            }
            walk.program = job.programs.size();
            job.programs.push_back(compileWalk(image.camera, model, every));
            job.dispatches.push_back(walk);
        }
        return job;
    }

    ProgramSource compileWalk(const Camera& camera, ProjectionModel model, int every)
    {
        CompileOptions options;
        options.includeRoot = folder_->path();
        options.specialization = {{"kWalk", every},
                                  {"kProjectionModel", static_cast<int>(model)},
                                  {"kOrthographic", camera.projection == ProjectionKind::kOrthographic ? 1 : 0},
                                  {"kReversedDepth", camera.depthConvention == DepthConvention::kStandard ? 0 : 1}};
        const CompiledShader shader = compiler_.compile(folder_->path() / "walks/compare_walks.comp", options);
        return {"walks/compare_walks.comp", options.specialization, shader.spirv, shader.glsl, shader.key};
    }

    void compareAllShapes(ProjectionModel model)
    {
        const bool isInterpreted = GetParam() == "softpipe"; // 30 times as slow as what compiles
        compareShape(model, ImageShape::kAny, isInterpreted ? 5 : 24, isInterpreted ? 64 : 512);
        compareShape(model, ImageShape::kThin, isInterpreted ? 5 : 12, isInterpreted ? 64 : 256);
        if (!isInterpreted) compareShape(model, ImageShape::kWide, 4, 256);
        if (std::getenv(kSeedVariable) != nullptr) return;
        EXPECT_GT(hits_, rays_ / 20); // else the images ask for nothing
        EXPECT_LT(steps_, stepsOfEveryPixel_);
    }

    void compareShape(ProjectionModel model, ImageShape shape, uint64_t seeds, int rays)
    {
        for (const uint64_t seed : chooseSeeds(seeds)) {
            const RandomImage image = makeRandomImage(seed, shape, rays);
            const JobReport report = pool_->run(GetParam(), 0, makeJob(image, model), std::chrono::seconds(120));
            ASSERT_EQ(report.outcome, JobOutcome::kDone) << report.text;
            const std::vector<double>& levels = report.result.readbacks.at(0);
            const std::vector<double>& pixels = report.result.readbacks.at(1);
            ASSERT_EQ(levels.size(), image.rays.size() * kScalarsPerRay);
            for (size_t ray = 0; ray < image.rays.size(); ++ray)
                compareRay(image, ray, &levels[ray * kScalarsPerRay], &pixels[ray * kScalarsPerRay]);
            if (HasFailure()) return;
        }
    }

    // Class, reason, position, depth and confidence.
    void compareRay(const RandomImage& image, size_t ray, const double* levels, const double* pixels)
    {
        ++rays_;
        hits_ += levels[0] == kHitClassHit;
        steps_ += levels[6];
        stepsOfEveryPixel_ += pixels[6];
        if (std::memcmp(levels, pixels, 6 * sizeof(double)) == 0) return;
        const std::span<const double> byLevels(levels, 6), byPixels(pixels, 6);
        ADD_FAILURE() << fmt::format(
            "{}={}, {} x {}, ray {}, levels to {}, caution {}:\n by levels   {}\n every pixel {}", kSeedVariable,
            image.seed, image.camera.width, image.camera.height, ray, image.rays[ray].maxLevel, image.rays[ray].caution,
            fmt::join(byLevels, " "), fmt::join(byPixels, " "));
    }

    static inline std::unique_ptr<TemporaryFolder> folder_;
    ShaderCompiler compiler_{CROSSRAY_BINARY_DIR "/walk-cache"};
    std::unique_ptr<WorkerPool> pool_;
    size_t rays_ = 0, hits_ = 0;
    double steps_ = 0, stepsOfEveryPixel_ = 0;
};

} // namespace

TEST_P(ExactWalk, OverPlanesEndsWhereTheWalkOverEveryPixelEnds)
{
    compareAllShapes(ProjectionModel::kPatches);
}

// The documented march is its own yardstick: its maximum level changes the cost alone.
TEST_P(ExactWalk, OverDepthsEndsWhereTheWalkAtTheMinimumLevelEnds)
{
    compareAllShapes(ProjectionModel::kHiz);
}

INSTANTIATE_TEST_SUITE_P(, ExactWalk, testing::Values("lavapipe", "osmesa", "swiftshader", "softpipe"),
                         [](const auto& backend) { return backend.param; });
