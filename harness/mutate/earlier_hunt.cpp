#include "harness/mutate/earlier_hunt.h"

#include "harness/base/error.h"
#include "harness/base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace crossray {

EarlierHunt::EarlierHunt(const std::filesystem::path& file)
{
    const std::optional<std::string> text = readText(file);
    if (!text) throw InputError({file.string()}, "cannot be read");
    try {
        const auto json = nlohmann::json::parse(*text);
        if (json.at("schema") != "crossray-mutation/1")
            throw InputError({file.string()}, "is no mutation.json: its schema must be crossray-mutation/1");
        for (const auto& one : json.at("mutants")) {
            MutantResult result;
            result.mutation.file = one.at("file");
            result.mutation.function = one.at("function");
            result.mutation.before = one.at("before");
            result.mutation.after = one.at("after");
            const bool isCaught = one.at("end") == nameOf(MutantEnd::kCaught);
            result.end = isCaught ? MutantEnd::kCaught : MutantEnd::kSurvived;
            result.caughtBy = one.at("caughtBy");
            result.how = one.at("how");
            result.reason = one.at("reason");
            result.reached = one.at("reached");
            result.asked = one.at("asked");
            result.seconds = one.at("seconds");
            results_[keyOf(result.mutation)].push_back(std::move(result));
        }
    } catch (const nlohmann::json::exception& error) {
        throw InputError({file.string()}, fmt::format("is no mutation.json: {}", error.what()));
    }
}

EarlierHunt::Key EarlierHunt::keyOf(const Mutation& mutation)
{
    return {mutation.file, mutation.function, mutation.before, mutation.after};
}

const MutantResult* EarlierHunt::findCaught(const Mutation& mutation) const
{
    const auto found = results_.find(keyOf(mutation));
    if (found == results_.end()) return nullptr;
    const std::vector<MutantResult>& alike = found->second;
    const bool areCaught = std::all_of(alike.begin(), alike.end(),
                                       [](const MutantResult& result) { return result.end == MutantEnd::kCaught; });
    return areCaught ? &alike.front() : nullptr;
}

} // namespace crossray
