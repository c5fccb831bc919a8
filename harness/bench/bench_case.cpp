#include "harness/bench/bench_case.h"

#include "harness/bench/family.h"
#include "harness/bench/jitter.h"
#include "harness/bench/tracer_yardstick.h"
#include "harness/compile/spirv_module.h"
#include "harness/pass/pass.h"
#include "harness/run/case_flight.h"
#include "harness/run/execute.h"
#include "harness/run/worker_explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr int kGroup = 32;

// `counts`: with the counters, which cost time themselves.
void setOutputs(Case& testCase, bool counts)
{
    testCase.expectations.clear();
    testCase.outputs.clear();
    std::vector<const char*> names{"RayDirWS", "HitDepth", "HitSuccess", "IterationCount", "HitPositionSS"};
    if (testCase.effect == TraceEffect::kRefraction) names.insert(names.end(), {"PathLength", "RayOriginWS"});
    if (const BenchFamily* family = findBenchFamily(testCase.benchFamily)) names = family->outputs;
    if (counts) names.push_back("FetchCount");
    for (const OutputInfo& output : allOutputs()) {
        if (std::find(names.begin(), names.end(), output.name) != names.end()) testCase.outputs.push_back(output);
    }
}

// The answers of one method, at the size of the truth.
struct Answers {
    std::vector<Plane> planes;
    int scale = 1;
    const Plane& plane(std::string_view name) const
    {
        return *std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == name; });
    }
    double at(const Plane& plane, int x, int y, int channel = 0) const
    {
        return plane.at(std::min(x / scale, plane.width - 1), std::min(y / scale, plane.height - 1), channel);
    }
};

double meanOf(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values)
        sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double medianOf(std::vector<double> values)
{
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double meanOfGroupMaxima(const std::vector<double>& values)
{
    std::vector<double> maxima;
    for (size_t i = 0; i < values.size(); i += kGroup) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(i + kGroup, values.size()));
        maxima.push_back(*std::max_element(begin, end));
    }
    return meanOf(maxima);
}

void judgeReflections(const Truth& truth, const Answers& answers, BenchPoint& point)
{
    const Plane& hits = answers.plane("HitSuccess");
    const Plane& positions = answers.plane("HitPositionSS");
    const Plane& depths = answers.plane("HitDepth");
    double answerable = 0, right = 0, falseHits = 0, rays = 0;
    std::vector<double> pixels, depthErrors;
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            rays += 1;
            const bool isHit = answers.at(hits, x, y) == static_cast<double>(HitClass::kHit);
            if (pixel.screen != ScreenKnowledge::kVisible) {
                falseHits += isHit;
                continue;
            }
            answerable += 1;
            depthErrors.push_back(1);
            if (!isHit) continue;
            const glm::dvec2 found(answers.at(positions, x, y, 0), answers.at(positions, x, y, 1));
            const double error = glm::length(static_cast<double>(answers.scale) * found - pixel.hitPositionSS);
            const double depthError = std::abs(answers.at(depths, x, y) / pixel.hitLinearDepth - 1);
            depthErrors.back() = std::min(1.0, depthError);
            if (!(error <= kRightPixels)) continue;
            right += 1;
            pixels.push_back(error);
        }
    }
    const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
    point.errors["Wrong"] = share(answerable - right + falseHits, rays);
    point.errors["Missed"] = share(answerable - right, answerable);
    point.errors["False"] = share(falseHits, rays - answerable);
    point.errors["HitDepth"] = meanOf(depthErrors);
    point.errors["HitPositionSS"] = medianOf(pixels);
}

glm::dvec3 vectorAt(const Answers& answers, const Plane& plane, int x, int y)
{
    return {answers.at(plane, x, y, 0), answers.at(plane, x, y, 1), answers.at(plane, x, y, 2)};
}

