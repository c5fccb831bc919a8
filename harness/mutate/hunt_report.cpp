#include "harness/mutate/hunt_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <map>

namespace crossray {

namespace {

using Json = nlohmann::ordered_json;

void count(HuntCounts& counts, MutantEnd end)
{
    ++counts.planted;
    counts.caught += end == MutantEnd::kCaught;
    counts.survived += end == MutantEnd::kSurvived;
    counts.equivalent += end == MutantEnd::kEquivalent;
    counts.sameCode += end == MutantEnd::kSameCode;
    counts.unreached += end == MutantEnd::kUnreached;
    counts.noCompile += end == MutantEnd::kNoCompile;
}

std::vector<HuntCounts> countBy(const HuntResult& hunt, const std::function<std::string(const Mutation&)>& nameOfOne)
{
    std::map<std::string, HuntCounts> byName;
    for (const MutantResult& mutant : hunt.mutants) {
        HuntCounts& counts = byName[nameOfOne(mutant.mutation)];
        counts.name = nameOfOne(mutant.mutation);
        count(counts, mutant.end);
    }
    std::vector<HuntCounts> all;
    for (auto& [name, counts] : byName)
        all.push_back(std::move(counts));
    return all;
}

std::vector<std::string> listIdle(const HuntResult& hunt)
{
    std::vector<std::string> names;
    for (const CaseScore& score : hunt.cases) {
        if (score.isIdle) names.push_back(score.name);
    }
    return names;
}

std::string describeSeen(const SeenDifference& seen)
{
    return fmt::format("{} {}: {} px differ, largest error {:.3g} -> {:.3g} {}, tolerance {}", seen.testCase,
                       seen.output, seen.pixels, seen.before, seen.after, seen.unit, seen.tolerance);
}

Json toJson(const HuntCounts& counts)
{
    Json json{{"name", counts.name},           {"mutants", counts.planted},       {"caught", counts.caught},
              {"survived", counts.survived},   {"equivalent", counts.equivalent}, {"sameCode", counts.sameCode},
              {"unreached", counts.unreached}, {"noCompile", counts.noCompile}};
    const std::optional<double> score = counts.score();
    json["score"] = score ? Json(*score) : Json(nullptr);
    return json;
}

Json toJson(const MutantResult& mutant)
{
    const Mutation& mutation = mutant.mutation;
    Json json{{"file", mutation.file},
              {"line", mutation.line},
              {"column", mutation.column},
              {"function", mutation.function},
              {"operation", mutation.operation},
              {"was", mutation.was},
              {"becomes", mutation.replacement},
              {"before", mutation.before},
              {"after", mutation.after},
              {"end", nameOf(mutant.end)},
              {"caughtBy", mutant.caughtBy},
              {"how", mutant.how},
              {"reason", mutant.reason},
              {"reached", mutant.reached},
              {"asked", mutant.asked},
              {"seconds", mutant.seconds},
              {"old", mutant.isOld}};
    Json seen = Json::array();
    for (const SeenDifference& one : mutant.seen) {
        seen.push_back({{"case", one.testCase},
                        {"output", one.output},
                        {"pixels", one.pixels},
                        {"before", one.before},
                        {"after", one.after},
                        {"unit", one.unit},
                        {"tolerance", one.tolerance}});
    }
    json["seen"] = std::move(seen);
    return json;
}

std::string quoteCsv(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string formatMarkdownTable(const std::vector<HuntCounts>& rows, const std::string& head)
{
    std::string text =
        fmt::format("| {} | mutants | caught | survived | equivalent | same code | unreached | no program | "
                    "score |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
                    head);
    for (const HuntCounts& row : rows) {
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", row.name, row.planted, row.caught,
                            row.survived, row.equivalent, row.sameCode, row.unreached, row.noCompile, formatScore(row));
    }
    return text;
}

// A line a member, and a line an element where that is a list: thousands of mutants can be read and compared.
std::string dumpByLine(const Json& json)
{
    const auto dump = [](const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); };
    std::vector<std::string> members;
    for (const auto& [name, value] : json.items()) {
        std::string text = dump(value);
        if (value.is_array() && !value.empty()) {
            std::vector<std::string> elements;
            for (const Json& element : value)
                elements.push_back("  " + dump(element));
            text = fmt::format("[\n{}\n ]", fmt::join(elements, ",\n"));
        }
        members.push_back(fmt::format(" {}: {}", dump(Json(name)), text));
    }
    return fmt::format("{{\n{}\n}}\n", fmt::join(members, ",\n"));
}

} // namespace

std::optional<double> HuntCounts::score() const
{
    if (caught + survived == 0) return std::nullopt;
    return static_cast<double>(caught) / static_cast<double>(caught + survived);
}

std::string formatScore(const HuntCounts& counts)
{
    const size_t all = counts.caught + counts.survived;
    if (all == 0) return "-";
    const size_t tenths = 1000 * counts.caught / all;
    return fmt::format("{}.{} %", tenths / 10, tenths % 10);
}

HuntCounts countAll(const HuntResult& hunt)
{
    HuntCounts all;
    for (const MutantResult& mutant : hunt.mutants)
        count(all, mutant.end);
    all.name = "all";
    return all;
}

std::vector<HuntCounts> countByFile(const HuntResult& hunt)
{
    return countBy(hunt, [](const Mutation& mutation) { return mutation.file; });
}

std::vector<HuntCounts> countByOperation(const HuntResult& hunt)
{
    return countBy(hunt, [](const Mutation& mutation) { return mutation.operation; });
}

