#include "harness/run/shard.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

using namespace crossray;

namespace {

using Variables = std::map<std::string, std::string>;

ReadVariable readFrom(const Variables& environment)
{
    return [environment](const char* name) {
        const auto found = environment.find(name);
        return found == environment.end() ? std::nullopt : std::optional<std::string>(found->second);
    };
}

std::string choose(const std::string& text, const Variables& environment)
{
    return chooseShard(text, readFrom(environment)).shard.format();
}

Variables slurmTask(int id, int first, int last, int step)
{
    return {{"SLURM_ARRAY_TASK_ID", std::to_string(id)},
            {"SLURM_ARRAY_TASK_MIN", std::to_string(first)},
            {"SLURM_ARRAY_TASK_MAX", std::to_string(last)},
            {"SLURM_ARRAY_TASK_STEP", std::to_string(step)},
            {"SLURM_ARRAY_TASK_COUNT", std::to_string((last - first) / step + 1)}};
}

} // namespace

TEST(Shard, acceptsOnlyPartsThatExist)
{
    EXPECT_EQ(Shard::parse("2/3").index, 2);
    EXPECT_EQ(Shard::parse("2/3").count, 3);
    EXPECT_EQ(Shard::parse("2/3").format(), "2/3");
    for (const char* broken : {"0/3", "4/3", "1", "1/", "/3", "1/3x", "-1/3", "a/b", "", "1/99999999999"})
        EXPECT_THROW(Shard::parse(broken), InputError) << broken;
}

// The hash is a promise: results of shards that were run by different versions are merged.
TEST(Shard, hashNeverChanges)
{
    EXPECT_EQ(computeStableHash("refraction/sphere"), 167449756777745165u);
    EXPECT_NE(computeStableHash("a"), computeStableHash("b"));
}

RC_GTEST_PROP(Shard, byNameEachCaseIsInOnePart, (const std::vector<std::string>& names))
{
    const int count = *rc::gen::inRange(1, 9);
    for (const std::string& name : names) {
        const int part = findPartByName(name, count);
        RC_ASSERT(part >= 1);
        RC_ASSERT(part <= count);
        RC_ASSERT(part == findPartByName(name, count)); // whatever else is selected
    }
}

TEST(Shard, partsByNameAreOfSimilarSize)
{
    int inFirst = 0;
    for (int i = 0; i < 1000; ++i)
        inFirst += findPartByName("sweep/case[ior=1." + std::to_string(i) + "]", 4) == 1 ? 1 : 0;
    EXPECT_GT(inFirst, 200);
    EXPECT_LT(inFirst, 300);
}

// Each name has one part and each part exists, whatever the times; no order of the names changes who takes what; and
// no part is longer than the mean and the longest case together.
RC_GTEST_PROP(Shard, byTimeTheUnionIsTheWholeWithoutOverlapAndBalanced, (const std::set<std::string>& unique))
{
    const std::vector<std::string> names(unique.begin(), unique.end());
    const int count = *rc::gen::inRange(1, 9);
    Timings timings;
    for (const std::string& name : names) {
        if (*rc::gen::inRange(0, 4) > 0) timings[name] = *rc::gen::inRange(0, 5000) / 16.0;
    }
    const std::vector<int> parts = findPartsByTime(names, timings, count);
    RC_ASSERT(parts.size() == names.size());
    for (const int part : parts)
        RC_ASSERT(part >= 1 && part <= count);

    std::vector<std::string> reversed(names.rbegin(), names.rend());
    std::vector<int> partsReversed = findPartsByTime(reversed, timings, count);
    std::reverse(partsReversed.begin(), partsReversed.end());
    RC_ASSERT(parts == partsReversed);

    if (timings.size() < names.size()) return;
    std::vector<double> loads(static_cast<size_t>(count));
    double longest = 0;
    for (size_t i = 0; i < names.size(); ++i) {
        loads[static_cast<size_t>(parts[i] - 1)] += timings[names[i]];
        longest = std::max(longest, timings[names[i]]);
    }
    const double mean = std::accumulate(loads.begin(), loads.end(), 0.0) / count;
    const double rounding = 0.001 * static_cast<double>(names.size() + 1);
    RC_ASSERT(*std::max_element(loads.begin(), loads.end()) <= mean + longest + rounding);
}

TEST(Shard, longCasesAreSpreadAndUnknownOnesCountAsTheMedian)
{
    const std::vector<std::string> names{"a", "b", "c", "d", "e"};
    const Timings timings{{"a", 100}, {"b", 40}, {"c", 35}, {"d", 30}};
    // By length: a, then b and e (at the median of 40) and c beside it, and d where a is alone.
    EXPECT_EQ(findPartsByTime(names, timings, 2), (std::vector<int>{1, 2, 2, 1, 2}));
    // Without any time the parts are of one size.
    const std::vector<int> even = findPartsByTime(names, {}, 5);
    EXPECT_EQ(std::set<int>(even.begin(), even.end()).size(), 5u);
}

