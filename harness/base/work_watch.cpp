#include "harness/base/work_watch.h"

#include <utility>

namespace crossray {

namespace {

thread_local WorkWatch* watchOfThread = nullptr;

} // namespace

void WorkWatch::begin(std::string what, size_t total)
{
    {
        const std::lock_guard lock(mutex_);
        what_ = std::move(what);
    }
    note(0, total);
}

void WorkWatch::note(size_t done, size_t total)
{
    done_ = done;
    total_ = total;
    if (isCancelled_) throw WorkCancelled();
}

WorkWatch::Progress WorkWatch::progress() const
{
    const std::lock_guard lock(mutex_);
    return {what_, done_, total_};
}

WatchedWork::WatchedWork(WorkWatch& watch) : before_(std::exchange(watchOfThread, &watch)) {}

WatchedWork::~WatchedWork()
{
    watchOfThread = before_;
}

void noteWork(size_t done, size_t total)
{
    if (watchOfThread != nullptr) watchOfThread->note(done, total);
}

} // namespace crossray
