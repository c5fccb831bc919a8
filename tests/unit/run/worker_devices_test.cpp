// The drivers of this machine, each in its worker.
#include "harness/base/temporary_folder.h"
#include "harness/compile/compile.h"
#include "harness/run/worker_explain.h"
#include "harness/run/worker_pool.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace crossray;
using namespace std::chrono_literals;

namespace {

constexpr const char* kSource = R"(#version 450
layout(local_size_x = 4) in;
layout(constant_id = 0) const float kScale = 1.0;
layout(binding = 0, std140) uniform Params { vec4 offset; };
layout(binding = 1) uniform sampler2D image;
layout(binding = 2, std430) buffer Result { vec4 values[]; };
void main()
{
    int x = int(gl_GlobalInvocationID.x);
    values[x] = texelFetch(image, ivec2(x, 0), 0) * kScale + offset;
}
)";

// Only the driver sees that a constant index is out of bounds, since it is no constant before specialization.
constexpr const char* kOutOfBounds = R"(#version 450
layout(local_size_x = 4) in;
layout(constant_id = 0) const int kIndex = 0;
layout(binding = 2, std430) buffer Result { vec4 values[8]; };
void main()
{
    vec4 first = values[0];

    values[kIndex] = first * 2.0;
}
)";

Job makeScaleJob(const std::filesystem::path& folder, double scale)
{
    std::ofstream(folder / "scale.comp") << kSource;
    CompileOptions options;
    options.includeRoot = folder;
    options.specialization = {{"kScale", scale}};
    const CompiledShader shader = ShaderCompiler(folder / "cache").compile("scale.comp", options);
    Job job;
    job.label = "scale";
    job.programs = {{"scale.comp", options.specialization, shader.spirv, shader.glsl, shader.key}};
    job.images = {{8, 1, 4, 1, ImageFilter::kNearest, std::vector<double>(32)}};
    for (size_t i = 0; i < 32; ++i)
        job.images[0].texels[i] = static_cast<double>(i);
    const float offset[4] = {0.5f, 0, 0, -1};
    const auto bytes = std::as_bytes(std::span(offset));
    job.buffers = {{BufferKind::kUniform, {bytes.begin(), bytes.end()}, 0}, {BufferKind::kStorage, {}, 32}};
    job.dispatches = {
        {0, {{0, Binding::What::kBuffer, 0}, {1, Binding::What::kImage, 0}, {2, Binding::What::kBuffer, 1}}, 2, 1, 1}};
    job.readbacks = {1};
    return job;
}

class WorkerDevices : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override
    {
        for (const BackendInfo& info : listBackends()) {
            if (info.name == GetParam() && !info.found) GTEST_SKIP() << "not installed: " << info.missing;
        }
        options.executable = CROSSRAY_BINARY_DIR "/worker_program";
        options.mesaCacheFolder = folder.path() / "mesa";
    }
    TemporaryFolder folder{"worker"};
    WorkerOptions options;
};

} // namespace

TEST_P(WorkerDevices, computeWhatTheyAreAsked)
{
    WorkerPool pool(options);
    EXPECT_EQ(pool.fingerprint(GetParam()).backend, GetParam());
    const JobReport empty = pool.run(GetParam(), 0, Job{}, 30s);
    EXPECT_EQ(empty.outcome, JobOutcome::kDone) << empty.text;
    for (const double scale : {2.0, 3.0, 2.0}) {
        const JobReport report = pool.run(GetParam(), 0, makeScaleJob(folder.path(), scale), 30s);
        ASSERT_EQ(report.outcome, JobOutcome::kDone) << report.text;
        ASSERT_EQ(report.result.readbacks.size(), 1u);
        for (size_t i = 0; i < 32; ++i) {
            const double offset = i % 4 == 0 ? 0.5 : i % 4 == 3 ? -1 : 0;
            EXPECT_EQ(report.result.readbacks[0].at(i), static_cast<double>(i) * scale + offset);
        }
        EXPECT_TRUE(report.result.messages.empty());
    }
    EXPECT_TRUE(pool.run(GetParam(), 0, makeScaleJob(folder.path(), 3.0), 30s).result.programsWereWarm);
}

