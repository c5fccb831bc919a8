// One case's results as JSON, the entries of run.json's "cases".
#pragma once

#include "harness/run/results.h"

#include <nlohmann/json.hpp>

namespace crossray {

nlohmann::ordered_json caseToJson(const CaseResult& testCase);
// Throws InputError and nlohmann::json::exception.
CaseResult caseFromJson(const nlohmann::ordered_json& json);

} // namespace crossray
