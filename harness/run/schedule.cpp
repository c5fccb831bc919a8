#include "harness/run/schedule.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace crossray {

namespace {
constexpr size_t kNone = static_cast<size_t>(-1);
}

Schedule::Schedule(std::vector<std::vector<bool>> applies, std::vector<size_t> caseBytes, size_t cores, Limits limits)
    : cases_(applies.size()), backends_(applies.empty() ? 0 : applies.front().size()), caseBytes_(std::move(caseBytes)),
      warm_(cores, std::vector<bool>(backends_.size(), false)), current_(cores, kNone), limits_(limits)
{
    assert(caseBytes_.size() == cases_.size() && cores > 0);
    for (size_t i = 0; i < cases_.size(); ++i) {
        for (const bool runs : applies[i]) {
            cases_[i].backends.push_back(runs ? State::kWaiting : State::kDone);
            if (runs) ++cases_[i].open;
        }
    }
}

bool Schedule::isComplete(size_t caseIndex) const
{
    return cases_[caseIndex].open == 0;
}

bool Schedule::canPrepare() const
{
    if (nextCase_ >= cases_.size()) return false;
    if (inFlight_ == 0) return true; // a case larger than the bound still has to run
    return inFlight_ < limits_.casesInFlight && bytesInFlight_ + caseBytes_[nextCase_] <= limits_.bytesInFlight;
}

bool Schedule::isWorthAWorker(size_t core, size_t backend) const
{
    if (warm_[core][backend]) return true;
    const bool someoneIsWarm =
        std::any_of(warm_.begin(), warm_.end(), [&](const std::vector<bool>& ofCore) { return ofCore[backend]; });
    if (!someoneIsWarm) return true;
    const BackendState& state = backends_[backend];
    if (state.finished == 0) return state.ready > 1;
    const double waitingMs = state.totalMs / static_cast<double>(state.finished) * static_cast<double>(state.ready);
    return waitingMs > limits_.workerStartMs;
}

// The backend to turn to when the current one has no work: one that is warm here, then one that nobody serves, then the
// longest queue.
size_t Schedule::chooseBackend(size_t core) const
{
    size_t best = kNone;
    auto rank = [&](size_t backend) {
        const bool served = std::find(current_.begin(), current_.end(), backend) != current_.end();
        return std::tuple(bool(warm_[core][backend]), !served, backends_[backend].ready);
    };
    for (size_t backend = 0; backend < backends_.size(); ++backend) {
        if (backends_[backend].ready == 0 || !isWorthAWorker(core, backend)) continue;
        if (best == kNone || rank(backend) > rank(best)) best = backend;
    }
    return best;
}

Task Schedule::takeRun(size_t core, size_t backend)
{
    current_[core] = backend;
    warm_[core][backend] = true;
    for (size_t i = firstOpen_; i < nextCase_; ++i) {
        if (cases_[i].backends[backend] != State::kReady) continue;
        cases_[i].backends[backend] = State::kRunning;
        --backends_[backend].ready;
        return {Task::Kind::kRun, i, backend};
    }
    assert(false && "a ready job was counted and is not there");
    return {Task::Kind::kDone, 0, 0};
}

Task Schedule::next(size_t core)
{
    if (stopped_) return {Task::Kind::kDone, 0, 0};
    const size_t current = current_[core];
    if (current != kNone && backends_[current].ready > 0) return takeRun(core, current);
    // The first case is run before the second is prepared, so that the first verdict comes soon.
    const size_t other = chooseBackend(core);
    const bool isFirst = current == kNone && other != kNone;
    if (!isFirst && canPrepare()) {
        const size_t caseIndex = nextCase_++;
        CaseState& state = cases_[caseIndex];
        state.inFlight = true;
        ++inFlight_;
        bytesInFlight_ += caseBytes_[caseIndex];
        return {Task::Kind::kPrepare, caseIndex, 0};
    }
    if (other != kNone) return takeRun(core, other);
    const bool allHandedOut = nextCase_ >= cases_.size() && firstOpen_ >= cases_.size();
    return {allHandedOut ? Task::Kind::kDone : Task::Kind::kWait, 0, 0};
}

void Schedule::complete(size_t caseIndex)
{
    CaseState& state = cases_[caseIndex];
    if (state.inFlight) {
        state.inFlight = false;
        --inFlight_;
        bytesInFlight_ -= caseBytes_[caseIndex];
    }
    while (firstOpen_ < nextCase_ && isComplete(firstOpen_) && !cases_[firstOpen_].inFlight)
        ++firstOpen_;
}

void Schedule::finishPrepare(size_t caseIndex, bool usable)
{
    CaseState& state = cases_[caseIndex];
    for (size_t backend = 0; backend < backends_.size(); ++backend) {
        if (state.backends[backend] != State::kWaiting) continue;
        state.backends[backend] = usable ? State::kReady : State::kDone;
        if (usable) ++backends_[backend].ready;
    }
    if (!usable) state.open = 0;
    if (state.open == 0) complete(caseIndex);
}

void Schedule::finishRun([[maybe_unused]] size_t core, size_t caseIndex, size_t backend, double milliseconds)
{
    CaseState& state = cases_[caseIndex];
    assert(core < warm_.size() && state.backends[backend] == State::kRunning);
    state.backends[backend] = State::kDone;
    backends_[backend].totalMs += milliseconds;
    ++backends_[backend].finished;
    if (--state.open == 0) complete(caseIndex);
}

} // namespace crossray