// What the optimiser and the flattening make of branches computes what the source says, on every driver. In a loop,
// some drivers' compile time doubles with each branch that is left.
TEST_P(WorkerDevices, optimisedBranchesComputeTheSame)
{
    std::string source =
        "#version 450\nlayout(local_size_x = 4) in;\n"
        "layout(binding = 0, std140) uniform Params { vec4 offset; };\n"
        "layout(binding = 1) uniform sampler2D image;\n"
        "layout(binding = 2, std430) buffer Result { vec4 values[]; };\n"
        "float pick(float x, float y)\n{\n    if (x < 2.0) return y;\n    return x > 20.0 && y > 1.0 ? x - y : -x;\n}\n"
        "void main()\n{\n    int i = int(gl_GlobalInvocationID.x);\n    vec4 v = texelFetch(image, ivec2(i, 0), 0);\n"
        "    for (int k = 0; k < 5; ++k) {\n        if (v.x > 90.0) break;\n";
    for (int i = 0; i < 20; ++i) {
        source +=
            "        if (v.x > " + std::to_string(3 * i) + ".5) { v.y = v.y + float(k); } else { v.x = v.x + 1.0; }\n";
    }
    source += "        v.z = v.y > v.x ? pick(v.z, v.y) : (v.x > 30.0 || v.w < 7.0 ? v.z + 1.0 : v.w);\n"
              "        v.w = offset.x > 0.0 && v.z > 3.0 ? v.w + 1.0 : v.w;\n    }\n    values[i] = v;\n}\n";
    Job job = makeScaleJob(folder.path(), 1.0);
    std::ofstream(folder.path() / "branches.comp") << source;
    ShaderCompiler compiler({});
    CompileOptions compileOptions;
    compileOptions.includeRoot = folder.path();
    WorkerPool pool(options);
    std::vector<std::vector<double>> results;
    for (const bool optimize : {true, false}) {
        // Its many branches in a loop are what SwiftShader cannot compile in any time; llvmpipe stands in for it.
        const std::string backend = !optimize && GetParam() == "swiftshader" ? "lavapipe" : GetParam();
        compileOptions.optimize = optimize;
        const CompiledShader shader = compiler.compile("branches.comp", compileOptions);
        job.programs = {{"branches.comp", {}, shader.spirv, shader.glsl, shader.key}};
        const JobReport report = pool.run(backend, 0, job, 30s);
        ASSERT_EQ(report.outcome, JobOutcome::kDone) << report.text;
        results.push_back(report.result.readbacks.at(0));
    }
    EXPECT_EQ(results[0], results[1]);
    EXPECT_NE(results[0], job.images[0].texels);
}

TEST_P(WorkerDevices, aRefusedProgramIsAnAnswer)
{
    WorkerPool pool(options);
    Job job = makeScaleJob(folder.path(), 1.0);
    job.programs[0].spirv.resize(job.programs[0].spirv.size() / 2);
    job.programs[0].glsl = "#version 450\nvoid main() { missing(); }\n";
    job.programs[0].key = "broken";
    const JobReport report = pool.run(GetParam(), 0, job, 30s);
    EXPECT_EQ(report.outcome, JobOutcome::kShaderError) << report.text;
    EXPECT_FALSE(report.text.empty());
    EXPECT_EQ(pool.run(GetParam(), 0, makeScaleJob(folder.path(), 1.0), 30s).outcome, JobOutcome::kDone);
}

TEST(CpuWorkers, openAndNameTheirEntries)
{
    WorkerOptions options;
    options.executable = CROSSRAY_BINARY_DIR "/worker_program";
    WorkerPool pool(options);
    for (const std::string backend : {"cpu32", "cpu64"}) {
        EXPECT_EQ(pool.fingerprint(backend).backend, backend);
        Job job;
        job.programs = {{"entry/none.comp", {}, {}, "", "key"}};
        job.dispatches = {{0, {}, 1, 1, 1}};
        const JobReport report = pool.run(backend, 0, job, 30s);
        EXPECT_EQ(report.outcome, JobOutcome::kShaderError);
        EXPECT_NE(report.text.find("entry/none.comp"), std::string::npos) << report.text;
    }
}

TEST_P(WorkerDevices, aComplaintAboutGeneratedTextNamesTheSource)
{
    if (GetParam() == "lavapipe" || GetParam() == "swiftshader") GTEST_SKIP() << "no text reaches this driver";
    WorkerPool pool(options);
    std::ofstream(folder.path() / "scale.comp") << kOutOfBounds;
    ShaderCompiler compiler({});
    CompileOptions compileOptions;
    compileOptions.includeRoot = folder.path();
    compileOptions.specialization = {{"kIndex", 9}};
    Job job;
    job.programs = {
        {"scale.comp", compileOptions.specialization, {}, compiler.compile("scale.comp", compileOptions).glsl, "key"}};
    const JobReport report = runExplained(pool, compiler, folder.path(), GetParam(), 0, job, 30s);
    EXPECT_EQ(report.outcome, JobOutcome::kShaderError);
    EXPECT_NE(report.text.find((folder.path() / "scale.comp").string() + ":9: error: "), std::string::npos)
        << report.text;
}

INSTANTIATE_TEST_SUITE_P(Backends, WorkerDevices,
                         testing::Values("lavapipe", "swiftshader", "osmesa", "softpipe", "egl"),
                         [](const auto& each) { return each.param; });
