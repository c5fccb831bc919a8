// A run whose workers die by the hundred: each case has its verdict, and only those whose job was at work are blamed.
#include "harness/base/temporary_folder.h"
#include "harness/run/environment.h"
#include "harness/run/steps.h"
#include "tests/unit/run/dying_worker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

using namespace crossray;

namespace {

namespace fs = std::filesystem;

class Silent : public RunObserver {
  public:
    void startBackend(const std::string&, const CaseResult&) override {}
    void finishBackend(const CaseResult&, const BackendResult&) override {}
    void finishCase(const CaseResult&) override {}
    void tick() override {}
};

// As many cases as the product of both lists: the mirrored rays of a wall.
std::vector<Case> makeCases(const fs::path& folder, int heights, int fovs)
{
    const fs::path file = folder / "many.toml";
    std::ofstream text(file);
    text << "schema = 1\nname = \"many\"\nsummary = \"Workers that die take no case with them.\"\n[scene]\nsize = [4, "
            "4]\n"
            "primitives = [{ shape = \"plane\", center = [0, 0, -4], normal = [0, 0, 1] }]\n"
            "[[expect]]\noutput = \"HitSuccess\"\nconstant = \"no_raycast\"\nwhere = \"all\"\n[expand]\n";
    const auto list = [&](const char* key, int count, double first, double step) {
        text << key << " = [";
        for (int i = 0; i < count; ++i)
            text << fmt::format("{}{}", i == 0 ? "" : ", ", first + step * i);
        text << "]\n";
    };
    list("camera.fov", fovs, 30.5, 1);
    list("material.roughness", heights, 0.015625, 0.015625);
    text.close();
    return readCaseFile(file);
}

RunResult runDying(const std::vector<Case>& cases, int cores)
{
    WorkerOptions workers;
    workers.executable = CROSSRAY_BINARY_DIR "/worker_program";
    workers.cores = cores;
    WorkerPool pool(workers);
    ShaderCompiler compiler({});
    ExecuteOptions options;
    options.backends = {"cpu64"};
    options.cores = cores;
    options.timeoutSeconds = 300; // however busy the machine is
    const ExecuteSteps steps = makeSteps(pool, compiler, fs::path(CROSSRAY_SOURCE_DIR) / "shaders", options.backends);
    Silent observer;
    const std::atomic<bool> interrupted{false};
    RunResult run;
    execute(cases, options, steps, observer, interrupted, run);
    return run;
}

} // namespace

TEST(WorkerDeaths, aThousandInTwoThousandCasesLoseNoVerdictAndBlameNoOther)
{
    const int cores = std::min(countAvailableCores(), 2);
    const TemporaryFolder folder("deaths");
    // A death that is still to come when the last case ends is none: one a core at most.
    plantDeaths(folder.path(), 1000 + cores);
    ASSERT_EQ(::setenv(kDeathsVariable, folder.path().c_str(), 1), 0);
    const std::vector<Case> cases = makeCases(folder.path(), 40, 50);
    ASSERT_EQ(cases.size(), 2000u);
    const RunResult run = runDying(cases, cores);
    ::unsetenv(kDeathsVariable);

    const DeathLog deaths = readDeathLog(folder.path());
    EXPECT_GE(deaths.count(), 1000);
    EXPECT_GE(deaths.opening, 245); // each core dies in this order, and may be cut short in it
    EXPECT_GE(deaths.arrival, 245);
    EXPECT_GE(deaths.between, 245);
    EXPECT_GE(deaths.jobs.size(), 245u);
    ASSERT_EQ(run.cases.size(), cases.size());
    std::set<std::string> blamed;
    for (const CaseResult& testCase : run.cases) {
        ASSERT_EQ(testCase.backends.size(), 1u) << testCase.name;
        const BackendResult& result = testCase.backends.front();
        if (result.verdict == Verdict::kPass) continue;
        EXPECT_EQ(result.verdict, Verdict::kCrash) << testCase.name << ": " << result.reason;
        EXPECT_EQ(result.reason, "signal 9 (Killed)") << testCase.name;
        blamed.insert(testCase.name);
    }
    EXPECT_EQ(blamed, deaths.jobs);
    EXPECT_EQ(run.backends.at("cpu64").environmentError, "");
}
