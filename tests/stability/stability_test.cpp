// A case that a naive shader passes is no case: each situation of cases/stability/ is run on one backend with the
// library's function and with the naive form that people write (naive/NN_*.glsl), and one of its cases must fail with
// the latter.
#include "tests/stability/naive_shader.h"

#include "harness/base/error.h"
#include "harness/base/temporary_folder.h"
#include "harness/run/steps.h"
#include "harness/run/verdict.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

using namespace crossray;
namespace fs = std::filesystem;

namespace {

const fs::path kShaders = fs::path(CROSSRAY_SOURCE_DIR) / "shaders";
const fs::path kCases = fs::path(CROSSRAY_SOURCE_DIR) / "cases/stability";
const fs::path kNaive = fs::path(CROSSRAY_SOURCE_DIR) / "tests/stability/naive";
constexpr double kNaiveTimeoutSeconds = 10; // a loop without an end is as good as a wrong answer
constexpr int kCores = 2;
constexpr int kSituations = 64;

// Files "NN_..." of a folder with that ending, in order.
std::vector<fs::path> listNumbered(const fs::path& folder, const std::string& extension, const std::string& number = {})
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool isNumbered = name.size() > 3 && std::isdigit(static_cast<unsigned char>(name[0])) != 0;
        if (entry.path().extension() == extension && isNumbered && name.starts_with(number)) files.push_back(entry);
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::set<std::string> numbersOf(const std::vector<fs::path>& files)
{
    std::set<std::string> numbers;
    for (const fs::path& file : files)
        numbers.insert(file.filename().string().substr(0, 2));
    return numbers;
}

class NoObserver : public RunObserver {
    void startBackend(const std::string&, const CaseResult&) override {}
    void finishBackend(const CaseResult&, const BackendResult&) override {}
    void finishCase(const CaseResult&) override {}
    void tick() override {}
};

class NaiveForm : public testing::TestWithParam<fs::path> {
  protected:
    static void SetUpTestSuite()
    {
        WorkerOptions options;
        options.executable = CROSSRAY_BINARY_DIR "/worker_program";
        options.mesaCacheFolder = CROSSRAY_BINARY_DIR "/mesa-cache";
        options.cores = kCores;
        pool_ = std::make_unique<WorkerPool>(options);
        compiler_ = std::make_unique<ShaderCompiler>(CROSSRAY_BINARY_DIR "/spirv-cache");
    }
    static void TearDownTestSuite()
    {
        pool_.reset();
        compiler_.reset();
    }

    // Nothing where it is installed.
    static std::string whyMissing(const std::string& backend)
    {
        for (const BackendInfo& info : listBackends()) {
            if (info.name == backend) return info.found ? "" : "not installed: " + info.missing;
        }
        throw InputError("no such backend: " + backend);
    }

    RunResult runCases(const std::vector<Case>& cases, const fs::path& shaders, const std::string& backend,
                       std::optional<double> timeout, int maxFailures)
    {
        ExecuteOptions options;
        options.backends = {backend};
        options.cores = kCores;
        options.keepGoing = true;
        options.timeoutSeconds = timeout;
        options.maxFailures = maxFailures;
        options.keepPlanes = KeepPlanes::kNone;
        options.today = formatToday();
        NoObserver observer;
        const std::atomic<bool> interrupted{false};
        RunResult run;
        execute(cases, options, makeSteps(*pool_, *compiler_, shaders, options.backends), observer, interrupted, run);
        return run;
    }

    static std::unique_ptr<WorkerPool> pool_;
    static std::unique_ptr<ShaderCompiler> compiler_;
};

std::unique_ptr<WorkerPool> NaiveForm::pool_;
std::unique_ptr<ShaderCompiler> NaiveForm::compiler_;

// The case that has the naive form's own name, else all of its situation.
std::vector<Case> readSituation(const NaiveShader& naive)
{
    std::vector<fs::path> files{kCases / naive.path.filename().replace_extension(".toml")};
    if (!fs::exists(files[0])) files = listNumbered(kCases, ".toml", naive.number);
    std::vector<Case> cases;
    for (const fs::path& file : files) {
        for (Case& testCase : readCaseFile(file))
            cases.push_back(std::move(testCase));
    }
    return cases;
}

std::string describe(const RunResult& run)
{
    std::ostringstream text;
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends) {
            text << "  " << testCase.name << ": " << nameOf(result.verdict) << " " << result.reason << "\n";
        }
    }
    return text.str();
}