void judgeRefractions(const Truth& truth, const Answers& answers, BenchPoint& point)
{
    const Plane& directions = answers.plane("RayDirWS");
    const Plane& origins = answers.plane("RayOriginWS");
    const Plane& lengths = answers.plane("PathLength");
    std::vector<double> angles, distances, paths;
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            const TruthPixel& pixel = truth.at(x, y);
            if (pixel.screen == ScreenKnowledge::kNoRay) continue;
            const glm::dvec3 found = vectorAt(answers, directions, x, y);
            // By both products: the cosine alone has no digits for small angles.
            angles.push_back(glm::degrees(
                std::atan2(glm::length(glm::cross(found, pixel.rayDirWS)), glm::dot(found, pixel.rayDirWS))));
            distances.push_back(glm::length(vectorAt(answers, origins, x, y) - pixel.rayOriginWS));
            paths.push_back(std::abs(answers.at(lengths, x, y) - pixel.pathLength));
        }
    }
    point.errors["RayDirWS"] = meanOf(angles);
    point.errors["RayOriginWS"] = meanOf(distances);
    point.errors["PathLength"] = meanOf(paths);
}

// A method with its job, and what its runs took.
struct Runner {
    Case testCase;
    Job job;
    std::optional<Job> capture; // what stands for the cubemap that the method renders
    int scale = 1;
    JobResult last;
    std::vector<double> milliseconds;
};

// Reads as many pixels of a G-buffer and writes as many of one output as a capture has texels: what rendering it takes
// at the least.
Job makeCaptureJob(int size, ShaderCompiler& compiler, const Folders& folders, Precision precision)
{
    Case capture;
    capture.name = fmt::format("capture {}", size);
    capture.camera.width = size;
    capture.camera.height = kCubeFaces * size;
    Primitive wall;
    wall.center = {0, 0, -1};
    wall.material = "mirror";
    capture.scene.primitives = {wall};
    for (const OutputInfo& output : allOutputs()) {
        if (output.name == "RayDirWS") capture.outputs.push_back(output);
    }
    return buildJob(CaseData(capture), compiler, folders.shaders, precision);
}

Runner makeRunner(const Case& testCase, const BenchMethod& method, ShaderCompiler& compiler, const Folders& folders,
                  Precision precision, bool counts)
{
    Runner runner;
    runner.testCase = testCase;
    runner.testCase.name += " " + method.name;
    method.apply(runner.testCase);
    runner.scale = method.scale;
    runner.testCase.camera.width = std::max(1, testCase.camera.width / method.scale);
    runner.testCase.camera.height = std::max(1, testCase.camera.height / method.scale);
    setOutputs(runner.testCase, counts);
    runner.job = buildJob(CaseData(runner.testCase), compiler, folders.shaders, precision);
    if (method.captureSize > 0) runner.capture = makeCaptureJob(method.captureSize, compiler, folders, precision);
    return runner;
}

JobResult runJob(const Job& job, const std::string& backend, WorkerPool& pool, ShaderCompiler& compiler,
                 const Folders& folders)
{
    JobReport report = runExplained(pool, compiler, folders.shaders, backend, 0, job, std::chrono::seconds(120));
    if (report.outcome == JobOutcome::kShaderError) throw ShaderError(report.text);
    if (report.outcome != JobOutcome::kDone)
        throw EnvironmentError(fmt::format("{} on {}: {}", job.label, backend, report.text));
    return std::move(report.result);
}

double millisecondsOf(const JobResult& result)
{
    return result.times.device >= 0 ? result.times.device : result.times.dispatch;
}

void runOnce(Runner& runner, const std::string& backend, WorkerPool& pool, ShaderCompiler& compiler,
             const Folders& folders)
{
    runner.last = runJob(runner.job, backend, pool, compiler, folders);
    double milliseconds = millisecondsOf(runner.last);
    if (runner.capture) milliseconds += millisecondsOf(runJob(*runner.capture, backend, pool, compiler, folders));
    runner.milliseconds.push_back(milliseconds);
}

BenchTime summarize(const std::vector<double>& milliseconds, double baseline)
{
    BenchTime time;
    time.median = medianOf(milliseconds);
    time.fastest = *std::min_element(milliseconds.begin(), milliseconds.end());
    time.slowest = *std::max_element(milliseconds.begin(), milliseconds.end());
    time.ratio = baseline > 0 ? time.median / baseline : 0;
    return time;
}

