// What is made of the figures of a bench: text, files, charts, advice, and the comparison with an older one.
#pragma once

#include "harness/bench/bench_case.h"

#include <optional>

namespace crossray {

// "HitDepth<=0.01,Missed<=0.05": bounds on errors.
struct BudgetTerm {
    std::string error;
    double bound = 0;
};
// Throws InputError with what is allowed.
std::vector<BudgetTerm> parseBudget(const std::string& text);

// Throws InputError where measuring the case gives no such error: before it is measured.
void checkBudget(const std::vector<BudgetTerm>& budget, const Case& testCase);

// The cheapest method of a scene that keeps the budget: by reads a ray, then by iterations, and where these are equal
// (or unknown, as for refractions) the first in the order of the list, which goes from less work to more. Nothing when
// none keeps it. Throws InputError when the scene's methods have no such error.
const BenchPoint* chooseMethod(const BenchScene& scene, const std::vector<BudgetTerm>& budget);

std::string formatBenchTable(const BenchScene& scene);
std::string formatBenchJson(const BenchResult& result);
std::string formatBenchCsv(const BenchResult& result);
BenchResult readBenchJson(const std::string& file); // throws InputError
// A chart or more a scene: its main errors against time and, for reflections, against reads.
std::vector<Chart> makeBenchCharts(const BenchResult& result);

// What moved since `before`. A loss: an error or a counter that grew by more than `share` of what it was; or a time,
// where both are of the same device, whose ratio to the baseline grew by more than `share` and whose spreads do not
// overlap.
struct BenchChange {
    std::string text; // one line
    bool isLoss = false;
};
std::vector<BenchChange> compareBenches(const BenchResult& before, const BenchResult& after, double share);

} // namespace crossray
