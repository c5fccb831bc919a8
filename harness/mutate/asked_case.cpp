#include "harness/mutate/asked_case.h"

#include "harness/base/error.h"
#include "harness/pass/pass.h"
#include "harness/pass/trace_variant.h"
#include "harness/run/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>

namespace crossray {

namespace {

// Beside the usual time: what a loaded machine may take for a job that is about to answer.
constexpr double kGraceSeconds = 2.0;
constexpr double kUsualTimes = 10.0;
constexpr double kFirstSeconds = 60.0; // for the library as it is

const Plane* findPlane(const std::vector<Plane>& planes, std::string_view name)
{
    const auto found =
        std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

// Pixels that differ in any bit; NaN is a value like any other.
size_t countDifferent(const Plane& a, const Plane& b)
{
    size_t count = 0;
    const auto channels = static_cast<size_t>(a.channels);
    for (size_t pixel = 0; pixel < a.pixelCount(); ++pixel) {
        for (size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) {
            if (std::bit_cast<uint64_t>(a.values[i]) == std::bit_cast<uint64_t>(b.values[i])) continue;
            ++count;
            break;
        }
    }
    return count;
}

std::set<std::string> findIncludes(const std::filesystem::path& tracer)
{
    constexpr std::string_view kInclude = "#include \"";
    std::set<std::string> found;
    std::ifstream file(tracer);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(kInclude)) continue;
        found.insert(line.substr(kInclude.size(), line.find('"', kInclude.size()) - kInclude.size()));
    }
    return found;
}

} // namespace

std::vector<Case> shareOutputs(const std::vector<Case>& cases)
{
    using Group = std::pair<std::filesystem::path, std::map<std::string, double>>;
    const auto groupOf = [](const Case& testCase) {
        std::map<std::string, double> variant = makeTraceVariant(testCase);
        variant.erase("kOutputMask");
        return Group{testCase.projection.own.tracer, std::move(variant)};
    };
    std::map<Group, std::map<int, OutputInfo>> outputs;
    for (const Case& testCase : cases) {
        auto& all = outputs[groupOf(testCase)];
        for (const OutputInfo& output : testCase.outputs)
            all.emplace(output.id, output);
    }
    std::vector<Case> shared = cases;
    for (Case& testCase : shared) {
        testCase.outputs.clear();
        for (const auto& [id, output] : outputs[groupOf(testCase)])
            testCase.outputs.push_back(output);
    }
    return shared;
}

AskedCase::AskedCase(const Case& original, Case widened, MutantLibrary& library)
    : original_(original), widened_(std::move(widened))
{
    const CaseData data(widened_);
    LibraryCompiler compiler(library, true);
    const Job job = buildJob(data, compiler, library.root(), Precision::kFloat);
    for (const ProgramSource& program : job.programs) {
        const bool isOwn = program.entry == "entry/own_trace.comp";
        if (isOwn) included_ = findIncludes(original_.projection.own.tracer);
        programs_.push_back(
            {program.entry, isOwn ? original_.projection.own.tracer : std::filesystem::path{}, program.specialization});
    }
}

double AskedCase::pixels() const
{
    return double{1} * original_.camera.width * original_.camera.height;
}

const std::string& AskedCase::prepare(MutantLibrary& library, WorkerPool& pool, const std::string& backend, int core)
{
    const std::lock_guard lock(making_);
    if (isReady_) return leftOut_;
    try {
        leftOut_ = makeReady(library, pool, backend, core);
    } catch (const InputError& error) {
        leftOut_ = error.what();
    } catch (const ShaderError& error) {
        leftOut_ = error.what();
    }
    isReady_ = true;
    if (!leftOut_.empty()) job_ = {};
    return leftOut_;
}