// What the method cost, a pixel of the full image: an answer at half size stands for four. A proxy reads nothing but
// the pixel's own depth, which counts as one.
void countCost(const Truth& truth, const Answers& answers, BenchPoint& point)
{
    const Plane& steps = answers.plane("IterationCount");
    const Plane& reads = answers.plane("FetchCount");
    std::vector<double> iterations, fetches;
    for (int y = 0; y < truth.height; y += answers.scale) {
        for (int x = 0; x < truth.width; x += answers.scale) {
            if (truth.at(x, y).screen == ScreenKnowledge::kNoRay) continue;
            iterations.push_back(answers.at(steps, x, y));
            fetches.push_back(std::max(1.0, answers.at(reads, x, y)));
        }
    }
    const double share = 1.0 / (answers.scale * answers.scale);
    point.counters["Iterations"] = share * meanOf(iterations);
    point.counters["IterationsOf32"] = share * meanOfGroupMaxima(iterations);
    point.counters["Fetches"] = share * meanOf(fetches);
    point.counters["FetchesOf32"] = share * meanOfGroupMaxima(fetches);
}

void fillScene(const YardstickScene& rays, BenchScene& scene)
{
    double unknowable = 0;
    for (const YardstickRay& ray : rays.rays)
        unknowable += ray.truth != RayTruth::kAnswerable;
    scene.unknowable = scene.rays > 0 ? unknowable / scene.rays : 0;
    scene.oracleWrong = scoreTracer(rays, depthOracle().prepare(rays)).wrong;
}

void requireMeasurable(const Case& testCase, const BenchOptions& options, const std::vector<BenchMethod>& methods)
{
    for (const BenchMethod& own : options.own) {
        if (testCase.effect == TraceEffect::kRefraction || !testCase.benchFamily.empty()) {
            throw InputError(
                fmt::format("--method {}: {} does not compare tracers; name a case of reflections without a "
                            "family",
                            own.name, testCase.name));
        }
        Case varied = testCase;
        varied.backends.clear();
        own.apply(varied);
        if (const std::string why = whyNotOn(varied, options.backend); !why.empty())
            throw InputError(fmt::format("--method {}: it cannot run on {}: {}", own.name, options.backend, why));
        const auto sameName = [&](const BenchMethod& other) { return other.name == own.name; };
        if (std::count_if(methods.begin(), methods.end(), sameName) > 1)
            throw InputError(fmt::format("--method {}: the name is taken; names are unique", own.name));
    }
}

// What all methods of a case are measured with.
struct Measuring {
    const Case& testCase;
    const BenchOptions& options;
    WorkerPool& pool;
    ShaderCompiler& compiler;
    const Folders& folders;
    Precision precision;
    const CaseData& data;
    const BenchFamily* family; // null: the effect's own
    const void* prepared;      // by the family
    const JitterViews* jitter; // null: nothing to move
};

// Of one method, all directions together. It runs on the device as it does where it is timed, and is not timed here.
double measureFlips(const Measuring& with, const BenchMethod& method, const Answers& still)
{
    const JitterViews& views = *with.jitter;
    const Camera& camera = with.testCase.camera;
    const ClassImage before = classesOf(still.plane("HitSuccess"), still.scale, camera.width, camera.height);
    FlipCount count;
    for (size_t i = 0; i < views.cameras.size(); ++i) {
        Case moved = with.testCase;
        moved.camera = views.cameras[i];
        Runner runner = makeRunner(moved, method, with.compiler, with.folders, with.precision, false);
        runOnce(runner, with.options.backend, with.pool, with.compiler, with.folders);
        const Answers answers{readPlanes(runner.testCase, runner.last), runner.scale};
        countFlips(views.before, views.after[i], before,
                   classesOf(answers.plane("HitSuccess"), runner.scale, camera.width, camera.height), count);
    }
    return count.share();
}

