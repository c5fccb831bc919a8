#include "harness/run/junit.h"

#include "harness/base/text.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <sstream>

namespace crossray {

namespace {

// XML 1.0 has no control characters; a driver's log may.
std::string cleanForXml(std::string text)
{
    std::replace_if(
        text.begin(), text.end(),
        [](unsigned char character) { return character < 0x20 && character != '\n' && character != '\t'; }, '?');
    return text;
}

void setText(pugi::xml_node node, const char* name, const std::string& text)
{
    node.append_attribute(name) = cleanForXml(text).c_str();
}

void appendResult(pugi::xml_node suite, const CaseResult& testCase, const BackendResult& result)
{
    pugi::xml_node test = suite.append_child("testcase");
    setText(test, "name", testCase.name);
    setText(test, "classname", "crossray." + result.backend);
    setText(test, "file", testCase.position.file);
    if (testCase.position.line > 0) test.append_attribute("line") = testCase.position.line;
    setText(test, "time", fmt::format("{:.6f}", result.times.worker / 1000));
    if (tallyOf(result.verdict) == Tally::kPassed) return;
    if (tallyOf(result.verdict) == Tally::kSkipped) {
        setText(test.append_child("skipped"), "message", fmt::format("{}: {}", nameOf(result.verdict), result.reason));
        return;
    }
    const bool isJudged = result.verdict == Verdict::kFail || result.verdict == Verdict::kUnknownPass ||
                          result.verdict == Verdict::kMissingGolden;
    pugi::xml_node failure = test.append_child(isJudged ? "failure" : "error");
    setText(failure, "type", std::string(nameOf(result.verdict)));
    setText(failure, "message", result.reason);
    std::string details;
    for (const ExpectationResult& expectation : result.expectations) {
        if (!expectation.judged || expectation.comparison.passed) continue;
        details += fmt::format("{}: {} ({}): {}\n", expectation.position.format(), expectation.output,
                               expectation.source, expectation.comparison.reason);
    }
    for (const std::string& line : result.messages)
        details += line + "\n";
    for (const std::string& line : result.logLines)
        details += line + "\n";
    failure.text().set(cleanForXml(details).c_str());
}

} // namespace

void JunitWriter::add(const CaseResult& testCase)
{
    constexpr unsigned kDepth = 2; // below suite and root
    for (const BackendResult& result : testCase.backends) {
        Suite& suite = suites_[result.backend];
        pugi::xml_document document;
        appendResult(document, testCase, result);
        const pugi::xml_node test = document.first_child();
        std::ostringstream text;
        test.print(text, " ", pugi::format_default, pugi::encoding_utf8, kDepth);
        suite.tests += text.str();
        ++suite.count;
        if (tallyOf(result.verdict) == Tally::kSkipped) ++suite.skipped;
        if (test.child("failure")) ++suite.failures;
        if (test.child("error")) ++suite.errors;
    }
}

std::string JunitWriter::finish() const
{
    std::string text = "<?xml version=\"1.0\"?>\n<testsuites name=\"crossray\">\n";
    for (const auto& [backend, suite] : suites_) {
        text += fmt::format(" <testsuite name=\"{}\" timestamp=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
                            "skipped=\"{}\">\n{} </testsuite>\n",
                            escapeMarkup(cleanForXml(backend)), escapeMarkup(started_), suite.count, suite.failures,
                            suite.errors, suite.skipped, suite.tests);
    }
    return text + "</testsuites>\n";
}

std::string formatJunit(const RunResult& run)
{
    JunitWriter writer(run.started);
    for (const CaseResult& testCase : run.cases)
        writer.add(testCase);
    return writer.finish();
}

namespace {

// Workflow commands end at a line break, and their properties at a comma or colon.
std::string escapeForGithub(const std::string& text, bool isProperty)
{
    std::string escaped;
    for (const char character : text) {
        const bool isSpecial = character == '%' || character == '\n' || character == '\r' ||
                               (isProperty && (character == ',' || character == ':'));
        if (isSpecial) {
            escaped += fmt::format("%{:02X}", static_cast<unsigned char>(character));
        } else {
            escaped += character;
        }
    }
    return escaped;
}

} // namespace

std::string formatGithubAnnotations(const RunResult& run)
{
    std::string lines;
    for (const std::string& line : run.brokenFiles)
        lines += fmt::format("::error title=broken case::{}\n", escapeForGithub(line, false));
    for (const CaseResult& testCase : run.cases) {
        for (const BackendResult& result : testCase.backends) {
            if (tallyOf(result.verdict) != Tally::kFailed) continue;
            SourcePosition position = testCase.position;
            for (const ExpectationResult& expectation : result.expectations) {
                if (!expectation.judged || expectation.comparison.passed) continue;
                position = expectation.position;
                break;
            }
            lines += fmt::format(
                "::error file={},line={},title={}::{}\n", escapeForGithub(position.file, true),
                std::max(position.line, 1),
                escapeForGithub(fmt::format("{} {} {}", nameOf(result.verdict), testCase.name, result.backend), true),
                escapeForGithub(result.reason, false));
        }
    }
    return lines;
}

} // namespace crossray