int countVerdict(const RunResult& run, Verdict verdict)
{
    const RunCounts counts = countVerdicts(run);
    const auto found = counts.byVerdict.find(verdict);
    return found == counts.byVerdict.end() ? 0 : found->second;
}

std::string testName(const testing::TestParamInfo<fs::path>& info)
{
    std::string name = info.param.stem().string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
}

} // namespace

TEST_P(NaiveForm, isCaughtByTheCasesOfItsSituation)
{
    const NaiveShader naive = readNaiveShader(GetParam());
    if (const std::string reason = whyMissing(naive.backend); !reason.empty()) GTEST_SKIP() << reason;
    const std::vector<Case> cases = readSituation(naive);
    ASSERT_FALSE(cases.empty()) << "cases/stability/ has no case " << naive.number << "_*.toml";

    const RunResult sound = runCases(cases, kShaders, naive.backend, {}, 0);
    ASSERT_EQ(countVerdict(sound, Verdict::kPass), static_cast<int>(cases.size()))
        << "the library's own form does not pass:\n"
        << describe(sound);

    const TemporaryFolder folder("naive");
    ASSERT_NO_THROW(writeNaiveTree(kShaders, naive, folder.path()));
    const RunResult run = runCases(cases, folder.path(), naive.backend, kNaiveTimeoutSeconds, 1);
    EXPECT_GE(countVerdict(run, Verdict::kFail) + countVerdict(run, Verdict::kTimeout), 1)
        << "a naive form passes, so the cases prove nothing. It should fail: " << naive.fails << "\n"
        << describe(run);
    EXPECT_EQ(countVerdict(run, Verdict::kError) + countVerdict(run, Verdict::kCrash), 0) << describe(run);
    RecordProperty("verdicts", describe(run));
    if (std::getenv("CROSSRAY_SHOW") != nullptr) std::cout << describe(run);
}

INSTANTIATE_TEST_SUITE_P(stability, NaiveForm, testing::ValuesIn(listNumbered(kNaive, ".glsl")), testName);

TEST(StabilitySuite, everySituationHasACaseAndANaiveForm)
{
    std::set<std::string> all;
    for (int number = 1; number <= kSituations; ++number)
        all.insert(fmt::format("{:02}", number));
    EXPECT_EQ(numbersOf(listNumbered(kCases, ".toml")), all);
    EXPECT_EQ(numbersOf(listNumbered(kNaive, ".glsl")), all);
}

TEST(StabilitySuite, theDocumentNamesEachFile)
{
    std::ifstream stream(fs::path(CROSSRAY_SOURCE_DIR) / "docs/stability-suite.md");
    std::map<std::string, std::string> rows; // by number
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("| ") && std::isdigit(static_cast<unsigned char>(line[2])) != 0)
            rows[fmt::format("{:02}", std::stoi(line.substr(2)))] += line;
    }
    std::set<std::string> numbers;
    size_t links = 0;
    for (const auto& [number, row] : rows) {
        numbers.insert(number);
        for (size_t at = 0; (at = row.find("](../", at)) != std::string::npos; ++at)
            ++links;
    }
    std::vector<fs::path> files = listNumbered(kCases, ".toml");
    EXPECT_EQ(numbers, numbersOf(files));
    for (const fs::path& form : listNumbered(kNaive, ".glsl"))
        files.push_back(form);
    for (const fs::path& file : files) {
        const std::string path = file.lexically_relative(CROSSRAY_SOURCE_DIR).generic_string();
        EXPECT_NE(rows[file.filename().string().substr(0, 2)].find("](../" + path + ")"), std::string::npos) << path;
    }
    EXPECT_EQ(links, files.size()) << "the document names a file that is not there, or one twice";
}

