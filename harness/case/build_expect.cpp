// [[expect]] and [[known_failure]].
#include "harness/case/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

constexpr std::array<std::string_view, 7> kSources{"analytic", "truth",   "constant", "golden",
                                                   "agree",    "at_most", "finite"};
constexpr std::array<std::string_view, 4> kHitClassNames{"no_raycast", "hit", "miss", "unknown"};

std::string_view sourceOf(const TableReader& table)
{
    std::string_view source;
    for (const std::string_view key : kSources) {
        if (!table.has(key)) continue;
        if (!source.empty()) {
            throw InputError(table.position(key),
                             fmt::format("two sources, \"{}\" and \"{}\"; exactly one of analytic, truth, "
                                         "constant, golden, agree, at_most and finite is allowed",
                                         source, key));
        }
        source = key;
    }
    if (source.empty()) {
        throw InputError(table.position(""),
                         "no source; exactly one of analytic, truth, constant, golden, agree, at_most and finite is "
                         "required");
    }
    return source;
}

ConstantSource buildConstant(const Node& node, const OutputInfo& output)
{
    const auto refuse = [&](const std::string& text) { throw InputError(node.place.position(), text); };
    if (output.type == OutputType::kHitClass) {
        const auto found = std::find(kHitClassNames.begin(), kHitClassNames.end(), node.text);
        if (node.kind != NodeKind::kString || found == kHitClassNames.end()) {
            refuse("\"constant\" of HitSuccess is a class; allowed: \"no_raycast\", \"hit\", \"miss\", \"unknown\"");
        }
        return {{static_cast<double>(found - kHitClassNames.begin())}};
    }
    ConstantSource source;
    if (node.isNumber()) source.value = {node.number};
    for (const Node& item : node.items)
        source.value.push_back(item.number);
    if (source.value.size() != static_cast<size_t>(output.channels)) {
        refuse(fmt::format("\"constant\" {}; {} has {} channel{}",
                           node.kind == NodeKind::kString ? "is a name"
                                                          : fmt::format("has {} value{}", source.value.size(),
                                                                        source.value.size() == 1 ? "" : "s"),
                           output.name, output.channels, output.channels == 1 ? "" : "s"));
    }
    if (output.type == OutputType::kDirection) {
        const double length = std::hypot(source.value[0], source.value[1], source.value[2]);
        if (std::abs(length - 1.0) > 1e-6)
            refuse(fmt::format("\"constant\" has length {}; a direction has length 1", length));
    }
    const bool whole =
        std::all_of(source.value.begin(), source.value.end(), [](double v) { return v == std::floor(v); });
    if (output.type == OutputType::kCount && !whole)
        refuse(fmt::format("\"constant\" of {} is a whole number", output.name));
    return source;
}

AgreeSource buildAgree(const TableReader& table)
{
    AgreeSource source{table.texts("agree")};
    if (source.backends.size() < 2) {
        throw InputError(table.position("agree"),
                         fmt::format("\"agree\" has {} name{}; two or more are allowed", source.backends.size(),
                                     source.backends.size() == 1 ? "" : "s"));
    }
    return source;
}

BoundSource buildBound(const TableReader& table, std::string_view key, const OutputInfo& output)
{
    if (table.has("tolerance")) {
        throw InputError(table.position("tolerance"),
                         fmt::format("a tolerance beside \"{}\" is not allowed; the bound is one", key));
    }
    if (key == "finite") {
        if (table.boolean(key)) return {};
        throw InputError(table.position(key), "\"finite\" is false; true is allowed");
    }
    if (output.type == OutputType::kHitClass || output.type == OutputType::kDirection) {
        throw InputError(
            table.position(key),
            fmt::format("\"at_most\" of {} is not allowed; depths, colours, scalars and counts have one", output.name));
    }
    return {table.number(key)};
}

ExpectationSource buildSource(const TableReader& table, std::string_view key, const OutputInfo& output,
                              const Case& testCase)
{
    if (key == "analytic") return AnalyticSource{table.text(key)};
    if (key == "truth") return TruthSource{table.text(key)};
    if (key == "constant") return buildConstant(*table.find(key), output);
    if (key == "golden") return GoldenSource{resolveInside(testCase, *table.find(key), key, false)};
    if (key == "agree") return buildAgree(table);
    return buildBound(table, key, output);
}

