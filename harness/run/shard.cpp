#include "harness/run/shard.h"

#include "harness/run/run_json.h"
#include "harness/run/run_slices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <queue>

namespace crossray {

namespace {

std::optional<int> parseWhole(std::string_view text)
{
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || rest != end) return std::nullopt;
    return value;
}

} // namespace

Shard Shard::parse(std::string_view text)
{
    const size_t slash = text.find('/');
    if (slash != std::string_view::npos) {
        const auto index = parseWhole(text.substr(0, slash)), count = parseWhole(text.substr(slash + 1));
        if (index && count && *index >= 1 && *index <= *count) return {*index, *count};
    }
    throw InputError(fmt::format("--shard \"{}\": allowed is I/N with 1 <= I <= N, auto, or the name of an engine "
                                 "(gitlab, bazel, googletest, slurm, kubernetes), both also with /N",
                                 text));
}

std::string Shard::format() const
{
    return fmt::format("{}/{}", index, count);
}

uint64_t computeStableHash(std::string_view text)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (const char character : text) {
        hash ^= static_cast<unsigned char>(character);
        hash *= 0x100000001b3u;
    }
    // FNV's low bits follow the last characters; names that differ only there must still spread over the shards.
    hash ^= hash >> 33;
    hash *= 0xff51afd7ed558ccdu;
    hash ^= hash >> 33;
    return hash;
}

int findPartByName(std::string_view caseName, int count)
{
    return static_cast<int>(computeStableHash(caseName) % static_cast<uint64_t>(count)) + 1;
}

double computeCaseMs(const CaseResult& testCase)
{
    double milliseconds = testCase.prepareMs + testCase.compileMs;
    for (const BackendResult& result : testCase.backends)
        milliseconds += result.times.worker + result.times.judge;
    return milliseconds;
}

Timings readTimings(const std::filesystem::path& run)
{
    Timings timings;
    const RunFile file(run);
    for (const std::string_view text : file.cases()) {
        const CaseResult testCase = file.parse(text);
        timings[testCase.name] = computeCaseMs(testCase);
    }
    return timings;
}

std::vector<int> findPartsByTime(const std::vector<std::string>& names, const Timings& timings, int count)
{
    std::vector<std::optional<int64_t>> known(names.size());
    std::vector<int64_t> sorted;
    for (size_t i = 0; i < names.size(); ++i) {
        const auto found = timings.find(names[i]);
        if (found == timings.end()) continue;
        // At least one, so that cases of no measured length are spread as well.
        known[i] = std::max<int64_t>(1, std::llround(std::clamp(found->second, 0.0, 1e12) * 1000));
        sorted.push_back(*known[i]);
    }
    std::sort(sorted.begin(), sorted.end());
    const int64_t median = sorted.empty() ? 1 : sorted[sorted.size() / 2];

    std::vector<size_t> order(names.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const int64_t timeA = known[a].value_or(median), timeB = known[b].value_or(median);
        return timeA != timeB ? timeA > timeB : names[a] < names[b];
    });
    using Load = std::pair<int64_t, int>; // microseconds, part
    std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
    for (int part = 1; part <= count; ++part)
        loads.push({0, part});
    std::vector<int> parts(names.size());
    for (const size_t i : order) {
        const auto [load, part] = loads.top();
        loads.pop();
        parts[i] = part;
        loads.push({load + known[i].value_or(median), part});
    }
    return parts;
}

