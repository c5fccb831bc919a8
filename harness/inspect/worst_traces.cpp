#include "harness/inspect/worst_traces.h"

#include "harness/inspect/trace_json.h"
#include "harness/run/plane_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>
#include <vector>

namespace crossray {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kReference = "cpu64";
// A job that begins just before the time is over has at least this long.
constexpr std::chrono::duration<double> kLeastTimeout{2};

struct Wish {
    const Case* testCase = nullptr;
    BackendResult* result = nullptr;
    glm::ivec2 pixel{0};
    size_t rank = 0; // among the case's own
};

std::vector<Wish> listWishes(RunResult& run, std::span<const Case> cases)
{
    std::map<std::string_view, const Case*> byName;
    for (const Case& testCase : cases)
        byName.emplace(testCase.name, &testCase);
    std::vector<Wish> wishes;
    for (CaseResult& testCase : run.cases) {
        const auto found = byName.find(testCase.name);
        if (found == byName.end()) continue;
        size_t rank = 0;
        for (BackendResult& result : testCase.backends) {
            if (result.verdict != Verdict::kFail) continue;
            const ExpectationResult* const worst = findWorstExpectation(testCase, result);
            if (worst == nullptr || !worst->comparison.worst) continue;
            const PixelDifference& place = *worst->comparison.worst;
            wishes.push_back({found->second, &result, {place.x, place.y}, rank++});
        }
    }
    std::stable_sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) { return a.rank < b.rank; });
    return wishes;
}

std::string firstLine(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

void grant(const Wish& wish, const PlaneFiles& files, const TraceStep& trace, int core,
           std::chrono::duration<double> timeout)
{
    const std::string& backend = wish.result->backend;
    std::vector<std::string> backends{backend};
    if (backend != kReference && whyNotTraced(*wish.testCase, kReference).empty()) backends.emplace_back(kReference);
    try {
        const PixelTrace made = trace(*wish.testCase, wish.pixel, backends, core, timeout);
        wish.result->traceFile = files.writeTrace(wish.testCase->name, backend, formatTraceJson(made));
    } catch (const std::exception& error) {
        wish.result->traceNote = firstLine(error.what());
    }
}

} // namespace

TraceStep makeTraceStep(WorkerPool& pool, ShaderCompiler& compiler, const std::filesystem::path& shaders)
{
    return [&pool, &compiler, shaders](const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends,
                                       int core, std::chrono::duration<double> timeout) {
        return tracePixel(testCase, pixel, backends, TraceWorkers{pool, compiler, shaders, core, timeout});
    };
}

void keepWorstTraces(RunResult& run, std::span<const Case> cases, const std::filesystem::path& runFolder,
                     const TraceStep& trace, const WorstTraceLimits& limits, const std::atomic<bool>& interrupted)
{
    const std::vector<Wish> wishes = listWishes(run, cases);
    const size_t count = std::min(wishes.size(), limits.most);
    for (size_t i = count; i < wishes.size(); ++i)
        wishes[i].result->traceNote = fmt::format("a run keeps {} traces at most", limits.most);
    const PlaneFiles files(runFolder);
    const Clock::time_point start = Clock::now();
    std::atomic<size_t> next{0};
    const auto serve = [&](int core) {
        for (size_t i = next++; i < count; i = next++) {
            const std::chrono::duration<double> left = limits.time - (Clock::now() - start);
            if (interrupted) {
                wishes[i].result->traceNote = "the run was interrupted";
            } else if (left.count() <= 0) {
                wishes[i].result->traceNote = fmt::format("the {:g} s for traces were over", limits.time.count());
            } else {
                grant(wishes[i], files, trace, core, std::max(left, kLeastTimeout));
            }
        }
    };
    std::vector<std::jthread> threads;
    const int most = static_cast<int>(std::min<size_t>(count, static_cast<size_t>(std::max(limits.threads, 1))));
    for (int core = 0; core < most; ++core)
        threads.emplace_back(serve, core);
}

} // namespace crossray