TEST(ShardChoice, readsTheConventionsOfEngines)
{
    EXPECT_EQ(choose("auto", {{"CI_NODE_INDEX", "2"}, {"CI_NODE_TOTAL", "4"}}), "2/4");
    EXPECT_EQ(choose("auto", {{"CI_NODE_TOTAL", "1"}}), "1/1"); // a job that is not run in parallel
    EXPECT_EQ(choose("auto", {{"TEST_SHARD_INDEX", "0"}, {"TEST_TOTAL_SHARDS", "4"}}), "1/4");
    EXPECT_EQ(choose("auto", {{"GTEST_SHARD_INDEX", "3"}, {"GTEST_TOTAL_SHARDS", "4"}}), "4/4");
    EXPECT_EQ(choose("auto", slurmTask(0, 0, 3, 1)), "1/4");
    EXPECT_EQ(choose("auto", slurmTask(4, 1, 4, 1)), "4/4");
    EXPECT_EQ(choose("slurm", slurmTask(30, 10, 40, 10)), "3/4");
    EXPECT_EQ(choose("auto/8", {{"JOB_COMPLETION_INDEX", "7"}}), "8/8");
    EXPECT_EQ(choose("kubernetes/8", {{"JOB_COMPLETION_INDEX", "0"}, {"CI_NODE_INDEX", "5"}}), "1/8");
    EXPECT_EQ(choose("auto/4", {{"CI_NODE_INDEX", "2"}, {"CI_NODE_TOTAL", "4"}}), "2/4");
    EXPECT_EQ(choose("3/5", {{"CI_NODE_INDEX", "2"}, {"CI_NODE_TOTAL", "4"}}), "3/5"); // what a person says counts
}

TEST(ShardChoice, saysWhatItTookAndWhichFileToTouch)
{
    const ShardChoice choice = chooseShard(
        "auto",
        readFrom({{"TEST_SHARD_INDEX", "0"}, {"TEST_TOTAL_SHARDS", "2"}, {"TEST_SHARD_STATUS_FILE", "/tmp/status"}}));
    EXPECT_EQ(choice.source, "bazel: TEST_SHARD_INDEX=0, TEST_TOTAL_SHARDS=2");
    EXPECT_EQ(choice.statusFile, "/tmp/status");
    EXPECT_EQ(chooseShard("1/2", readFrom({})).source, "");
}

TEST(ShardChoice, refusesWhatNamesNoPartOrTwo)
{
    const std::vector<std::pair<std::string, Variables>> broken{
        {"auto", {}},
        {"gitlab", slurmTask(0, 0, 3, 1)},
        {"auto", {{"CI_NODE_INDEX", "5"}, {"CI_NODE_TOTAL", "4"}}},
        {"auto", {{"CI_NODE_INDEX", "0"}, {"CI_NODE_TOTAL", "4"}}}, // GitLab counts from 1
        {"auto", {{"CI_NODE_INDEX", "2"}}},
        {"auto", {{"CI_NODE_INDEX", "two"}, {"CI_NODE_TOTAL", "4"}}},
        {"auto", {{"TEST_SHARD_INDEX", "4"}, {"TEST_TOTAL_SHARDS", "4"}}},
        {"auto/5", {{"CI_NODE_INDEX", "2"}, {"CI_NODE_TOTAL", "4"}}},
        {"auto/0", {{"JOB_COMPLETION_INDEX", "0"}}},
        {"auto", {{"JOB_COMPLETION_INDEX", "0"}}},   // of how many?
        {"auto/8", {{"JOB_COMPLETION_INDEX", "8"}}}, // counts from 0
        {"automatic", {}},
    };
    for (const auto& [text, environment] : broken)
        EXPECT_THROW(choose(text, environment), InputError) << text;

    // Tasks 1, 3 and 7 know three numbers, and not that there is no task 5.
    Variables holes = slurmTask(3, 1, 7, 1);
    holes["SLURM_ARRAY_TASK_COUNT"] = "3";
    EXPECT_THROW(choose("auto", holes), InputError);

    // GitLab's runner may itself be a task of an array.
    Variables both = slurmTask(0, 0, 3, 1);
    both["CI_NODE_INDEX"] = "2";
    both["CI_NODE_TOTAL"] = "4";
    EXPECT_THROW(choose("auto", both), InputError);
    EXPECT_EQ(choose("gitlab", both), "2/4");
    both["CI_NODE_INDEX"] = "1";
    EXPECT_EQ(choose("auto", both), "1/4"); // they agree
}