std::vector<std::string_view> boundsOf(OutputType type)
{
    switch (type) {
    case OutputType::kDirection:
        return {"degrees"};
    case OutputType::kDepth:
    case OutputType::kColor:
    case OutputType::kScalar:
        return {"relative", "absolute", "ulps"};
    case OutputType::kHitClass:
    case OutputType::kCount:
        break;
    }
    return {}; // exact
}

std::string joinNames(const std::vector<std::string_view>& names)
{
    std::string text;
    for (size_t i = 0; i < names.size(); ++i) {
        text += fmt::format("{}{}", i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
    }
    return text;
}

// Each type knows its own bounds: degrees say nothing about a depth.
void checkToleranceKeys(const TableReader& table, const Node& node, const OutputInfo& output)
{
    const std::vector<std::string_view> bounds = boundsOf(output.type);
    std::vector<std::string_view> allowed = bounds;
    if (bounds.size() > 1) allowed.insert(allowed.end(), {"floor", "double"});
    allowed.insert(allowed.end(), {"outliers", "worst"});
    for (const NodeEntry& entry : node.entries) {
        if (std::find(allowed.begin(), allowed.end(), entry.key) != allowed.end()) continue;
        throw InputError(entry.keyPlace.position(), fmt::format("\"{}\" is no bound of {}; allowed: {}", entry.key,
                                                                output.name, joinNames(allowed)));
    }
    const bool bounded =
        std::any_of(bounds.begin(), bounds.end(), [&](std::string_view key) { return table.has(key); });
    if (!bounds.empty() && !bounded) {
        throw InputError(node.place.position(),
                         fmt::format("the tolerance sets no bound of {}; {} is required", output.name,
                                     bounds.size() == 1 ? "degrees" : "one of " + joinNames(bounds)));
    }
    if (table.number("outliers") > 0 && !table.has("worst")) {
        throw InputError(table.position("outliers"),
                         "\"outliers\" never stands alone; \"worst\" is required beside it");
    }
    if (table.has("worst") && !table.has("outliers")) {
        throw InputError(table.position("worst"), "\"worst\" bounds outliers; \"outliers\" is required beside it");
    }
}

Tolerance buildTolerance(const Node& node, const OutputInfo& output)
{
    const TableReader table(&node, "expect.tolerance");
    checkToleranceKeys(table, node, output);
    Tolerance tolerance;
    const auto set = [&](std::string_view key, std::optional<double>& bound) {
        if (table.has(key)) bound = table.number(key);
    };
    set("degrees", tolerance.degrees);
    set("relative", tolerance.relative);
    set("absolute", tolerance.absolute);
    set("ulps", tolerance.ulps);
    set("worst", tolerance.worst);
    tolerance.floor = table.number("floor");
    tolerance.doublePrecision = table.boolean("double");
    tolerance.outlierShare = table.number("outliers");
    return tolerance;
}

HitBudget buildBudget(const TableReader& expect, std::string_view source, const OutputInfo& output)
{
    if (output.type != OutputType::kHitClass) {
        throw InputError(expect.position("budget"),
                         fmt::format("a budget of {} is not allowed; HitSuccess alone has one", output.name));
    }
    if (source != "truth") {
        throw InputError(expect.position("budget"), fmt::format("a budget needs truth as its source, not {}", source));
    }
    if (expect.has("tolerance")) {
        throw InputError(expect.position("tolerance"),
                         "a tolerance beside a budget is not allowed; the budget judges by shares");
    }
    const TableReader table = expect.table("budget");
    HitBudget budget;
    const auto set = [&](std::string_view key, std::optional<double>& bound) {
        if (table.has(key)) bound = table.number(key);
    };
    set("recall", budget.recall);
    set("precision", budget.precision);
    set("false_hits", budget.falseHits);
    budget.positionPx = table.number("position_px");
    if (!budget.recall && !budget.precision && !budget.falseHits) {
        throw InputError(expect.position("budget"),
                         "the budget bounds nothing; one of recall, precision and false_hits is required");
    }
    return budget;
}

// Without a name: every output, which are not known yet.
OutputInfo buildOutput(const TableReader& table, std::string_view source)
{
    if (table.has("output")) return *findOutput(table.text("output"));
    if (source == "finite") return {};
    throw InputError(table.position(""), "\"output\" is missing in [expect]; \"finite\" alone does without");
}

void buildExcuse(const TableReader& table, const Case& testCase, Expectation& expectation)
{
    if (table.has("undecidable_above") && !table.has("undecidable")) {
        throw InputError(table.position("undecidable_above"),
                         "\"undecidable_above\" excuses nothing alone; \"undecidable\" is required beside it");
    }
    if (!table.has("undecidable")) return;
    if (expectation.budget) {
        throw InputError(table.position("undecidable"),
                         "\"undecidable\" beside a budget is not allowed; the budget judges by shares");
    }
    if (std::holds_alternative<BoundSource>(expectation.source)) {
        throw InputError(table.position("undecidable"),
                         "\"undecidable\" beside finite and at_most is not allowed; these bounds hold for any answer");
    }
    if (testCase.projection.model == ProjectionModel::kOwn) {
        throw InputError(table.position("undecidable"),
                         "\"undecidable\" is measured on cpu32 and cpu64, which run no own tracer; it is allowed with "
                         "the other models");
    }
    expectation.undecidable = table.number("undecidable");
    expectation.undecidableAbove = table.number("undecidable_above");
}

Expectation buildExpectation(const Node& node, const ToleranceLookup& findTolerance, const Case& testCase)
{
    const TableReader table(&node, "expect");
    Expectation expectation;
    expectation.position = node.place.position();
    const std::string_view source = sourceOf(table);
    const bool isBound = source == "finite" || source == "at_most";
    expectation.output = buildOutput(table, source);
    expectation.source = buildSource(table, source, expectation.output, testCase);
    expectation.where = source == "finite" ? Where::kAll : Where::kTraced;
    if (table.has("where")) expectation.where = static_cast<Where>(table.choice("where"));
    expectation.backends = table.texts("backends");
    if (table.has("budget")) expectation.budget = buildBudget(table, source, expectation.output);
    buildExcuse(table, testCase, expectation);

    if (const Node* tolerance = table.find("tolerance")) {
        const bool isPreset = tolerance->kind == NodeKind::kString;
        expectation.tolerance = buildTolerance(isPreset ? findTolerance(*tolerance) : *tolerance, expectation.output);
    } else if (!isBound && !boundsOf(expectation.output.type).empty()) {
        throw InputError(node.place.position(),
                         fmt::format("\"tolerance\" is missing; {} requires one that sets {}", expectation.output.name,
                                     joinNames(boundsOf(expectation.output.type))));
    }
    return expectation;
}

bool isDate(std::string_view text)
{
    const auto digits = [&](size_t from, size_t count) {
        int value = 0;
        for (size_t i = from; i < from + count; ++i) {
            if (text[i] < '0' || text[i] > '9') return -1;
            value = value * 10 + (text[i] - '0');
        }
        return value;
    };
    if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
    const int year = digits(0, 4), month = digits(5, 2), day = digits(8, 2);
    if (year < 0 || month < 1 || month > 12 || day < 1) return false;
    constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return day <= kDays[static_cast<size_t>(month - 1)] + (month == 2 && leap ? 1 : 0);
}

} // namespace

