#include "harness/inspect/worst_traces.h"

#include "harness/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

using namespace crossray;

namespace fs = std::filesystem;

namespace {

ExpectationResult makeExpectation(bool passed, int x, size_t failed)
{
    ExpectationResult expectation;
    expectation.judged = true;
    expectation.comparison.passed = passed;
    expectation.comparison.compared = 100;
    expectation.comparison.failed = failed;
    expectation.comparison.worst = PixelDifference{x, 1, {0}, {1}, 1};
    return expectation;
}

BackendResult makeFailure(const std::string& backend, Verdict verdict = Verdict::kFail)
{
    BackendResult result;
    result.backend = backend;
    result.verdict = verdict;
    result.expectations = {makeExpectation(true, 3, 0), makeExpectation(false, 4, 1), makeExpectation(false, 5, 7)};
    return result;
}

class WorstTraces : public testing::Test {
  protected:
    BackendResult& add(const std::string& name, const BackendResult& result)
    {
        const auto find = [&](auto& list) {
            return std::find_if(list.begin(), list.end(), [&](auto& each) { return each.name == name; });
        };
        if (find(cases_) == cases_.end()) {
            cases_.emplace_back().name = name;
            run_.cases.emplace_back().name = name;
        }
        std::vector<BackendResult>& results = find(run_.cases)->backends;
        results.reserve(8); // what add() returns stays where it is
        return results.emplace_back(result);
    }

    // Notes what it is asked for: "CASE X,Y BACKEND BACKEND".
    void keep(const WorstTraceLimits& limits = {}, std::chrono::milliseconds each = {})
    {
        const TraceStep trace = [&](const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends, int,
                                    std::chrono::duration<double> timeout) {
            std::string line = testCase.name + " " + std::to_string(pixel.x) + "," + std::to_string(pixel.y);
            PixelTrace made{testCase.name, "", pixel, {}, {}};
            for (const std::string& backend : backends) {
                line += " " + backend;
                made.records.push_back({backend, {}});
            }
            std::this_thread::sleep_for(each);
            const std::lock_guard lock(mutex_);
            asked_.insert(line);
            EXPECT_GE(timeout.count(), 2);
            if (testCase.name == "broken") throw EnvironmentError("osmesa: it died\nand said more");
            return made;
        };
        keepWorstTraces(run_, cases_, folder_, trace, limits, interrupted_);
    }

    nlohmann::json read(const std::string& file) const
    {
        std::ifstream stream(folder_ / file);
        return nlohmann::json::parse(stream);
    }

    std::set<std::string> asked_;
    std::vector<Case> cases_;
    RunResult run_;
    std::atomic<bool> interrupted_{false};
    const TemporaryFolder temporary_{"crossray_worst_traces"};
    const fs::path folder_ = temporary_.path() / "run"; // not there yet
    std::mutex mutex_;
};

} // namespace

TEST_F(WorstTraces, areOfTheWorstPixelAndBesideCpu64)
{
    add("dir/a", makeFailure("osmesa"));
    add("dir/a", makeFailure("cpu64"));
    keep();
    EXPECT_EQ(asked_, (std::set<std::string>{"dir/a 5,1 osmesa cpu64", "dir/a 5,1 cpu64"}));
    const BackendResult& first = run_.cases[0].backends[0];
    EXPECT_EQ(first.traceFile, "planes/dir/a/osmesa.trace.json");
    EXPECT_EQ(first.traceNote, "");
    EXPECT_EQ(read(first.traceFile)["backends"][1]["backend"], "cpu64");
    EXPECT_EQ(read(run_.cases[0].backends[1].traceFile)["pixel"][0], 5);
}

TEST_F(WorstTraces, areOfFailuresAloneThatHaveAWorstPixel)
{
    for (const Verdict verdict : allVerdicts()) {
        if (verdict != Verdict::kFail) add("a", makeFailure("osmesa", verdict));
    }
    for (ExpectationResult& expectation : add("b", makeFailure("osmesa")).expectations)
        expectation.comparison.worst.reset();
    keep();
    EXPECT_TRUE(asked_.empty());
    EXPECT_FALSE(fs::exists(folder_));
    EXPECT_EQ(run_.cases[1].backends[0].traceNote, "");
}

TEST_F(WorstTraces, standAloneWhereCpu64CannotRunTheCase)
{
    add("mine", makeFailure("osmesa"));
    cases_[0].projection.model = ProjectionModel::kOwn;
    keep();
    EXPECT_EQ(asked_, std::set<std::string>{"mine 5,1 osmesa"});
}

TEST_F(WorstTraces, oneThatFailsIsANoteAndHarmsNoOther)
{
    add("broken", makeFailure("osmesa"));
    add("whole", makeFailure("osmesa"));
    keep();
    EXPECT_EQ(run_.cases[0].backends[0].traceFile, "");
    EXPECT_EQ(run_.cases[0].backends[0].traceNote, "osmesa: it died");
    EXPECT_EQ(run_.cases[1].backends[0].traceFile, "planes/whole/osmesa.trace.json");
    EXPECT_EQ(run_.cases[0].backends[0].verdict, Verdict::kFail);
}

TEST_F(WorstTraces, aFolderThatCannotBeWrittenIsANote)
{
    add("a", makeFailure("osmesa"));
    std::ofstream(folder_) << "a file";
    keep();
    EXPECT_EQ(run_.cases[0].backends[0].traceFile, "");
    EXPECT_NE(run_.cases[0].backends[0].traceNote, "");
}

TEST_F(WorstTraces, eachCaseHasOneBeforeAnyHasTwo)
{
    for (const char* name : {"a", "b", "c"}) {
        for (const char* backend : {"osmesa", "lavapipe"})
            add(name, makeFailure(backend));
    }
    keep({4, std::chrono::seconds(60), 3});
    EXPECT_EQ(asked_, (std::set<std::string>{"a 5,1 osmesa cpu64", "b 5,1 osmesa cpu64", "c 5,1 osmesa cpu64",
                                             "a 5,1 lavapipe cpu64"}));
    EXPECT_EQ(run_.cases[1].backends[1].traceNote, "a run keeps 4 traces at most");
}

TEST_F(WorstTraces, endWhenTheTimeIsOverOrTheRunIsInterrupted)
{
    for (const char* name : {"a", "b", "c"})
        add(name, makeFailure("osmesa"));
    keep({40, std::chrono::milliseconds(50), 1}, std::chrono::milliseconds(60));
    EXPECT_EQ(asked_, std::set<std::string>{"a 5,1 osmesa cpu64"});
    EXPECT_EQ(run_.cases[2].backends[0].traceNote, "the 0.05 s for traces were over");

    interrupted_ = true;
    asked_.clear();
    keep();
    EXPECT_TRUE(asked_.empty());
    EXPECT_EQ(run_.cases[2].backends[0].traceNote, "the run was interrupted");
}
