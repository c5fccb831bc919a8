// What judging found, as JSON: expectations with their comparisons, and how well the questions were posed.
#pragma once

#include "harness/run/results.h"

#include <nlohmann/json.hpp>

namespace crossray {

nlohmann::ordered_json positionToJson(const SourcePosition& position);
nlohmann::ordered_json expectationToJson(const ExpectationResult& expectation);
nlohmann::ordered_json conditioningToJson(const ConditioningResult& conditioning);

// The same back. Throws InputError and nlohmann::json::exception.
SourcePosition positionFromJson(const nlohmann::ordered_json& json);
ExpectationResult expectationFromJson(const nlohmann::ordered_json& json);
ConditioningResult conditioningFromJson(const nlohmann::ordered_json& json);

} // namespace crossray
