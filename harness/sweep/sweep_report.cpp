// A sweep as a table for the terminal, as CSV and as JSON.
#include "harness/sweep/sweep.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace crossray {

namespace {

constexpr const char* kClassNames[] = {"hit", "miss", "unknown", "no raycast"};

// Of a class with all its reasons.
double shareOf(const ClassShares& shares, const std::string& name)
{
    double sum = 0;
    for (const auto& [key, share] : shares) {
        if (key == name || key.starts_with(name + ":")) sum += share;
    }
    return sum;
}

const SweepCell* findReference(const SweepRow& row)
{
    const auto found =
        std::find_if(row.cells.begin(), row.cells.end(), [](const SweepCell& cell) { return cell.backend == "cpu64"; });
    return found == row.cells.end() ? nullptr : &*found;
}

// The largest over the backends, and which one has it.
struct Worst {
    double value = 0;
    std::string backend;
};
template <typename Read>
Worst worstOf(const SweepRow& row, const Read& read)
{
    Worst worst;
    for (const SweepCell& cell : row.cells) {
        const double value = read(cell);
        if (worst.backend.empty() || value > worst.value) worst = {value, cell.backend};
    }
    return worst;
}

std::string formatRow(const SweepRow& row, size_t errors)
{
    const std::string start = fmt::format("{}{:>12.6g}", row.isAtEdge ? "*" : " ", row.value);
    if (!row.refused.empty()) return fmt::format("{}  refused: {}\n", start, row.refused);
    std::string text = start;
    const SweepCell* const reference = findReference(row);
    for (const char* name : kClassNames)
        text += fmt::format(" {:>7.2f}", reference == nullptr ? 0.0 : 100 * shareOf(reference->classes, name));
    const Worst differs = worstOf(row, [](const SweepCell& cell) { return cell.differs; });
    const double iterations = worstOf(row, [](const SweepCell& cell) { return cell.maxIterations; }).value;
    const double notFinite =
        worstOf(row, [](const SweepCell& cell) { return static_cast<double>(cell.notFinite); }).value;
    text += fmt::format(" {:>7.2f} {:>7.4g} {:>6g} {:>6g}", 100 * differs.value,
                        reference == nullptr ? 0.0 : reference->meanIterations, iterations, notFinite);
    for (size_t i = 0; i < errors; ++i) {
        const auto read = [&](const SweepCell& cell) { return i < cell.errors.size() ? cell.errors[i].max : 0.0; };
        const Worst worst = worstOf(row, read);
        const auto cell = std::find_if(row.cells.begin(), row.cells.end(),
                                       [&](const SweepCell& one) { return one.backend == worst.backend; });
        const bool isKnown = cell != row.cells.end() && i < cell->errors.size();
        text += fmt::format(" {:>9.3g} {:>9.3g}{}", worst.value, isKnown ? cell->errors[i].p99 : 0.0,
                            isKnown && !cell->errors[i].passed ? "!" : " ");
    }
    for (const SweepCell& cell : row.cells) {
        if (!cell.failure.empty()) text += fmt::format("  {}: {}", cell.backend, cell.failure);
    }
    return text + "\n";
}

const SweepRow* firstAnswered(const SweepResult& result)
{
    const auto found = std::find_if(result.rows.begin(), result.rows.end(), [](const SweepRow& row) {
        return row.refused.empty() && findReference(row) != nullptr && findReference(row)->failure.empty();
    });
    return found == result.rows.end() ? nullptr : &*found;
}

std::string quote(const std::string& text)
{
    std::string safe = "\"";
    for (const char c : text)
        safe += c == '"' ? "\"\"" : c == '\n' ? " " : std::string(1, c);
    return safe + "\"";
}

// NaN and infinities have no number in JSON.
nlohmann::ordered_json numberOf(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(fmt::format("{}", value));
}

nlohmann::ordered_json cellJson(const SweepCell& cell)
{
    nlohmann::ordered_json json{{"backend", cell.backend}};
    if (!cell.failure.empty()) {
        json["failure"] = cell.failure;
        return json;
    }
    json["errors"] = nlohmann::ordered_json::array();
    for (const SweepError& error : cell.errors) {
        nlohmann::ordered_json item{{"output", error.output},      {"source", error.source},
                                    {"unit", error.unit},          {"mean", numberOf(error.mean)},
                                    {"p99", numberOf(error.p99)},  {"max", numberOf(error.max)},
                                    {"failedShare", error.failed}, {"passed", error.passed}};
        if (!error.metrics.empty()) item["metrics"] = error.metrics;
        json["errors"].push_back(std::move(item));
    }
    json["classes"] = cell.classes;
    json["iterations"] = {{"mean", cell.meanIterations}, {"max", cell.maxIterations}};
    json["notFinite"] = cell.notFinite;
    if (cell.notFinite > 0) json["notFiniteOutputs"] = cell.notFiniteOutputs;
    json["differsFromCpu64"] = cell.differs;
    return json;
}

} // namespace

