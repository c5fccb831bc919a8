// The keys of a case that a person may turn: numbers, switches and choices, with what the case format allows.
#pragma once

#include "harness/case/case_tree.h"

#include <optional>
#include <string>
#include <vector>

namespace crossray {

enum class ControlType { kNumber, kInteger, kBoolean, kChoice };

struct Control {
    std::string path;  // "material.ior", "scene.size.0"
    std::string group; // the table that it stands in: "material", "probe.0.influence"
    std::string label; // "IOR", "eye x"
    std::string unit;  // "m", "degrees", "px", or none
    std::string summary;
    ControlType type = ControlType::kNumber;
    double minimum, maximum; // infinite where there is no bound
    bool minimumIsOut = false, maximumIsOut = false;
    std::vector<std::string> choices;
    std::optional<Node> value, preset; // preset: the default; nothing where it is no value
    struct When {                      // it counts only while another control has one of these values
        std::string path;
        std::vector<std::string> values;
    };
    std::optional<When> when{};
};

// Of the tables that the case has, and of those that every case has; in the order of the format.
std::vector<Control> listControls(const CaseTree& tree);
// {"controls": [...]}
std::string formatControlsJson(const std::vector<Control>& controls);

} // namespace crossray
