#include "harness/run/run_at_hand.h"

#include "harness/run/run_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

RunAtHand readRunAtHand(const std::filesystem::path& path, size_t atMost)
{
    const RunFile file(path);
    RunAtHand result{file.head(), file.cases().size()};
    RunCounts counts;
    uint64_t read = 0;
    for (const std::string_view text : file.cases()) {
        const CaseResult bare = file.parseBare(text);
        addToCounts(counts, bare);
        const bool hasFailed =
            std::any_of(bare.backends.begin(), bare.backends.end(),
                        [](const BackendResult& backend) { return tallyOf(backend.verdict) == Tally::kFailed; });
        if (result.cases <= atMost || (hasFailed && result.run.cases.size() < atMost))
            result.run.cases.push_back(file.parse(text));
        if (++read % kCasesBetweenReleases == 0) file.release();
    }
    if (result.run.cases.size() < result.cases) result.run.countsOfAll = counts;
    return result;
}

std::string describeLeftOut(size_t atHand, uint64_t cases)
{
    if (atHand == cases) return "";
    if (atHand == 0)
        return fmt::format("all {} cases: of so many the pages show those that failed, and none did", cases);
    return fmt::format("{} of {} cases: the pages show the first {} that failed", cases - atHand, cases, atHand);
}

} // namespace crossray
