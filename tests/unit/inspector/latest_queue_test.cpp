#include "harness/inspector/latest_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <string>

using namespace crossray;

namespace {

using namespace std::chrono_literals;

// Work that lasts until it is let go, or is not wanted any more.
struct Gate {
    std::promise<void> isRunning;
    std::atomic<bool> isOpen = false;
    void operator()(WorkWatch& watch)
    {
        isRunning.set_value();
        while (!isOpen) {
            watch.note(1, 2);
            std::this_thread::sleep_for(1ms);
        }
    }
};

class LatestQueueTest : public testing::Test {
  protected:
    std::future<WorkEnd> start(WorkKind kind, std::function<void(WorkWatch&)> work)
    {
        return std::async(std::launch::async, [this, kind, work = std::move(work)] { return queue_.run(kind, work); });
    }
    std::future<WorkEnd> startGate(WorkKind kind, Gate& gate)
    {
        std::future<WorkEnd> end = start(kind, std::ref(gate));
        gate.isRunning.get_future().wait();
        return end;
    }

    LatestQueue queue_;
};

} // namespace

TEST_F(LatestQueueTest, doesWhatItIsGiven)
{
    int done = 0;
    EXPECT_EQ(queue_.run(WorkKind::kRender, [&](WorkWatch&) { ++done; }), WorkEnd::kDone);
    EXPECT_EQ(queue_.run(WorkKind::kTrace, [&](WorkWatch&) { ++done; }), WorkEnd::kDone);
    EXPECT_EQ(done, 2);
    EXPECT_THROW(queue_.run(WorkKind::kRender, [](WorkWatch&) { throw std::runtime_error("broken"); }),
                 std::runtime_error);
    EXPECT_EQ(queue_.run(WorkKind::kRender, [&](WorkWatch&) { ++done; }), WorkEnd::kDone);
}

TEST_F(LatestQueueTest, aNewerRequestTakesThePlaceOfThatWhichRuns)
{
    Gate first;
    std::future<WorkEnd> old = startGate(WorkKind::kRender, first);
    bool isDone = false;
    EXPECT_EQ(queue_.run(WorkKind::kRender, [&](WorkWatch&) { isDone = true; }), WorkEnd::kDone);
    EXPECT_TRUE(isDone);
    EXPECT_EQ(old.get(), WorkEnd::kSuperseded);
}

TEST_F(LatestQueueTest, ofThoseThatWaitTheNewestIsDone)
{
    Gate trace;
    std::future<WorkEnd> running = startGate(WorkKind::kTrace, trace);
    std::atomic<int> last = 0;
    std::vector<std::future<WorkEnd>> ends;
    for (int i = 1; i <= 3; ++i) {
        ends.push_back(start(WorkKind::kRender, [&last, i](WorkWatch&) { last = i; }));
        std::this_thread::sleep_for(50ms);
    }
    EXPECT_EQ(ends[0].get(), WorkEnd::kSuperseded);
    EXPECT_EQ(ends[1].get(), WorkEnd::kSuperseded);
    trace.isOpen = true;
    EXPECT_EQ(ends[2].get(), WorkEnd::kDone);
    EXPECT_EQ(running.get(), WorkEnd::kDone); // another kind is left alone
    EXPECT_EQ(last, 3);
}

TEST_F(LatestQueueTest, aTraceGoesBeforeARenderThatWaits)
{
    Gate first;
    std::future<WorkEnd> running = startGate(WorkKind::kRender, first);
    // Both wait behind a render that they do not replace; the render among them does.
    std::string order;
    Gate second;
    std::future<WorkEnd> trace = start(WorkKind::kTrace, [&](WorkWatch&) { order += 't'; });
    std::this_thread::sleep_for(50ms);
    std::future<WorkEnd> render = start(WorkKind::kRender, [&](WorkWatch&) { order += 'r'; });
    EXPECT_EQ(trace.get(), WorkEnd::kDone);
    EXPECT_EQ(render.get(), WorkEnd::kDone);
    EXPECT_EQ(running.get(), WorkEnd::kSuperseded);
    EXPECT_EQ(order, "tr");
}

TEST_F(LatestQueueTest, whatDoesNotEndByItselfIsInterrupted)
{
    std::promise<void> isRunning;
    std::future<WorkEnd> stuck = start(WorkKind::kRender, [&](WorkWatch& watch) { // and hears no cancellation
        isRunning.set_value();
        while (!watch.isInterrupted())
            std::this_thread::sleep_for(1ms);
    });
    isRunning.get_future().wait();
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(queue_.run(WorkKind::kRender, [](WorkWatch&) {}), WorkEnd::kDone);
    EXPECT_GE(std::chrono::steady_clock::now() - start, LatestQueue::kGrace);
    EXPECT_EQ(stuck.get(), WorkEnd::kSuperseded);
}

TEST_F(LatestQueueTest, cancellingEndsWhatRunsAndWhatWaits)
{
    EXPECT_FALSE(queue_.cancel());
    Gate gate;
    std::future<WorkEnd> running = startGate(WorkKind::kRender, gate);
    std::future<WorkEnd> waiting = start(WorkKind::kTrace, [](WorkWatch&) {});
    std::this_thread::sleep_for(50ms);
    EXPECT_TRUE(queue_.state().isBusy);
    EXPECT_EQ(queue_.state().progress.total, 2u);
    EXPECT_TRUE(queue_.cancel());
    EXPECT_EQ(running.get(), WorkEnd::kCancelled);
    EXPECT_EQ(waiting.get(), WorkEnd::kCancelled);
    EXPECT_EQ(queue_.run(WorkKind::kRender, [](WorkWatch&) {}), WorkEnd::kDone);
    EXPECT_FALSE(queue_.state().isBusy);
}

TEST_F(LatestQueueTest, whenItIsClosedNobodyWaits)
{
    Gate gate;
    std::future<WorkEnd> running = startGate(WorkKind::kRender, gate);
    queue_.close();
    EXPECT_EQ(running.get(), WorkEnd::kCancelled);
    EXPECT_EQ(queue_.run(WorkKind::kRender, [](WorkWatch&) {}), WorkEnd::kCancelled);
}
