#include "harness/inspector/question.h"

#include "harness/case/key_path.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace crossray {

namespace {

using Json = nlohmann::json;

constexpr size_t kLongestText = 1000;
constexpr size_t kMostParameters = 500;

[[noreturn]] void refuse(const std::string& text)
{
    throw BadQuestion(text);
}

const std::string& readText(const Json& value, std::string_view field)
{
    if (!value.is_string()) refuse(fmt::format("\"{}\" is no string", field));
    const auto& text = value.get_ref<const std::string&>();
    if (text.empty() || text.size() > kLongestText)
        refuse(fmt::format("\"{}\" has {} bytes; 1 to {} are allowed", field, text.size(), kLongestText));
    return text;
}

// As the file would say it: a whole number for a key of whole numbers, however it is written.
Node readValue(const std::string& path, const Json& value)
{
    Node node;
    node.place.file = std::make_shared<const std::string>(path);
    if (value.is_boolean()) {
        node.kind = NodeKind::kBoolean;
        node.boolean = value.get<bool>();
    } else if (value.is_string()) {
        node.kind = NodeKind::kString;
        node.text = readText(value, path);
    } else if (value.is_number()) {
        node.number = value.get<double>();
        if (!std::isfinite(node.number)) refuse(fmt::format("\"{}\" is not finite; a finite number is allowed", path));
        const PathTarget target = findPathTarget(path);
        const bool wantsWhole =
            target.spec != nullptr && (target.spec->type == KeyType::kInteger || target.spec->type == KeyType::kSize);
        constexpr double kLargestWhole = 9007199254740992; // beyond it a double is no count
        const bool isWhole = node.number == std::floor(node.number) && std::abs(node.number) <= kLargestWhole;
        node.kind = wantsWhole && isWhole ? NodeKind::kInteger : NodeKind::kNumber;
        if (node.kind == NodeKind::kInteger) node.integer = static_cast<int64_t>(node.number);
    } else {
        refuse(fmt::format("parameter \"{}\": a number, a string, true or false is allowed", path));
    }
    return node;
}

KeyValues readParameters(const Json& value)
{
    if (!value.is_object()) refuse("\"parameters\" is no object; allowed is {\"material.ior\": 1.5, ...}");
    if (value.size() > kMostParameters)
        refuse(fmt::format("{} parameters; at most {} are allowed", value.size(), kMostParameters));
    KeyValues parameters;
    for (const auto& [path, each] : value.items())
        parameters[path] = readValue(path, each);
    return parameters;
}

std::vector<std::string> readBackends(const Json& value)
{
    if (!value.is_array()) refuse("\"backends\" is no list of names");
    std::vector<std::string> names;
    for (const Json& each : value)
        names.push_back(readText(each, "backends"));
    return names;
}

int readCoordinate(const Json& value)
{
    if (!value.is_number_integer()) refuse("\"pixel\" is no [x, y] of whole numbers");
    const bool isSmall =
        value.is_number_unsigned() ? value.get<uint64_t>() <= 1'000'000 : value.get<int64_t>() >= -1'000'000;
    if (!isSmall) refuse("\"pixel\" is far outside any image");
    return value.get<int>();
}

void readField(const std::string& field, const Json& value, Question& question)
{
    if (field == "case") question.caseName = readText(value, field);
    if (field == "name") question.name = readText(value, field);
    if (field == "parameters") question.parameters = readParameters(value);
    if (field == "backends") question.backends = readBackends(value);
    if (field == "generation") {
        if (!value.is_number_integer()) refuse("\"generation\" is no whole number");
        question.generation = value.get<int64_t>();
    }
    if (field == "pixel") {
        if (!value.is_array() || value.size() != 2) refuse("\"pixel\" is no [x, y] of whole numbers");
        question.pixel = {readCoordinate(value[0]), readCoordinate(value[1])};
    }
}

} // namespace

Question parseQuestion(const std::string& body, std::span<const std::string_view> fields)
{
    Json json;
    try {
        json = Json::parse(body);
    } catch (const Json::exception& error) {
        refuse(fmt::format("the body is no JSON: {}", error.what()));
    }
    if (!json.is_object()) refuse("the body is no JSON object");
    Question question;
    for (const auto& [field, value] : json.items()) {
        if (std::find(fields.begin(), fields.end(), field) == fields.end())
            refuse(fmt::format("unknown field \"{}\"; allowed are {}", field, fmt::join(fields, ", ")));
        readField(field, value, question);
    }
    for (const std::string_view field : fields) {
        if (field != "parameters" && field != "generation" && !json.contains(field))
            refuse(fmt::format("\"{}\" is missing", field));
    }
    return question;
}

} // namespace crossray