std::string formatHuntTable(const HuntResult& hunt)
{
    std::string text = fmt::format("{:<42}{:>8}{:>8}{:>9}{:>11}{:>10}{:>10}{:>11}{:>9}\n", "file", "mutants", "caught",
                                   "survived", "equivalent", "same code", "unreached", "no program", "score");
    std::vector<HuntCounts> rows = countByFile(hunt);
    rows.push_back(countAll(hunt));
    for (const HuntCounts& row : rows) {
        text += fmt::format("{:<42}{:>8}{:>8}{:>9}{:>11}{:>10}{:>10}{:>11}{:>9}\n", row.name, row.planted, row.caught,
                            row.survived, row.equivalent, row.sameCode, row.unreached, row.noCompile, formatScore(row));
    }
    return text;
}

std::string formatSurvivors(const HuntResult& hunt)
{
    std::string text;
    for (const MutantResult& mutant : hunt.mutants) {
        if (mutant.end != MutantEnd::kSurvived) continue;
        text += fmt::format("SURVIVED  {}  {} of {} cases asked\n{}", mutant.mutation.operation, mutant.asked,
                            mutant.reached, formatMutationDiff(mutant.mutation));
        for (const SeenDifference& seen : mutant.seen)
            text += "  seen by " + describeSeen(seen) + "\n";
        text += "\n";
    }
    return text;
}

std::string formatHuntMarkdown(const HuntResult& hunt, const HuntChoice& choice)
{
    const HuntCounts all = countAll(hunt);
    std::string text = "# Planted bugs\n\n";
    text +=
        fmt::format("{} of {} planted bugs were run against the cases on {} ({}): {} caught, {} survived, score {}. "
                    "[docs/mutation.md](../../docs/mutation.md) says what the columns mean.\n\n",
                    all.planted, choice.planted, hunt.fingerprint.backend, hunt.fingerprint.device, all.caught,
                    all.survived, formatScore(all));
    text += fmt::format("    {}\n\n{:.0f} s{}.\n\n", choice.command, hunt.seconds,
                        choice.commit.empty() ? "" : ", commit " + choice.commit);
    if (choice.askAtMost > 0) {
        text += fmt::format("At most {} cases were asked about each, the likeliest first: what survived them may be "
                            "caught by others, so "
                            "the score is a lower bound.\n\n",
                            choice.askAtMost);
    }
    const auto old = std::count_if(hunt.mutants.begin(), hunt.mutants.end(),
                                   [](const MutantResult& mutant) { return mutant.isOld; });
    if (old > 0) {
        text += fmt::format("{} of those that were caught were so by an earlier run (`--again`); the others were asked "
                            "about anew.\n\n",
                            old);
    }
    std::vector<HuntCounts> rows = countByFile(hunt);
    rows.push_back(all);
    text += "## Files\n\n" + formatMarkdownTable(rows, "file");
    text += "\n## Kinds of bug\n\n" + formatMarkdownTable(countByOperation(hunt), "kind");
    const std::vector<std::string> idle = listIdle(hunt);
    if (!idle.empty()) {
        text += "\n## Cases that caught none of the bugs that they were asked about\n\n";
        for (const std::string& name : idle)
            text += fmt::format("- {}\n", name);
    }
    text += "\n## Survivors\n";
    for (const MutantResult& mutant : hunt.mutants) {
        if (mutant.end != MutantEnd::kSurvived) continue;
        text += fmt::format("\n```diff\n{}```\n", formatMutationDiff(mutant.mutation));
        if (!mutant.seen.empty()) text += "Seen by " + describeSeen(mutant.seen.front()) + ".\n";
    }
    return text;
}

std::string formatHuntCsv(const HuntResult& hunt)
{
    std::string text = "file,line,column,function,operation,was,becomes,end,caught_by,how,seconds\n";
    for (const MutantResult& mutant : hunt.mutants) {
        const Mutation& mutation = mutant.mutation;
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{},{:.2f}\n", mutation.file, mutation.line, mutation.column,
                        mutation.function, mutation.operation, quoteCsv(mutation.was), quoteCsv(mutation.replacement),
                        nameOf(mutant.end), quoteCsv(mutant.caughtBy), mutant.how, mutant.seconds);
    }
    return text;
}

std::string formatHuntJson(const HuntResult& hunt, const HuntChoice& choice)
{
    Json json{{"schema", "crossray-mutation/1"},
              {"command", choice.command},
              {"commit", choice.commit},
              {"planted", choice.planted},
              {"seed", choice.seed},
              {"askAtMost", choice.askAtMost},
              {"seconds", hunt.seconds},
              {"backend", hunt.fingerprint.backend},
              {"device", hunt.fingerprint.device},
              {"all", toJson(countAll(hunt))}};
    for (const HuntCounts& counts : countByFile(hunt))
        json["files"].push_back(toJson(counts));
    for (const HuntCounts& counts : countByOperation(hunt))
        json["operations"].push_back(toJson(counts));
    json["idleCases"] = listIdle(hunt);
    Json cases = Json::array();
    for (const CaseScore& score : hunt.cases) {
        cases.push_back(
            {{"name", score.name}, {"kills", score.kills}, {"asked", score.asked}, {"leftOut", score.leftOut}});
    }
    json["cases"] = std::move(cases);
    Json mutants = Json::array();
    for (const MutantResult& mutant : hunt.mutants)
        mutants.push_back(toJson(mutant));
    json["mutants"] = std::move(mutants);
    return dumpByLine(json);
}

} // namespace crossray
