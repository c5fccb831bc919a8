// The methods that `bench CASE` measures, and their counters.
#include "harness/bench/bench_case.h"

#include "harness/bench/tracer_yardstick.h"
#include "harness/pass/pass.h"
#include "harness/run/worker_pool.h"
#include "tests/unit/bench/find_method.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

using namespace crossray;

namespace {

const std::filesystem::path kSource = CROSSRAY_SOURCE_DIR;

Case readCase(const std::string& name)
{
    return readCaseFile(kSource / "cases" / (name + ".toml")).at(0);
}

// Reads a ray as the pass itself counts them on the CPU.
double countReads(Case testCase, const BenchMethod& method)
{
    method.apply(testCase);
    testCase.expectations.clear();
    testCase.outputs = {*findOutput("FetchCount")};
    ShaderCompiler compiler({});
    const CaseData data(testCase);
    const Job job = buildJob(data, compiler, kSource / "shaders", Precision::kFloat);
    const std::vector<Plane> planes = readPlanes(testCase, openDevice("cpu32", {})->run(job));
    double sum = 0, rays = 0;
    for (size_t pixel = 0; pixel < planes[0].values.size(); ++pixel) {
        sum += planes[0].values[pixel];
        rays += data.tracedPixels()[pixel];
    }
    return sum / rays;
}

} // namespace

TEST(BenchMethods, haveEachKindUnderNamesOfTheirOwn)
{
    const std::vector<BenchMethod> methods = makeBenchMethods(readCase("yardstick/random_room"));
    std::set<std::string> names, kinds;
    for (const BenchMethod& method : methods) {
        names.insert(method.name);
        kinds.insert(method.kind);
    }
    EXPECT_EQ(names.size(), methods.size());
    EXPECT_EQ(kinds, (std::set<std::string>{"proxy", "linear", "hiz", "patches"})); // all that `needs` may say
    for (const char* name : {"patches, caution 0.25", "patches, caution 0.5", "patches, caution 1"})
        EXPECT_EQ(findMethod(methods, name).scale, 1);
    EXPECT_EQ(findMethod(methods, "patches, caution 0.5, half size").scale, 2);
}

// Two counters that know nothing of each other: the output of the pass, and the hooks of the yardstick for tracers.
TEST(BenchMethods, readsAreThoseOfTheYardstick)
{
    const Case testCase = readCase("yardstick/random_room");
    const YardstickScene scene = makeYardstickScene(CaseData(testCase));
    std::vector<BenchMethod> methods = makeBenchMethods(testCase);
    methods.push_back({"HiZ", "hiz", [](Case& varied) {
                           varied.projection.model = ProjectionModel::kHiz;
                           varied.projection.hiz = {0, 6, 512, 0.1};
                       }});
    const std::vector<TracerMethod> tracers = libraryTracers(0.1);
    const std::pair<const char*, const char*> pairs[] = {{"patches, caution 0.5", "patches, caution 0.5"},
                                                         {"patches, caution 1", "patches, caution 1"},
                                                         {"HiZ", "HiZ, levels 0 to 6, 512 steps"}};
    for (const auto& [method, tracer] : pairs) {
        const auto found = std::find_if(tracers.begin(), tracers.end(),
                                        [&, name = tracer](const TracerMethod& other) { return other.name == name; });
        ASSERT_NE(found, tracers.end()) << tracer;
        const double expected = scoreTracer(scene, found->prepare(scene)).fetches;
        EXPECT_GT(expected, 5);
        EXPECT_NEAR(countReads(testCase, findMethod(methods, method)), expected, 1e-3 * expected) << method;
    }
    EXPECT_EQ(countReads(testCase, findMethod(methods, "proxy, box")), 0);
}

TEST(BenchMethods, oneOfTheirOwnIsANameAndAFile)
{
    const std::string file = (kSource / "cases/own/pixel_walk.glsl").string();
    const BenchMethod own = makeOwnMethod("mine=" + file);
    EXPECT_EQ(own.name, "mine");
    EXPECT_EQ(own.kind, "own");
    Case testCase = readCase("yardstick/random_room");
    own.apply(testCase);
    EXPECT_EQ(testCase.projection.model, ProjectionModel::kOwn);
    EXPECT_TRUE(std::filesystem::is_regular_file(testCase.projection.own.tracer));
    for (const char* text : {"mine", "mine=", "=file", ""})
        EXPECT_THROW(makeOwnMethod(text), InputError) << text;
    try {
        makeOwnMethod("mine=none/there.glsl");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "none/there.glsl: --method mine=none/there.glsl: there is no such file");
    }
}