// Fills errors and counters of a method that was timed. Projections run once more, with their counters.
void judgeMethod(const Measuring& with, const BenchMethod& method, const Runner& timed, BenchPoint& point)
{
    const bool isReflection = with.testCase.effect == TraceEffect::kReflection;
    const bool judgesHits = with.family != nullptr ? with.family->judgesHits : isReflection;
    std::optional<Runner> counted;
    if (judgesHits) {
        counted = makeRunner(with.testCase, method, with.compiler, with.folders, with.precision, true);
        runOnce(*counted, with.options.backend, with.pool, with.compiler, with.folders);
    }
    const Runner& judged = counted ? *counted : timed;
    const Answers answers{readPlanes(judged.testCase, judged.last), judged.scale};
    const Truth& truth = with.data.truth();
    if (judgesHits) {
        judgeReflections(truth, answers, point);
        countCost(truth, answers, point);
        if (with.jitter != nullptr) point.errors["Flips"] = measureFlips(with, method, answers);
    }
    if (with.family != nullptr) {
        with.family->judge({with.data, timed.testCase, answers.planes, timed.job, method, with.prepared}, point);
    } else if (!isReflection) {
        judgeRefractions(truth, answers, point);
        const size_t instructions = countSpirvInstructions(timed.job.programs.back().spirv);
        point.counters["Instructions"] = static_cast<double>(instructions);
    }
}

} // namespace

std::string effectNameOf(const Case& testCase)
{
    if (const BenchFamily* const family = findBenchFamily(testCase.benchFamily)) return family->name;
    return testCase.effect == TraceEffect::kReflection ? "reflection" : "refraction";
}

BenchScene benchCase(const Case& testCase, const BenchOptions& options, WorkerPool& pool, ShaderCompiler& compiler,
                     const Folders& folders)
{
    const Precision precision = usesDoubles(options.backend) ? Precision::kDouble : Precision::kFloat;
    const bool isReflection = testCase.effect == TraceEffect::kReflection;
    BenchScene scene;
    scene.name = testCase.name;
    const BenchFamily* const family = findBenchFamily(testCase.benchFamily);
    scene.effect = effectNameOf(testCase);
    scene.parameter = testCase.material.roughness;
    scene.needs = testCase.needs;
    scene.budget = testCase.budget;
    scene.width = testCase.camera.width;
    scene.height = testCase.camera.height;
    Case plain = testCase;
    setOutputs(plain, false);
    const CaseData data(plain);
    const Truth& truth = data.truth();
    std::vector<BenchMethod> methods = makeBenchMethods(testCase);
    methods.insert(methods.end(), options.own.begin(), options.own.end());
    requireMeasurable(testCase, options, methods);
    for (const BenchMethod& own : options.own) // what is wrong in a person's file is said at once
        makeRunner(testCase, own, compiler, folders, precision, false);
    const BenchMethod baseline{"", "", [](Case& varied) {
                                   varied.projection.model = ProjectionModel::kNone;
                                   varied.material.refractionModel = RefractionModel::kNone;
                                   varied.hierarchy = 0;
                                   varied.history.reset();
                               }};
    std::vector<Runner> runners{makeRunner(testCase, baseline, compiler, folders, precision, false)};
    for (const BenchMethod& method : methods)
        runners.push_back(makeRunner(testCase, method, compiler, folders, precision, false));
    for (int round = -1; round < options.rounds; ++round) {
        for (Runner& runner : runners) {
            runOnce(runner, options.backend, pool, compiler, folders);
            if (round < 0) runner.milliseconds.clear(); // the first one compiles
        }
    }
    scene.baselineMs = medianOf(runners[0].milliseconds);
    scene.rays = static_cast<double>(std::count_if(truth.pixels.begin(), truth.pixels.end(), [](const TruthPixel& p) {
        return p.screen != ScreenKnowledge::kNoRay;
    }));
    std::shared_ptr<const void> prepared;
    if (family != nullptr && family->prepare != nullptr) prepared = family->prepare(data);
    if (isReflection && family == nullptr) fillScene(makeYardstickScene(data), scene);
    std::optional<JitterViews> jitter;
    const bool canMove = isReflection && family == nullptr && !testCase.recorded && !testCase.history;
    if (options.jitter && canMove) {
        jitter = makeJitterViews(testCase, truth);
        scene.trueFlips = jitter->truth.share();
    }
    const Measuring measuring{testCase,  options, pool,   compiler,       folders,
                              precision, data,    family, prepared.get(), jitter ? &*jitter : nullptr};
    for (size_t i = 0; i < methods.size(); ++i) {
        const Runner& runner = runners[i + 1];
        BenchPoint point{methods[i].name, methods[i].kind, {}, {}, summarize(runner.milliseconds, scene.baselineMs)};
        judgeMethod(measuring, methods[i], runner, point);
        scene.points.push_back(std::move(point));
    }
    return scene;
}

} // namespace crossray
