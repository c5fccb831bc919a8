// What a report's page knows from the start: the run's head, and of each case as much as its list and filter need.
#pragma once

#include "harness/report/report.h"

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// Where the data of each case are: names of data pieces.
struct CasePieces {
    std::string details;                       // its part of run.json; empty: left out
    std::map<std::string, std::string> planes; // by source: a backend, or "expected"
};

struct TracePiece {
    std::string piece, caseName;
    int x = 0, y = 0;
    std::vector<std::string> backends;
};

struct ReportIndex {
    std::vector<CasePieces> cases; // one for each case of the run
    std::vector<TracePiece> traces;
    std::vector<std::string> benches;                          // names of pieces
    std::vector<std::pair<std::string, std::string>> cubemaps; // name and piece
    std::string atlas, atlasPictures;                          // names of pieces; empty: none
    std::set<std::string> atlasCases;                          // that it links
    std::vector<std::string> leftOut;
};

bool hasFailed(const CaseResult& testCase);
// One entry of its list of cases.
std::string formatIndexCase(const CaseResult& testCase, const CasePieces& pieces);
std::string formatIndexJson(const RunResult& run, const ReportOptions& options, const ReportIndex& index);

} // namespace crossray