std::string AskedCase::makeReady(MutantLibrary& library, WorkerPool& pool, const std::string& backend, int core)
{
    LibraryCompiler compiler(library, false);
    data_ = std::make_shared<const CaseData>(widened_);
    job_ = buildJob(*data_, compiler, library.root(), Precision::kFloat);
    judge_.emplace(data_);
    Answer answer = run(job_, pool, backend, core, kFirstSeconds);
    if (!answer.how.empty()) return fmt::format("without a bug: {}: {}", answer.how, answer.reason);
    usualMs_ = answer.milliseconds;
    result_ = judge(backend, answer.planes);
    const Judgement judgement = judgeAnswer(original_, result_, false);
    if (judgement.verdict == Verdict::kSkip) return "has agreements alone";
    if (judgement.verdict != Verdict::kPass) return "fails without a bug: " + judgement.reason;
    planes_ = std::move(answer.planes);
    return {};
}

AskedCase::Answer AskedCase::run(const Job& job, WorkerPool& pool, const std::string& backend, int core,
                                 double seconds) const
{
    const JobReport report = pool.run(backend, core, job, std::chrono::duration<double>(seconds));
    Answer answer;
    answer.milliseconds = report.milliseconds;
    answer.reason = report.text.substr(0, report.text.find('\n'));
    switch (report.outcome) {
    case JobOutcome::kDone:
        break;
    case JobOutcome::kCrash:
        answer.how = "crash";
        return answer;
    case JobOutcome::kTimeout:
        answer.how = "timeout";
        return answer;
    default:
        answer.how = "error";
        return answer;
    }
    try {
        answer.planes = readPlanes(widened_, report.result);
    } catch (const ShaderError& error) { // a person's own tracer whose loop did not end
        answer.how = "error";
        answer.reason = error.what();
    }
    // What others of its group write must not change how this one is judged.
    std::erase_if(answer.planes, [&](const Plane& plane) {
        return std::none_of(original_.outputs.begin(), original_.outputs.end(),
                            [&](const OutputInfo& output) { return output.name == plane.name; });
    });
    return answer;
}

BackendResult AskedCase::judge(const std::string& backend, const std::vector<Plane>& planes)
{
    BackendResult result;
    result.backend = backend;
    result.expectations = judge_->judgeAlone(backend, planes);
    return result;
}

AskedCase::Finding AskedCase::ask(const std::vector<std::vector<uint32_t>>& programs, WorkerPool& pool,
                                  const std::string& backend, int core)
{
    Job job = job_;
    for (size_t i = 0; i < job.programs.size(); ++i) {
        job.programs[i].spirv = programs[i];
        job.programs[i].key = makeProgramKey(programs[i]);
    }
    const Answer answer = run(job, pool, backend, core, kGraceSeconds + kUsualTimes * usualMs_ / 1000);
    Finding finding;
    finding.milliseconds = answer.milliseconds;
    finding.how = answer.how;
    finding.reason = answer.reason;
    finding.isCaught = !answer.how.empty();
    if (finding.isCaught) return finding;
    const BackendResult result = judge(backend, answer.planes);
    const Judgement judgement = judgeAnswer(original_, result, false);
    finding.isCaught = judgement.verdict != Verdict::kPass;
    if (finding.isCaught) {
        finding.how = "fail";
        finding.reason = judgement.reason;
    } else {
        finding.seen = compare(result, answer.planes);
    }
    return finding;
}

std::vector<SeenDifference> AskedCase::compare(const BackendResult& result, const std::vector<Plane>& planes) const
{
    std::vector<SeenDifference> seen;
    for (size_t i = 0; i < result.expectations.size() && i < result_.expectations.size(); ++i) {
        const ExpectationResult& now = result.expectations[i];
        const Plane* const before = findPlane(planes_, now.output);
        const Plane* const after = findPlane(planes, now.output);
        if (before == nullptr || after == nullptr) continue;
        const size_t pixels = countDifferent(*before, *after);
        if (pixels == 0) continue;
        seen.push_back({original_.name, now.output, now.tolerance, now.comparison.unit, pixels,
                        result_.expectations[i].comparison.max, now.comparison.max});
    }
    return seen;
}

} // namespace crossray
