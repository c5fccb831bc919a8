// A finding as a case: what was found becomes what the case expects, so that it fails for as long as the fault is
// there.
#include "tests/fuzz/case_fuzzer.h"

#include <fmt/format.h>

namespace crossray {

namespace {

Node makeBoolean(bool value)
{
    Node node;
    node.kind = NodeKind::kBoolean;
    node.boolean = value;
    return node;
}

Node expectFinite()
{
    Node expect;
    setKey(expect, "finite", makeBoolean(true));
    return expect;
}

Node expectAtMost(const std::string& output, double bound)
{
    Node expect;
    setKey(expect, "output", makeString(output));
    setKey(expect, "at_most", makeNumber(bound));
    return expect;
}

Node expectAgreement(const std::vector<std::string>& backends)
{
    std::vector<Node> names;
    for (const std::string& backend : backends)
        names.push_back(makeString(backend));
    Node expect;
    setKey(expect, "output", makeString("HitSuccess"));
    setKey(expect, "agree", makeList(std::move(names)));
    setKey(expect, "undecidable", makeNumber(0.5)); // those pixels are no part of the finding
    return expect;
}

// A name of no other backend's output may be named by a message: quotes end the string.
std::string withoutQuotes(std::string text)
{
    for (char& c : text) {
        if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return text;
}

} // namespace

std::string formatFinding(const Node& root, const Finding& finding, const std::string& name,
                          const std::vector<std::string>& backends)
{
    Node written = root;
    setKey(written, "name", makeString(name));
    setKey(written, "summary", makeString("Found by random cases: " + withoutQuotes(finding.text)));
    setKey(written, "tags", makeList({makeString("stability"), makeString("fuzz")}));
    std::vector<Node> expectations{expectFinite()};
    if (finding.kind == FindingKind::kRange && !finding.output.empty())
        expectations.push_back(expectAtMost(finding.output, 1.0 + 0x1p-22));
    if (finding.kind == FindingKind::kIterations) expectations.push_back(expectAtMost("IterationCount", finding.bound));
    if (finding.kind == FindingKind::kClass) expectations.push_back(expectAgreement(backends));
    setKey(written, "expect", makeList(std::move(expectations)));
    return formatCase(written);
}

} // namespace crossray
