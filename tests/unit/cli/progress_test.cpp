#include "harness/cli/progress.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

using namespace crossray;

namespace {

// What was written to a stream so far.
class Capture {
  public:
    Capture() : stream_(std::tmpfile(), &std::fclose) {}
    FILE* stream() { return stream_.get(); }
    std::string text()
    {
        std::string content(static_cast<size_t>(std::ftell(stream_.get())), '\0');
        std::rewind(stream_.get());
        content.resize(std::fread(content.data(), 1, content.size(), stream_.get()));
        return content;
    }

  private:
    std::unique_ptr<FILE, int (*)(FILE*)> stream_;
};

CaseResult makeRunningCase()
{
    CaseResult testCase;
    testCase.name = "a";
    testCase.backends.resize(2);
    testCase.backends[0].backend = "osmesa";
    testCase.backends[0].verdict = Verdict::kPass;
    testCase.backends[1].backend = "cpu64";
    testCase.backends[1].verdict = Verdict::kFail;
    testCase.backends[1].reason = "HitDepth: worst";
    return testCase;
}

std::string show(ProgressOptions options)
{
    Capture capture;
    options.text = options.bar = capture.stream();
    options.caseCount = 1;
    options.resultCount = 2;
    Progress progress(options);
    const CaseResult testCase = makeRunningCase();
    progress.startBackend("osmesa", testCase);
    progress.tick();
    for (const BackendResult& result : testCase.backends)
        progress.finishBackend(testCase, result);
    progress.finishCase(testCase);
    return capture.text();
}

} // namespace

TEST(Progress, linesAreOneACaseWithItsFailuresBefore)
{
    const std::string text = show({.mode = ProgressMode::kLines});
    EXPECT_EQ(text.find("FAIL  a  cpu64"), 0u) << text;
    EXPECT_NE(text.find("FAIL  a        "), std::string::npos) << text;
    EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, quietShowsFailuresAlone)
{
    const std::string text = show({.mode = ProgressMode::kLines, .quiet = true});
    EXPECT_NE(text.find("FAIL  a  cpu64"), std::string::npos);
    EXPECT_EQ(text.find("2 backends"), std::string::npos);
}

TEST(Progress, theBarIsTakenOffBeforeAFailureIsPrinted)
{
    const std::string text = show({.mode = ProgressMode::kBar});
    const size_t bar = text.find("0/1 cases"), clear = text.find("\r\x1b[2K", bar),
                 failure = text.find("FAIL  a  cpu64");
    EXPECT_LT(bar, clear);
    EXPECT_LT(clear, failure);
}

TEST(Progress, theBarFitsTheTerminal)
{
    Progress progress({.mode = ProgressMode::kBar, .caseCount = 100, .resultCount = 600});
    CaseResult testCase = makeRunningCase();
    testCase.name = std::string(200, 'x');
    progress.startBackend("osmesa", testCase);
    for (int i = 0; i < 10; ++i)
        progress.finishBackend(testCase, testCase.backends[0]);
    EXPECT_EQ(progress.formatBar(60, 1.0).size(), 59u);
    EXPECT_NE(progress.formatBar(200, 1.0).find("59 s left"), std::string::npos) << progress.formatBar(200, 1.0);
}

TEST(Progress, aRepeatedErrorIsToldOnce)
{
    Capture capture;
    Progress progress({.mode = ProgressMode::kNone, .text = capture.stream()});
    CaseResult testCase = makeRunningCase();
    testCase.backends[1].verdict = Verdict::kError;
    testCase.backends[1].reason = "hiz.glsl:3:1: error: no such thing";
    progress.finishBackend(testCase, testCase.backends[1]);
    progress.finishBackend(testCase, testCase.backends[1]);
    progress.finish();
    const std::string text = capture.text();
    EXPECT_EQ(text.find("no such thing"), text.rfind("no such thing"));
    EXPECT_NE(text.find("ERROR 1 more with the errors above\n"), std::string::npos) << text;
}

TEST(Clip, countsCharactersAndNotBytes)
{
    EXPECT_EQ(clip("short", 10), "short");
    EXPECT_EQ(clip("0123456789", 10), "0123456789");
    EXPECT_EQ(clip("0123456789a", 10), "0123456...");
    EXPECT_EQ(clip("\u00e4\u00e4\u00e4\u00e4", 4), "\u00e4\u00e4\u00e4\u00e4");
}

TEST(Style, noColorWins)
{
    setenv("NO_COLOR", "1", 1);
    EXPECT_EQ(Style::choose(ColorMode::kAlways, 1).paint(Ink::kRed, "x"), "x");
    unsetenv("NO_COLOR");
    EXPECT_EQ(Style::choose(ColorMode::kAlways, 1).paint(Ink::kRed, "x"), "\x1b[31mx\x1b[0m");
    EXPECT_EQ(Style::choose(ColorMode::kNever, 1).paint(Ink::kRed, "x"), "x");
}