TEST(StabilitySuite, casesBearTheTagAndSayWhyANaiveShaderFails)
{
    for (const fs::path& file : listNumbered(kCases, ".toml")) {
        SCOPED_TRACE(file.string());
        std::ifstream stream(file);
        std::ostringstream text;
        text << stream.rdbuf();
        EXPECT_NE(text.str().find("\n# A naive shader "), std::string::npos)
            << "a line \"# A naive shader ...\" says why one fails";
        for (const Case& testCase : readCaseFile(file)) {
            const auto hasTag = [&](const std::string& tag) {
                return std::find(testCase.tags.begin(), testCase.tags.end(), tag) != testCase.tags.end();
            };
            EXPECT_TRUE(hasTag("stability"));
            EXPECT_TRUE(hasTag(fmt::format("stability-{}", std::stoi(file.filename().string().substr(0, 2)))));
        }
    }
}

// The tool itself.

TEST(FindFunctions, knowsDefinitionsFromDeclarationsStructsAndComments)
{
    const std::string text = "// float a(int b) {\n"
                             "#define F(x) {\n"
                             "float hook(ivec2 pixel);\n"
                             "struct S { float x; };\n"
                             "const float k = 1.0;\n"
                             "/* { */\n"
                             "vec3 f(vec3 a,\n        float b)\n{ if (a.x > b) { return a; } return vec3(b); }\n"
                             "int g() { return 1; }\n";
    const std::vector<FunctionPlace> found = findFunctions(text);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].signature, "vec3 f(vec3,float)");
    EXPECT_EQ(text.substr(found[0].begin, 4), "vec3");
    EXPECT_EQ(text.substr(found[0].end - 2, 2), " }");
    EXPECT_EQ(found[1].signature, "int g()");
}

TEST(WriteNaiveTree, replacesOneOverloadWithItsHelpersAndRefusesWhatIsNotThere)
{
    const TemporaryFolder folder("naivetree");
    fs::create_directories(folder.path() / "shaders/a");
    std::ofstream(folder.path() / "shaders/a/a.glsl")
        << "float f(float x) { return x; }\nvec2 f(vec2 x)\n{\n    return x;\n}\n";
    const fs::path form = folder.path() / "07_f.glsl";
    const auto write = [&](const std::string& head, const std::string& body) {
        std::ofstream(form) << head << body;
        return readNaiveShader(form);
    };
    const std::string head = "// Replaces: a/a.glsl f\n// Fails: because\n// it does.\n";
    const NaiveShader naive = write(head, "float h() { return 2.0; }\nvec2 f(vec2 v) { return v * h(); }\n");
    EXPECT_EQ(naive.number, "07");
    EXPECT_EQ(naive.fails, "because it does.");
    EXPECT_EQ(naive.backend, "lavapipe");
    EXPECT_EQ(write("// On: osmesa\n" + head, "").backend, "osmesa");
    writeNaiveTree(folder.path() / "shaders", naive, folder.path() / "tree");
    std::ifstream stream(folder.path() / "tree/a/a.glsl");
    std::ostringstream text;
    text << stream.rdbuf();
    EXPECT_EQ(text.str(), "float f(float x) { return x; }\n" + head +
                              "float h() { return 2.0; }\nvec2 f(vec2 v) { return v * h(); }\n");

    EXPECT_THROW(write("// Replaces: a/a.glsl f\n", "vec2 f(vec2 v) { return v; }\n"), InputError);
    EXPECT_THROW(writeNaiveTree(folder.path() / "shaders", write(head, "vec3 f(vec3 v) { return v; }\n"),
                                folder.path() / "tree"),
                 InputError);
    EXPECT_THROW(writeNaiveTree(folder.path() / "shaders", write(head, "vec2 g(vec2 v) { return v; }\n"),
                                folder.path() / "tree"),
                 InputError);
}
