#include "harness/inspect/pixel_trace.h"

#include "harness/inspect/names.h"
#include "harness/run/case_flight.h"
#include "harness/run/execute.h"
#include "harness/run/steps.h"
#include "harness/run/worker_explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace crossray {

namespace {

std::optional<int> parseWhole(std::string_view text)
{
    int value = 0;
    const auto [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || rest != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string describeStep(const RecordOnBackend& trace, size_t index)
{
    const std::vector<RecordedStep>& steps = trace.record.steps;
    if (index >= steps.size()) return fmt::format("{} has ended", trace.backend);
    const RecordedStep& step = steps[index];
    return fmt::format("{} is in cell {},{} of level {} with intersection {}", trace.backend, step.cell.x, step.cell.y,
                       step.level, nameOfIntersection(static_cast<int>(step.kind)));
}

std::string describeAnswer(const RecordOnBackend& trace)
{
    const PixelRecord& record = trace.record;
    const std::string reason = record.reason == 0 ? "" : fmt::format(" ({})", nameOfReason(record.reason));
    return fmt::format("{} says {}{}", trace.backend, nameOf(record.hitClass), reason);
}

bool isSameStep(const RecordedStep& a, const RecordedStep& b)
{
    return a.level == b.level && a.cell == b.cell && a.kind == b.kind;
}

double relativeDifference(double a, double b)
{
    const double size = std::max(std::abs(a), std::abs(b));
    return size > 0 ? std::abs(a - b) / size : 0;
}

void requireTraced(const Case& testCase, std::span<const std::string> backends)
{
    for (const std::string& backend : backends) {
        if (const std::string why = whyNotTraced(testCase, backend); !why.empty())
            throw InputError(fmt::format("{}: {} is not traced there: {}", backend, testCase.name, why));
    }
}

PixelRecord recordOn(const std::string& backend, const CaseData& data, glm::ivec2 pixel, const TraceWorkers& workers)
{
    const Precision precision = usesDoubles(backend) ? Precision::kDouble : Precision::kFloat;
    const Job job = buildRecordJob(data, workers.compiler, workers.shaders, precision, pixel);
    workers.pool.fingerprint(backend, workers.core); // says what is missing where the device cannot be opened
    const JobReport report =
        runExplained(workers.pool, workers.compiler, workers.shaders, backend, workers.core, job, workers.timeout);
    if (report.outcome == JobOutcome::kShaderError) throw ShaderError(fmt::format("{}: {}", backend, report.text));
    if (report.outcome != JobOutcome::kDone) throw EnvironmentError(fmt::format("{}: {}", backend, report.text));
    return readRecord(pixel, report.result);
}

} // namespace

glm::ivec2 parsePixel(const std::string& text)
{
    const size_t comma = text.find(',');
    const auto x = parseWhole(std::string_view(text).substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parseWhole(std::string_view(text).substr(comma + 1));
    if (!x || !y) throw InputError(fmt::format("--pixel {}: allowed is X,Y in whole pixels from the top left", text));
    return {*x, *y};
}

std::optional<Parting> findParting(const RecordOnBackend& first, const RecordOnBackend& second)
{
    const PixelRecord &a = first.record, &b = second.record;
    const size_t steps = std::max(a.steps.size(), b.steps.size());
    for (size_t i = 0; i < steps; ++i) {
        if (i < a.steps.size() && i < b.steps.size() && isSameStep(a.steps[i], b.steps[i])) continue;
        return Parting{static_cast<int>(i), fmt::format("They part at step {}: {}, {}.", i, describeStep(first, i),
                                                        describeStep(second, i))};
    }
    if (a.hitClass == b.hitClass && a.reason == b.reason) return std::nullopt;
    const char* const where = steps > 0 ? "They take the same steps and part in the answer" : "They part in the answer";
    return Parting{-1, fmt::format("{}: {}, {}.", where, describeAnswer(first), describeAnswer(second))};
}

RecordDistance measureDistance(const PixelRecord& first, const PixelRecord& second)
{
    RecordDistance distance{glm::distance(first.endSS, second.endSS),
                            relativeDifference(first.endDepth, second.endDepth)};
    for (size_t i = 0; i < std::min(first.steps.size(), second.steps.size()); ++i) {
        const RecordedStep &a = first.steps[i], &b = second.steps[i];
        distance.pixels = std::max(distance.pixels, glm::distance(a.positionSS, b.positionSS));
        distance.depth = std::max(distance.depth, relativeDifference(a.rayLinearDepth, b.rayLinearDepth));
    }
    return distance;
}

std::string whyNotTraced(const Case& testCase, const std::string& backend)
{
    return testCase.projection.model == ProjectionModel::kOwn ? whyNotOn(testCase, backend) : std::string();
}

PixelTrace tracePixel(const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends,
                      const TraceWorkers& workers)
{
    requireTraced(testCase, backends);
    return tracePixel(CaseData(prepareForRecord(testCase)), pixel, backends, workers);
}

PixelTrace tracePixel(const CaseData& data, glm::ivec2 pixel, std::span<const std::string> backends,
                      const TraceWorkers& workers)
{
    const Case& testCase = data.testCase();
    requireTraced(testCase, backends);
    PixelTrace trace{testCase.name, testCase.summary, pixel, {}, {}, {}, {}};
    for (const std::string& backend : backends)
        trace.records.push_back({backend, recordOn(backend, data, pixel, workers)});
    if (trace.records.size() == 2) trace.parting = findParting(trace.records[0], trace.records[1]);
    return trace;
}

PixelTrace tracePixel(const Case& testCase, glm::ivec2 pixel, std::span<const std::string> backends,
                      const Folders& folders)
{
    WorkerOptions options;
    options.mesaCacheFolder = folders.cache / "mesa";
    WorkerPool pool(options);
    ShaderCompiler compiler(folders.cache / "spirv");
    const std::chrono::duration<double> timeout(std::max(testCase.timeoutSeconds, 60.0));
    return tracePixel(testCase, pixel, backends, TraceWorkers{pool, compiler, folders.shaders, 0, timeout});
}

} // namespace crossray
