// A sweep as a table for the terminal, as CSV and as JSON.
#include "harness/sweep/sweep.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

// All that a backend's answer comes to, with a name each.
std::vector<std::pair<std::string, double>> numbersOf(const SweepCell& cell)
{
    std::vector<std::pair<std::string, double>> numbers;
    for (size_t i = 0; i < cell.errors.size(); ++i) {
        const SweepError& error = cell.errors[i];
        if (error.compared == 0) continue;
        const std::string name = fmt::format("[{}] {} against {}", i + 1, error.output, error.source);
        numbers.emplace_back(fmt::format("{}: max ({})", name, error.unit), error.max);
        numbers.emplace_back(fmt::format("{}: p99 ({})", name, error.unit), error.p99);
        numbers.emplace_back(name + ": share beyond tolerance", error.failed);
        for (const auto& [metric, value] : error.metrics)
            numbers.emplace_back(name + ": " + metric, value);
    }
    for (const auto& [name, share] : cell.classes)
        numbers.emplace_back(name, share);
    numbers.emplace_back("iterations: mean", cell.meanIterations);
    numbers.emplace_back("iterations: max", cell.maxIterations);
    numbers.emplace_back("values that are NaN or infinite", static_cast<double>(cell.notFinite));
    numbers.emplace_back("share whose class is not cpu64's", cell.differs);
    return numbers;
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
        if (error.compared == 0) continue;
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
    std::vector<std::string> columns; // of numbers, in the order in which they first occur
    std::map<std::string, size_t> places;
    const auto placeOf = [&](const std::string& name) {
        const auto [place, isNew] = places.try_emplace(name, columns.size());
        if (isNew) columns.push_back(name);
        return place->second;
    };
    struct Line {
        std::string start;
        std::map<size_t, double> numbers;
    };
    std::vector<Line> lines;
    for (const SweepRow& row : result.rows) {
        const std::string start = fmt::format("{:.10g},{:d},", row.value, row.isAtEdge);
        if (!row.refused.empty()) lines.push_back({start + "," + quote("refused: " + row.refused), {}});
        for (const SweepCell& cell : row.cells) {
            Line line{
                fmt::format("{}{},{}", start, cell.backend, cell.failure.empty() ? "answered" : quote(cell.failure)),
                {}};
            if (cell.failure.empty()) {
                for (const auto& [name, number] : numbersOf(cell))
                    line.numbers[placeOf(name)] = number;
            }
            lines.push_back(std::move(line));
        }
    }
    std::string text = quote(result.parameter) + ",at edge,backend,state";
    for (const std::string& column : columns)
        text.append(",").append(quote(column));
    text += "\n";
    for (const Line& line : lines) {
        text += line.start;
        for (size_t i = 0; i < columns.size(); ++i) {
            const auto number = line.numbers.find(i);
            text += number == line.numbers.end() ? "," : fmt::format(",{:.6g}", number->second);
        }
        text += "\n";
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
