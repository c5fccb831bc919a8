// From what happened to one word: the verdict.
#pragma once

#include "harness/case/case.h"
#include "harness/run/results.h"

#include <string>
#include <string_view>

namespace crossray {

struct Judgement {
    Verdict verdict = Verdict::kPass;
    std::string reason; // one line; empty for a plain pass
};

// The verdict on a backend that answered, by its expectations and messages. `isReference`: others are held against it,
// so that it needs no expectation of its own.
Judgement judgeAnswer(const Case& testCase, const BackendResult& result, bool isReference);

// Turns a failure that a known failure of the case foretells into known-fail, and a pass that it does not into
// unknown-pass. An entry whose last day lies before `today` ("YYYY-MM-DD") changes no verdict; a failure's reason then
// says that it has ended.
Judgement applyKnownFailures(const Case& testCase, const std::string& backend, std::string_view today,
                             Judgement judgement);

// Today's date, UTC.
std::string formatToday();

} // namespace crossray