std::optional<std::string> readEnvironment(const char* name)
{
    const char* const value = std::getenv(name);
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

namespace {

// The variables of one engine, read as whole numbers and told as they stand.
class Variables {
  public:
    Variables(const ReadVariable& read, ShardOffer& offer) : read_(read), offer_(offer) {}

    bool has(const char* name) const { return read_(name).has_value(); }

    // Nothing where the variable is not set or no whole number; the offer says so.
    std::optional<int> get(const char* name)
    {
        const std::optional<std::string> text = read_(name);
        offer_.variables +=
            fmt::format("{}{}={}", offer_.variables.empty() ? "" : ", ", name, text.value_or("(not set)"));
        const std::optional<int> value = text ? parseWhole(*text) : std::nullopt;
        if (!value) complain(fmt::format("{} {}", name, text ? "is no whole number" : "is not set"));
        return value;
    }

    void complain(const std::string& what)
    {
        if (offer_.wrong.empty()) offer_.wrong = what;
    }

  private:
    const ReadVariable& read_;
    ShardOffer& offer_;
};

ShardOffer readIndexAndTotal(const ReadVariable& read, const char* engine, const char* index, const char* total,
                             int first)
{
    ShardOffer offer{engine, {}, 0, {}, {}, {}};
    Variables variables(read, offer);
    const auto given = variables.get(index);
    const auto count = variables.get(total);
    if (given && count) {
        offer.index = *given - first + 1;
        offer.count = *count;
    }
    return offer;
}

// An array's tasks are MIN, MIN + STEP, ... MAX; one with holes (--array=1,3,7) has no parts that a task could tell.
ShardOffer readSlurm(const ReadVariable& read)
{
    ShardOffer offer{"slurm", {}, 0, {}, {}, {}};
    Variables variables(read, offer);
    const auto id = variables.get("SLURM_ARRAY_TASK_ID");
    const auto count = variables.get("SLURM_ARRAY_TASK_COUNT");
    const auto first = variables.get("SLURM_ARRAY_TASK_MIN"), last = variables.get("SLURM_ARRAY_TASK_MAX");
    const auto step = variables.has("SLURM_ARRAY_TASK_STEP") ? variables.get("SLURM_ARRAY_TASK_STEP") : 1;
    if (!id || !count || !first || !last || !step) return offer;
    const bool isRegular = *step >= 1 && *last >= *first && (*last - *first) % *step == 0 &&
                           (*last - *first) / *step + 1 == *count && (*id - *first) % *step == 0;
    if (!isRegular)
        variables.complain("the array's tasks are not evenly spaced, so no task knows which part is its own");
    if (isRegular) offer.index = (*id - *first) / *step + 1;
    offer.count = *count;
    return offer;
}

} // namespace

std::vector<ShardOffer> findShardOffers(const ReadVariable& readVariable)
{
    std::vector<ShardOffer> offers;
    // GitLab sets the total to 1, and no index, in a job that is not run in parallel.
    const auto gitlabTotal = readVariable("CI_NODE_TOTAL");
    if (readVariable("CI_NODE_INDEX")) {
        offers.push_back(readIndexAndTotal(readVariable, "gitlab", "CI_NODE_INDEX", "CI_NODE_TOTAL", 1));
    } else if (gitlabTotal == "1") {
        offers.push_back({"gitlab", "CI_NODE_TOTAL=1", 1, 1, {}, {}});
    }
    if (readVariable("TEST_TOTAL_SHARDS")) {
        offers.push_back(readIndexAndTotal(readVariable, "bazel", "TEST_SHARD_INDEX", "TEST_TOTAL_SHARDS", 0));
        offers.back().statusFile = readVariable("TEST_SHARD_STATUS_FILE").value_or("");
    }
    if (readVariable("GTEST_TOTAL_SHARDS")) {
        offers.push_back(readIndexAndTotal(readVariable, "googletest", "GTEST_SHARD_INDEX", "GTEST_TOTAL_SHARDS", 0));
        offers.back().statusFile = readVariable("GTEST_SHARD_STATUS_FILE").value_or("");
    }
    if (readVariable("SLURM_ARRAY_TASK_ID")) offers.push_back(readSlurm(readVariable));
    if (readVariable("JOB_COMPLETION_INDEX")) {
        ShardOffer& offer = offers.emplace_back(ShardOffer{"kubernetes", {}, 0, {}, {}, {}});
        if (const auto index = Variables(readVariable, offer).get("JOB_COMPLETION_INDEX")) offer.index = *index + 1;
    }
    for (ShardOffer& offer : offers) {
        const bool isPart = offer.index >= 1 && (!offer.count || offer.index <= *offer.count);
        if (!isPart && offer.wrong.empty()) offer.wrong = "there is no such part";
    }
    return offers;
}

namespace {

constexpr std::string_view kEngines[] = {"gitlab", "bazel", "googletest", "slurm", "kubernetes"};

Shard shardOf(const ShardOffer& offer, std::optional<int> count, std::string_view text)
{
    const auto fail = [&](const std::string& what) {
        return InputError(fmt::format("--shard {}: {}: {}", text, offer.variables, what));
    };
    if (!offer.wrong.empty()) throw fail(offer.wrong);
    if (count && offer.count && *count != *offer.count) throw fail(fmt::format("these are {} parts", *offer.count));
    const std::optional<int> total = count ? count : offer.count;
    if (!total) throw fail(fmt::format("the number of parts is missing; allowed is --shard {}/N", text));
    if (offer.index > *total) throw fail(fmt::format("there is no part {} of {}", offer.index, *total));
    return {offer.index, *total};
}

} // namespace

ShardChoice chooseShard(std::string_view text, const ReadVariable& readVariable)
{
    const size_t slash = text.find('/');
    const std::string_view word = text.substr(0, slash);
    const bool isEngine = std::find(std::begin(kEngines), std::end(kEngines), word) != std::end(kEngines);
    if (!isEngine && word != "auto") return {Shard::parse(text), {}, {}};
    std::optional<int> count;
    if (slash != std::string_view::npos) {
        count = parseWhole(text.substr(slash + 1));
        if (!count || *count < 1) Shard::parse(text); // throws
    }
    std::vector<ShardOffer> offers = findShardOffers(readVariable);
    if (isEngine) std::erase_if(offers, [&](const ShardOffer& offer) { return offer.engine != word; });
    if (offers.empty()) {
        throw InputError(fmt::format(
            "--shard {}: no engine has said which part this is; it may be CI_NODE_INDEX and CI_NODE_TOTAL (gitlab), "
            "TEST_SHARD_INDEX and TEST_TOTAL_SHARDS (bazel), GTEST_SHARD_INDEX and GTEST_TOTAL_SHARDS (googletest), "
            "SLURM_ARRAY_TASK_ID (slurm), JOB_COMPLETION_INDEX (kubernetes, with /N); or give I/N",
            text));
    }
    const ShardOffer& first = offers.front();
    const Shard shard = shardOf(first, count, text);
    for (const ShardOffer& other : offers) {
        if (shardOf(other, count ? count : shard.count, text) == shard) continue;
        throw InputError(fmt::format("--shard {}: {} ({}) and {} ({}) name different parts; allowed is the name of one",
                                     text, first.engine, first.variables, other.engine, other.variables));
    }
    return {shard, fmt::format("{}: {}", first.engine, first.variables), first.statusFile};
}

} // namespace crossray
