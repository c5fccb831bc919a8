#include "harness/case/expand.h"

#include <fmt/format.h>

#include <algorithm>

namespace crossray {

namespace {

constexpr size_t kMostSubCases = 4096;

// Dotted keys in TOML are tables in tables: whatever is no table is a list of values.
void collectParameters(const Node& table, const std::string& prefix, std::vector<Parameter>& parameters)
{
    for (const NodeEntry& entry : table.entries) {
        const std::string path = prefix.empty() ? entry.key : prefix + "." + entry.key;
        const Node& value = entry.value;
        if (value.kind == NodeKind::kTable) {
            collectParameters(value, path, parameters);
            continue;
        }
        if (value.kind != NodeKind::kList || value.items.empty()) {
            throw InputError(value.place.position(),
                             fmt::format("\"{}\" of [expand] is {}; a list of one value or more is allowed", path,
                                         value.kind == NodeKind::kList ? "an empty list" : describeKind(value.kind)));
        }
        const std::string root = path.substr(0, path.find('.'));
        for (const std::string_view own : {"schema", "name", "use", "expand"}) {
            if (root == own)
                throw InputError(entry.keyPlace.position(), fmt::format("\"{}\" cannot be expanded", path));
        }
        parameters.push_back({path, entry.keyPlace, value.items});
    }
}

// The last part of the path, or the whole path where two parameters end alike.
std::string labelOf(const Parameter& parameter, const std::vector<Parameter>& all)
{
    const auto last = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
    const std::string label = last(parameter.path);
    const auto same = std::count_if(all.begin(), all.end(), [&](const Parameter& p) { return last(p.path) == label; });
    return same > 1 ? parameter.path : label;
}

} // namespace

std::vector<Parameter> takeParameters(Node& root)
{
    const Node* expand = root.find("expand");
    if (!expand) return {};
    if (expand->kind != NodeKind::kTable) {
        throw InputError(expand->place.position(),
                         fmt::format("\"expand\" is {}; a table is allowed", describeKind(expand->kind)));
    }
    std::vector<Parameter> parameters;
    collectParameters(*expand, "", parameters);
    size_t product = 1;
    for (const Parameter& parameter : parameters) {
        product *= parameter.values.size();
        if (product > kMostSubCases) {
            throw InputError(
                parameter.keyPlace.position(),
                fmt::format("[expand] makes more than {} sub-cases; at most that many are allowed", kMostSubCases));
        }
    }
    root.erase("expand");
    return parameters;
}

bool advance(const std::vector<Parameter>& parameters, Combination& combination)
{
    size_t i = parameters.size();
    while (i > 0 && ++combination[i - 1] == parameters[i - 1].values.size())
        combination[--i] = 0;
    return i > 0;
}

std::string formatLabel(const std::vector<Parameter>& parameters, const Combination& combination)
{
    std::string label;
    for (size_t i = 0; i < parameters.size(); ++i) {
        label += fmt::format("{}{}={}", i == 0 ? "" : ",", labelOf(parameters[i], parameters),
                             formatValue(parameters[i].values[combination[i]]));
    }
    return parameters.empty() ? "" : "[" + label + "]";
}

} // namespace crossray