void buildExpectations(const Node& root, const ToleranceLookup& findTolerance, Case& testCase)
{
    const Node& list = *root.find("expect");
    if (list.items.empty())
        throw InputError(list.place.position(), "\"expect\" is empty; one expectation or more is required");
    for (const Node& node : list.items) {
        testCase.expectations.push_back(buildExpectation(node, findTolerance, testCase));
    }
}

void spreadOverOutputs(Case& testCase)
{
    std::vector<Expectation> spread;
    for (Expectation& expectation : testCase.expectations) {
        if (!expectation.output.name.empty()) {
            spread.push_back(std::move(expectation));
            continue;
        }
        for (const OutputInfo& output : testCase.outputs) {
            spread.push_back(expectation);
            spread.back().output = output;
        }
    }
    testCase.expectations = std::move(spread);
}

void buildKnownFailures(const Node& root, Case& testCase)
{
    const Node* list = root.find("known_failure");
    if (!list) return;
    for (const Node& node : list->items) {
        const TableReader table(&node, "known_failure");
        if (!isDate(table.text("until"))) {
            throw InputError(table.position("until"),
                             fmt::format("\"until\" is \"{}\"; a day of the calendar as YYYY-MM-DD is allowed",
                                         table.text("until")));
        }
        testCase.knownFailures.push_back(
            {table.texts("backends"), table.text("issue"), table.text("until"), table.text("reason")});
    }
    if (testCase.mustFail && !testCase.knownFailures.empty()) {
        throw InputError(list->items.front().place.position(),
                         "a known failure of a must_fail case is not allowed; one of them is");
    }
}

} // namespace crossray