std::string formatSweepTable(const SweepResult& result)
{
    std::string text = fmt::format("{}  {} {:g} to {:g}{}\n", result.caseName, result.parameter, result.range.from,
                                   result.range.to, result.range.isLog ? ", logarithmic" : "");
    const SweepRow* const answered = firstAnswered(result);
    const size_t errors = answered == nullptr ? 0 : findReference(*answered)->errors.size();
    text += fmt::format("{:>13} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>6} {:>6}", "value", "hit %", "miss %", "unkn. %",
                        "none %", "diff %", "iter.", "most", "NaN");
    for (size_t i = 0; i < errors; ++i)
        text += fmt::format(" {:>9} {:>9} ", fmt::format("max [{}]", i + 1), "p99");
    text += "\n";
    for (const SweepRow& row : result.rows)
        text += formatRow(row, errors);
    for (size_t i = 0; i < errors; ++i) {
        const SweepError& error = findReference(*answered)->errors[i];
        text += fmt::format("[{}] {}: {}, {}\n", i + 1, error.output, error.source, error.unit);
    }
    text += "Classes and mean iterations are cpu64's; diff, most, NaN and errors those of the worst backend; ! beyond "
            "the case's tolerance; * beside an edge.\n";
    for (const SweepEdge& edge : result.edges)
        text += fmt::format("edge: {}\n", edge.sentence);
    return text;
}

std::string formatSweepCsv(const SweepResult& result)
{
    std::string text = "parameter,value,edge,backend,state,quantity,unit,number\n";
    for (const SweepRow& row : result.rows) {
        const auto line = [&](const std::string& backend, const std::string& state, const std::string& quantity,
                              const std::string& unit, double number) {
            text += fmt::format("{},{},{:d},{},{},{},{},{}\n", quote(result.parameter), row.value, row.isAtEdge,
                                backend, quote(state), quote(quantity), unit, number);
        };
        if (!row.refused.empty()) line("", "refused: " + row.refused, "", "", 0);
        for (const SweepCell& cell : row.cells) {
            if (!cell.failure.empty()) {
                line(cell.backend, cell.failure, "", "", 0);
                continue;
            }
            for (const SweepError& error : cell.errors) {
                const std::string name = error.output + " against " + error.source;
                const char* const state = error.passed ? "within tolerance" : "beyond tolerance";
                line(cell.backend, state, name + ": max", error.unit, error.max);
                line(cell.backend, state, name + ": p99", error.unit, error.p99);
                line(cell.backend, state, name + ": beyond", "share", error.failed);
                for (const auto& [metric, value] : error.metrics)
                    line(cell.backend, state, name + ": " + metric, "share", value);
            }
            for (const auto& [name, share] : cell.classes)
                line(cell.backend, "ok", "class " + name, "share", share);
            line(cell.backend, "ok", "iterations: mean", "count", cell.meanIterations);
            line(cell.backend, "ok", "iterations: max", "count", cell.maxIterations);
            line(cell.backend, "ok", "values that are NaN or infinite", "count", static_cast<double>(cell.notFinite));
            line(cell.backend, "ok", "class is not cpu64's", "share", cell.differs);
        }
    }
    return text;
}

std::string formatSweepJson(const SweepResult& result)
{
    nlohmann::ordered_json json{{"schema", "crossray-sweep/1"}, {"id", result.id},
                                {"case", result.caseName},      {"summary", result.summary},
                                {"command", result.command},    {"parameter", result.parameter},
                                {"from", result.range.from},    {"to", result.range.to},
                                {"log", result.range.isLog},    {"width", result.width},
                                {"backends", result.backends}};
    json["edges"] = nlohmann::ordered_json::array();
    for (const SweepEdge& edge : result.edges) {
        json["edges"].push_back({{"kind", nameOf(edge.kind)},
                                 {"backend", edge.backend},
                                 {"between", {edge.low, edge.high}},
                                 {"gradual", edge.isGradual},
                                 {"sentence", edge.sentence}});
    }
    json["values"] = nlohmann::ordered_json::array();
    for (const SweepRow& row : result.rows) {
        nlohmann::ordered_json item{{"value", row.value}, {"atEdge", row.isAtEdge}};
        if (!row.refused.empty()) item["refused"] = row.refused;
        item["backends"] = nlohmann::ordered_json::array();
        for (const SweepCell& cell : row.cells)
            item["backends"].push_back(cellJson(cell));
        json["values"].push_back(std::move(item));
    }
    return json.dump(1) + "\n";
}

} // namespace crossray
