#include "harness/run/run_json.h"

#include "harness/run/bare_case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

using namespace crossray;

namespace {

RunResult makeFullRun()
{
    RunResult run;
    run.version = "0.1.0";
    run.commit = "abc";
    run.modified = true;
    run.started = "2026-01-31T12:00:00Z";
    run.seconds = 1.5;
    run.seed = 7;
    run.shard = "1/2";
    run.commandLine = {"crossray", "run"};
    run.compilers = {{"glslang", "12.0.0"}};
    run.backends["osmesa"].fingerprint = {"osmesa", "OpenGL 4.5", "llvmpipe", "Mesa", "15", "cpu"};
    CaseResult& testCase = run.cases.emplace_back();
    testCase.name = "hiz/two_planes[ior=1.2]";
    testCase.position = {"cases/a.toml", 3, 1};
    BackendResult& result = testCase.backends.emplace_back();
    result.backend = "osmesa";
    result.verdict = Verdict::kFail;
    result.times.dispatch = 0.25;
    result.traceFile = "planes/a/osmesa.trace.json";
    result.traceNote = "a note";
    ExpectationResult& expectation = result.expectations.emplace_back();
    expectation.judged = true;
    expectation.output = "HitDepth";
    expectation.position = {"cases/a.toml", 21, 1};
    Comparison& comparison = expectation.comparison;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    comparison.worst = PixelDifference{31, 12, {2.5}, {nan}, std::numeric_limits<double>::infinity()};
    comparison.census = {{"NaN for finite", 37}};
    comparison.confusion.emplace().counts[1][2] = 5;
    comparison.metrics = {{"recall", 0.97}};
    comparison.p99 = 1.0 / 3.0;
    return run;
}

} // namespace

TEST(RunJson, readsBackWhatItWrote)
{
    const std::string text = formatRunJson(makeFullRun());
    const RunResult run = parseRunJson(text, "run.json");
    EXPECT_EQ(formatRunJson(run), text);
    const Comparison& comparison = run.cases.at(0).backends.at(0).expectations.at(0).comparison;
    EXPECT_TRUE(std::isnan(comparison.worst->actual.at(0)));
    EXPECT_TRUE(std::isinf(comparison.worst->error));
    EXPECT_EQ(comparison.confusion->counts[1][2], 5u);
    EXPECT_EQ(comparison.p99, 1.0 / 3.0);
    EXPECT_EQ(run.seed, 7u);
    EXPECT_EQ(run.cases[0].backends[0].traceFile, "planes/a/osmesa.trace.json");
    EXPECT_EQ(run.cases[0].backends[0].traceNote, "a note");
    EXPECT_EQ(run.cases[0].backends[0].verdict, Verdict::kFail);
}

TEST(RunJson, refusesOtherSchemasAndBrokenText)
{
    const std::string text = formatRunJson(makeFullRun());
    EXPECT_THROW(parseRunJson("", "a"), InputError);
    EXPECT_THROW(parseRunJson("[]", "a"), InputError);
    EXPECT_THROW(parseRunJson("{\"schema\": \"crossray-run/2\"}", "a"), InputError);
    EXPECT_THROW(parseRunJson("{\"schema\": \"crossray-run/1\"}", "a"), InputError);
    EXPECT_THROW(parseRunJson(text.substr(0, text.size() / 2), "a"), InputError);
    std::string odd = text;
    odd.replace(odd.rfind("\"fail\""), 6, "\"what\"");
    EXPECT_THROW(parseRunJson(odd, "a"), InputError);
    EXPECT_THROW(readRun("/nonexistent/run.json"), InputError);
}

TEST(RunJson, isValidJsonWhateverBytesADriverSays)
{
    RunResult run = makeFullRun();
    run.cases[0].backends[0].logLines = {"\xff\xfe broken UTF-8"};
    EXPECT_NO_THROW(parseRunJson(formatRunJson(run), "a"));
}

TEST(RunJson, everyFieldIsDocumented)
{
    std::ifstream stream(CROSSRAY_SOURCE_DIR "/docs/run-json.md");
    std::ostringstream content;
    content << stream.rdbuf();
    const std::string document = content.str();
    for (const std::string& field : listRunJsonFields())
        EXPECT_NE(document.find("`" + field + "`"), std::string::npos) << field << " is not in docs/run-json.md";
}

TEST(BareCase, isWhatAListOfCasesNeeds)
{
    RunResult run = makeFullRun();
    CaseResult& testCase = run.cases.at(0);
    testCase.name = "quoted \"name\" \\ with \u00e4 and \x01";
    testCase.conditioning.emplace().file = "planes/a/conditioning.exr";
    testCase.backends[0].times.worker = 1.25e-3;
    const CaseResult bare = parseBareCase(formatCaseJson(testCase));
    const CaseResult whole = parseCaseJson(formatCaseJson(testCase), "a");
    EXPECT_EQ(bare.name, testCase.name);
    EXPECT_EQ(bare.position.file, whole.position.file);
    EXPECT_EQ(bare.position.line, whole.position.line);
    EXPECT_EQ(bare.expectedFile, whole.expectedFile);
    EXPECT_EQ(bare.conditioning->file, whole.conditioning->file);
    ASSERT_EQ(bare.backends.size(), whole.backends.size());
    for (size_t i = 0; i < bare.backends.size(); ++i) {
        EXPECT_EQ(bare.backends[i].backend, whole.backends[i].backend);
        EXPECT_EQ(bare.backends[i].verdict, whole.backends[i].verdict);
        EXPECT_EQ(bare.backends[i].reason, whole.backends[i].reason);
        EXPECT_EQ(bare.backends[i].times.worker, whole.backends[i].times.worker);
        EXPECT_EQ(bare.backends[i].planesFile, whole.backends[i].planesFile);
        EXPECT_EQ(bare.backends[i].traceFile, whole.backends[i].traceFile);
    }
}

TEST(BareCase, whatIsNoJsonIsRefusedWhereverItBreaks)
{
    const std::string text = formatCaseJson(makeFullRun().cases.at(0));
    EXPECT_NO_THROW(parseBareCase(text));
    for (size_t length = 0; length < text.size(); ++length)
        EXPECT_THROW(parseBareCase(text.substr(0, length)), InputError) << length;
    for (const char* more : {"", R"(,"x":[1,2,{"y":null}],"z":-1.5e+3,"w":true)"})
        EXPECT_NO_THROW(parseBareCase(fmt::format(R"({{"name":"a","backends":[]{}}})", more))) << more;
    for (const char* wrong : {R"(,"x":[1,])", R"(,"x":+1)", R"(,"x":1.)", R"(,"x":nul)", R"(,"x")", R"(,"x":"a)", ",",
                              R"(,"backends":[{"backend":"b"}])", R"(,"backends":[{"backend":"b","verdict":"what"}])",
                              R"(,"name":3)", R"(,"name":"")"})
        EXPECT_THROW(parseBareCase(fmt::format(R"({{"name":"a","backends":[]{}}})", wrong)), InputError) << wrong;
    EXPECT_THROW(parseBareCase(R"({"name":"a","x":)" + std::string(100'000, '[')), InputError)
        << "the stack is bounded";
}
