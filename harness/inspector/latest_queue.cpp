#include "harness/inspector/latest_queue.h"

#include <utility>

namespace crossray {

LatestQueue::LatestQueue() : thread_([this] { serve(); }) {}

LatestQueue::~LatestQueue()
{
    close();
    {
        const std::lock_guard lock(mutex_);
        isOver_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LatestQueue::finish(Ticket& ticket, WorkEnd end)
{
    if (!ticket.end) ticket.end = end;
    changed_.notify_all();
}

WorkEnd LatestQueue::run(WorkKind kind, std::function<void(WorkWatch&)> work)
{
    const auto ticket = std::make_shared<Ticket>();
    ticket->kind = kind;
    ticket->work = std::move(work);
    std::unique_lock lock(mutex_);
    if (isClosed_) return WorkEnd::kCancelled;
    std::shared_ptr<Ticket>& place = waiting_[static_cast<size_t>(kind)];
    if (place) finish(*place, WorkEnd::kSuperseded);
    place = ticket;
    if (running_ && running_->kind == kind && !running_->end) {
        running_->watch.cancel();
        running_->unwantedSince = Clock::now();
        finish(*running_, WorkEnd::kSuperseded);
    }
    changed_.notify_all();
    while (!ticket->end)
        interruptWhenDue(lock);
    if (*ticket->end == WorkEnd::kDone && ticket->failure) std::rethrow_exception(ticket->failure);
    return *ticket->end;
}

// Whoever waits for the thread looks after what keeps it busy for nobody.
void LatestQueue::interruptWhenDue(std::unique_lock<std::mutex>& lock)
{
    if (!running_ || !running_->end || running_->watch.isInterrupted()) return changed_.wait(lock);
    const Clock::time_point due = running_->unwantedSince + kGrace;
    if (Clock::now() < due)
        changed_.wait_until(lock, due);
    else
        running_->watch.interrupt();
}

bool LatestQueue::cancel()
{
    const std::lock_guard lock(mutex_);
    bool hadWork = false;
    for (std::shared_ptr<Ticket>& waiting : waiting_) {
        if (!waiting) continue;
        finish(*waiting, WorkEnd::kCancelled);
        waiting.reset();
        hadWork = true;
    }
    if (!running_) return hadWork;
    running_->watch.interrupt();
    finish(*running_, WorkEnd::kCancelled);
    return true;
}

void LatestQueue::close()
{
    {
        const std::lock_guard lock(mutex_);
        isClosed_ = true;
    }
    cancel();
}

LatestQueue::State LatestQueue::state() const
{
    const std::lock_guard lock(mutex_);
    if (!running_) return {};
    const std::chrono::duration<double> passed = Clock::now() - running_->started;
    return {true, running_->watch.progress(), passed.count()};
}

void LatestQueue::serve()
{
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return isOver_ || waiting_[0] || waiting_[1]; });
        if (isOver_) return;
        running_ = std::exchange(waiting_[waiting_[0] ? 0 : 1], nullptr);
        running_->started = Clock::now();
        const std::shared_ptr<Ticket> ticket = running_;
        lock.unlock();
        std::exception_ptr failure;
        try {
            const WatchedWork watched(ticket->watch);
            ticket->work(ticket->watch);
        } catch (...) {
            failure = std::current_exception();
        }
        ticket->work = nullptr; // what it holds ends here, and not with the one who asked
        lock.lock();
        running_.reset();
        if (!ticket->end) ticket->failure = failure;
        finish(*ticket, WorkEnd::kDone);
    }
}

} // namespace crossray
