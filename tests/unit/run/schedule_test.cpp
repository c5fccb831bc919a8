#include "harness/run/schedule.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

using namespace crossray;

namespace {

std::vector<std::vector<bool>> allApply(size_t cases, size_t backends)
{
    return std::vector<std::vector<bool>>(cases, std::vector<bool>(backends, true));
}

Schedule makeSchedule(size_t cases, size_t backends, size_t cores, Schedule::Limits limits = {})
{
    return Schedule(allApply(cases, backends), std::vector<size_t>(cases, 1), cores, limits);
}

struct Ran {
    size_t caseIndex, backend;
    auto operator<=>(const Ran&) const = default;
};

} // namespace

TEST(Schedule, runsTheFirstCaseBeforeItPreparesTheSecond)
{
    Schedule schedule = makeSchedule(2, 2, 1);
    EXPECT_EQ(schedule.next(0).kind, Task::Kind::kPrepare);
    schedule.finishPrepare(0, true);
    EXPECT_EQ(schedule.next(0).kind, Task::Kind::kRun);
}

TEST(Schedule, staysWithABackendWhileItHasWork)
{
    Schedule schedule = makeSchedule(3, 2, 1);
    std::vector<size_t> order;
    for (Task task = schedule.next(0); task.kind != Task::Kind::kDone; task = schedule.next(0)) {
        if (task.kind == Task::Kind::kPrepare) {
            schedule.finishPrepare(task.caseIndex, true);
        } else {
            order.push_back(task.backend);
            schedule.finishRun(0, task.caseIndex, task.backend, 1);
        }
    }
    EXPECT_EQ(order.size(), 6u);
    EXPECT_EQ(std::unique(order.begin(), order.end()) - order.begin(), 2); // one change of backend
}

TEST(Schedule, startsNoSecondWorkerForLittleWork)
{
    Schedule schedule = makeSchedule(2, 1, 2);
    schedule.next(0);
    schedule.next(1);
    schedule.finishPrepare(0, true);
    schedule.finishPrepare(1, true);
    ASSERT_EQ(schedule.next(0).kind, Task::Kind::kRun);
    EXPECT_EQ(schedule.next(1).kind, Task::Kind::kWait);
    schedule.finishRun(0, 0, 0, 1000); // a slow backend is worth a second worker
    EXPECT_EQ(schedule.next(1).kind, Task::Kind::kRun);
}

TEST(Schedule, boundsTheCasesInFlight)
{
    Schedule schedule = makeSchedule(10, 1, 4, {.casesInFlight = 2});
    EXPECT_EQ(schedule.next(0).kind, Task::Kind::kPrepare);
    EXPECT_EQ(schedule.next(1).kind, Task::Kind::kPrepare);
    EXPECT_EQ(schedule.next(2).kind, Task::Kind::kWait);
}

TEST(Schedule, boundsTheBytesInFlightAndStillRunsWhatIsLarger)
{
    Schedule schedule(allApply(2, 1), {1000, 1000}, 2, {.casesInFlight = 10, .bytesInFlight = 100});
    EXPECT_EQ(schedule.next(0).kind, Task::Kind::kPrepare);
    EXPECT_EQ(schedule.next(1).kind, Task::Kind::kWait);
}

TEST(Schedule, handsOutNothingOnceStopped)
{
    Schedule schedule = makeSchedule(2, 1, 1);
    schedule.stop();
    EXPECT_EQ(schedule.next(0).kind, Task::Kind::kDone);
}

// Whatever the order in which tasks end, each case runs once on each of its backends, and nobody waits for ever.
RC_GTEST_PROP(Schedule, runsEverythingOnce, ())
{
    const auto cases = *rc::gen::inRange<size_t>(1, 12);
    const auto backends = *rc::gen::inRange<size_t>(1, 5);
    const auto cores = *rc::gen::inRange<size_t>(1, 5);
    const auto window = *rc::gen::inRange<size_t>(1, 6);
    std::vector<std::vector<bool>> applies(cases);
    std::set<Ran> expected;
    std::set<size_t> unusable;
    for (size_t i = 0; i < cases; ++i) {
        if (*rc::gen::inRange(0, 6) == 0) unusable.insert(i);
        for (size_t b = 0; b < backends; ++b) {
            applies[i].push_back(*rc::gen::inRange(0, 4) != 0);
            if (applies[i].back() && !unusable.contains(i)) expected.insert({i, b});
        }
    }
    Schedule schedule(applies, std::vector<size_t>(cases, 1), cores, {.casesInFlight = window});
    std::set<Ran> ran;
    std::map<size_t, Task> running; // by core
    std::set<size_t> ended;
    while (ended.size() < cores) {
        bool progressed = false;
        for (size_t core = 0; core < cores; ++core) {
            if (running.contains(core) || ended.contains(core)) continue;
            const Task task = schedule.next(core);
            if (task.kind == Task::Kind::kDone) ended.insert(core);
            if (task.kind == Task::Kind::kRun) RC_ASSERT(ran.insert({task.caseIndex, task.backend}).second);
            if (task.kind == Task::Kind::kRun || task.kind == Task::Kind::kPrepare) running[core] = task;
            progressed = progressed || task.kind != Task::Kind::kWait;
        }
        RC_ASSERT(progressed || !running.empty()); // else all wait for ever
        if (running.empty()) continue;
        auto which = running.begin();
        std::advance(which, *rc::gen::inRange<size_t>(0, running.size()));
        const auto [core, task] = *which;
        running.erase(which);
        if (task.kind == Task::Kind::kPrepare) {
            schedule.finishPrepare(task.caseIndex, !unusable.contains(task.caseIndex));
        } else {
            schedule.finishRun(core, task.caseIndex, task.backend, *rc::gen::inRange(0, 300));
        }
    }
    RC_ASSERT(ran == expected);
}
