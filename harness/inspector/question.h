// The body of a request: JSON with a case, what is changed of it, and what is asked.
#pragma once

#include "harness/case/case_tree.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// The request is no JSON, or not of the form that the route takes.
class BadQuestion : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct Question {
    std::string caseName;
    KeyValues parameters;
    std::vector<std::string> backends;
    std::optional<int64_t> generation; // handed back as it came
    glm::ivec2 pixel{0};
    std::string name; // of a case to be saved
};

// `fields` are those that the route takes; all but "parameters" and "generation" are required. Throws BadQuestion.
Question parseQuestion(const std::string& body, std::span<const std::string_view> fields);

} // namespace crossray
