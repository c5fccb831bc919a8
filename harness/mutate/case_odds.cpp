#include "harness/mutate/case_odds.h"

#include <algorithm>

namespace crossray {

CaseOdds::Records& CaseOdds::recordsOf(const std::string& key)
{
    Records& records = records_[key];
    if (records.empty()) records.resize(cases_);
    return records;
}

CaseOdds::Choice CaseOdds::start(std::string file, std::string function, std::vector<size_t> candidates,
                                 std::set<size_t> likely)
{
    Choice choice;
    choice.odds_ = this;
    choice.function_ = file + " " + function;
    choice.file_ = std::move(file);
    choice.left_ = std::move(candidates);
    choice.likely_ = std::move(likely);
    return choice;
}

std::optional<size_t> CaseOdds::Choice::next(const std::function<double(size_t)>& milliseconds)
{
    if (left_.empty()) return std::nullopt;
    constexpr double kUnknown = 0.15, kLikely = 3; // what a case that was never asked counts as having caught
    constexpr double kFileWeight = 0.25;           // a file counts less than a function
    const std::lock_guard lock(odds_->mutex_);
    const Records& ofFile = odds_->recordsOf(file_);
    const Records& ofFunction = odds_->recordsOf(function_);
    const auto rate = [&](size_t testCase) {
        const Record &file = ofFile[testCase], &function = ofFunction[testCase];
        const double unknown = likely_.contains(testCase) ? kLikely : kUnknown;
        const double caught = unknown + function.caught + kFileWeight * file.caught;
        const double asked = 1 + function.asked + kFileWeight * file.asked;
        return caught / asked / milliseconds(testCase);
    };
    size_t best = 0;
    double bestRate = -1;
    for (size_t i = 0; i < left_.size(); ++i) {
        const double own = rate(left_[i]);
        if (own <= bestRate) continue;
        best = i;
        bestRate = own;
    }
    const size_t testCase = left_[best];
    left_.erase(left_.begin() + static_cast<ptrdiff_t>(best));
    return testCase;
}

void CaseOdds::Choice::note(size_t testCase, bool isCaught)
{
    const std::lock_guard lock(odds_->mutex_);
    for (const std::string& key : {file_, function_}) {
        Record& record = odds_->recordsOf(key)[testCase];
        record.asked += 1;
        record.caught += isCaught ? 1 : 0;
    }
}

void CaseOdds::Choice::dropIf(const std::function<bool(size_t)>& isDropped)
{
    std::erase_if(left_, isDropped);
}

} // namespace crossray
