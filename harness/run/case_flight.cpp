#include "harness/run/case_flight.h"

#include "harness/run/plane_files.h"
#include "harness/run/verdict.h"
#include "harness/scene/exr.h"

#include <algorithm>

namespace crossray {

namespace {

bool wantsPlanes(KeepPlanes keep, const BackendResult& result)
{
    if (keep == KeepPlanes::kFailed) {
        return tallyOf(result.verdict) == Tally::kFailed || result.verdict == Verdict::kKnownFail;
    }
    return keep == KeepPlanes::kAll;
}

size_t countBytes(const std::vector<Plane>& planes)
{
    size_t bytes = 0;
    for (const Plane& plane : planes)
        bytes += plane.values.size() * sizeof(double);
    return bytes;
}

} // namespace

std::string whyNotOn(const Case& testCase, const std::string& backend)
{
    const std::vector<std::string>& named = testCase.backends;
    if (!named.empty() && std::find(named.begin(), named.end(), backend) == named.end())
        return "the case does not name this backend";
    const bool isCompiledAhead = backend == "cpu32" || backend == "cpu64";
    if (testCase.projection.model == ProjectionModel::kOwn && isCompiledAhead)
        return "an own tracer is GLSL, and this backend's code is compiled ahead";
    return {};
}

bool runsOn(const Case& testCase, const std::string& backend)
{
    return whyNotOn(testCase, backend).empty();
}

CaseFlight::CaseFlight(const Case& testCase, PreparedCase prepared, const ExecuteOptions& options)
    : testCase_(testCase), prepared_(std::move(prepared)), options_(options),
      conditioning_(std::make_shared<LazyConditioning>([this] {
          return measureConditioning(testCase_, *prepared_.floatJob, *prepared_.doubleJob, prepared_.askCpu);
      })),
      judge_(prepared_.data, conditioning_)
{
}

bool CaseFlight::waitsForReference(const std::string& backend) const
{
    const std::vector<std::string> references = judge_.referencesOf(backend);
    return std::any_of(references.begin(), references.end(), [&](const std::string& reference) {
        const bool comes = runsOn(testCase_, reference) && std::find(options_.backends.begin(), options_.backends.end(),
                                                                     reference) != options_.backends.end();
        return comes && !answered_.contains(reference);
    });
}

CaseFlight::Settled CaseFlight::take(Answer answer, bool repeatsExactly)
{
    const std::lock_guard lock(mutex_);
    Settled settled;
    const std::string backend = answer.result.backend;
    answered_.insert(backend);
    if (!answer.planes.empty()) planes_[backend] = std::move(answer.planes);
    waiting_[backend] = {std::move(answer.result), repeatsExactly ? std::move(answer.difference) : std::string()};
    // The answer may be the one that others waited for.
    std::vector<std::string> ready;
    for (const auto& [name, unused] : waiting_) {
        if (!waitsForReference(name)) ready.push_back(name);
    }
    for (const std::string& name : ready)
        settle(name, settled);
    return settled;
}

CaseFlight::Settled CaseFlight::finish()
{
    const std::lock_guard lock(mutex_);
    Settled settled;
    while (!waiting_.empty())
        settle(std::string(waiting_.begin()->first), settled);
    return settled;
}

void CaseFlight::settle(const std::string& backend, Settled& settled)
{
    Waiting waiting = std::move(waiting_.at(backend));
    waiting_.erase(backend);
    BackendResult& result = waiting.result;
    if (planes_.contains(backend)) {
        const auto start = std::chrono::steady_clock::now();
        try {
            auto agreements = judge_.judgeAgreements(backend, planes_);
            std::move(agreements.begin(), agreements.end(), std::back_inserter(result.expectations));
            const Judgement judgement = judgeAnswer(testCase_, result, judge_.isReference(backend));
            result.verdict = judgement.verdict;
            result.reason = judgement.reason;
        } catch (const InputError& error) {
            settled.brokenInput.emplace_back(error.what());
            result = makeErrorResult(backend, error.what());
        }
        if (!waiting.difference.empty() && result.verdict != Verdict::kError) {
            result.verdict = Verdict::kFail;
            result.reason = waiting.difference;
        }
        result.times.judge +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    const Judgement final = applyKnownFailures(testCase_, backend, options_.today, {result.verdict, result.reason});
    result.verdict = final.verdict;
    result.reason = final.reason;
    dropPlanes(result);
    settled.results.push_back(std::move(result));
}

// Planes are most of what a case holds in memory. What passed stays beside what may still fail, as far as it is small.
void CaseFlight::dropPlanes(const BackendResult& result)
{
    if (judge_.isReference(result.backend) || wantsPlanes(options_.keepPlanes, result)) return;
    const auto planes = planes_.find(result.backend);
    if (planes == planes_.end()) return;
    const size_t bytes = countBytes(planes->second);
    const bool isCompany = options_.keepPlanes == KeepPlanes::kFailed && !options_.outputFolder.empty();
    if (isCompany && companyBytes_ + bytes <= kMaxCompanyBytes) {
        companyBytes_ += bytes;
    } else {
        planes_.erase(planes);
    }
}

void CaseFlight::writePlanes(CaseResult& result) const
{
    const Conditioning* conditioning = conditioning_->known();
    if (conditioning) result.conditioning = summarize(*conditioning, prepared_.data->tracedPixels());
    if (options_.keepPlanes == KeepPlanes::kNone || options_.outputFolder.empty()) return;
    const PlaneFiles files(options_.outputFolder);
    const auto writeConditioning = [&] {
        if (!conditioning || conditioning->outputs.empty()) return;
        result.conditioning->file = files.write(result.name, "conditioning", listConditioningPlanes(*conditioning));
    };
    if (options_.conditioning) writeConditioning();
    const bool isWanted = std::any_of(result.backends.begin(), result.backends.end(),
                                      [&](const auto& backend) { return wantsPlanes(options_.keepPlanes, backend); });
    if (!isWanted) return;
    if (!options_.conditioning) writeConditioning();
    bool keptAny = false;
    for (BackendResult& backend : result.backends) {
        const auto planes = planes_.find(backend.backend);
        if (planes == planes_.end()) continue;
        backend.planesFile = files.write(result.name, backend.backend, planes->second);
        keptAny = true;
    }
    if (!keptAny) return;
    std::vector<Plane> expected = judge_.takeExpectedPlanes();
    int channels = 0;
    for (const Plane& plane : expected)
        channels += plane.channels;
    for (Plane& mask : judge_.makeMaskPlanes()) {
        if (++channels <= kMaxExrChannels) expected.push_back(std::move(mask));
    }
    if (!expected.empty()) result.expectedFile = files.write(result.name, "expected", expected);
}

} // namespace crossray
