#include "harness/case/case_tree.h"

#include "harness/case/build.h"
#include "harness/case/expand.h"
#include "harness/case/key_path.h"
#include "harness/case/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace crossray {

namespace fs = std::filesystem;

namespace {

std::string_view withoutLastPart(std::string_view path)
{
    return path.substr(0, path.rfind('.'));
}

// Of one number in a list the whole list with that number: the list may stand in a preset, or be a default.
struct Setting {
    std::string path;
    Node value;
};
Setting completeList(const Node& whole, const std::string& path, const Node& value)
{
    const PathTarget target = findPathTarget(path);
    if (!target.isComponent) return {path, value};
    const std::string list(withoutLastPart(path));
    const Node* const given = findByPath(whole, list);
    const Node* const base = given != nullptr            ? given
                             : target.spec->defaultValue ? &*target.spec->defaultValue
                                                         : nullptr;
    if (base == nullptr || base->kind != NodeKind::kList) {
        throw InputError(value.place.position(),
                         fmt::format("\"{}\" is one number of \"{}\", which the case does not give; the whole list is "
                                     "allowed",
                                     path, target.spec->key));
    }
    Node completed = *base;
    setByPath(completed, path.substr(list.size() + 1), value.place, value);
    return {list, completed};
}

void requireKnownPath(const std::string& path, const Node& value)
{
    if (findPathTarget(path).spec != nullptr) return;
    std::vector<std::string> known;
    for (const KeySpec& spec : keySpecs())
        known.push_back(spec.path());
    throw InputError(value.place.position(),
                     fmt::format("\"{}\" is no key of the case format{}", path, suggest(path, known)));
}

// The combination of [expand] that the name asks for, less the parameters that are set anyway.
Combination chooseCombination(const std::string& caseName, const std::string& baseName,
                              const std::vector<Parameter>& parameters, const KeyValues& values)
{
    Combination combination(parameters.size(), 0);
    do {
        if (baseName + formatLabel(parameters, combination) == caseName) return combination;
    } while (advance(parameters, combination));
    size_t product = 1;
    std::vector<std::string> open;
    for (const Parameter& parameter : parameters) {
        if (values.contains(parameter.path)) continue;
        product *= parameter.values.size();
        if (parameter.values.size() > 1) open.push_back(parameter.path);
    }
    if (product == 1) return combination;
    std::vector<std::string> set;
    for (const auto& [path, unused] : values)
        set.push_back(path);
    throw InputError(fmt::format("\"{}\" is {} cases when {} is set; one is allowed: they differ in {}", caseName,
                                 product, set.empty() ? "nothing" : fmt::format("{}", fmt::join(set, ", ")),
                                 fmt::join(open, ", ")));
}

} // namespace

CaseTree readCaseTree(const fs::path& file, const std::string& caseName, const KeyValues& values)
{
    CaseTree tree;
    tree.own = readTomlFile(file);
    const std::shared_ptr<const Node> presets = findPresets(file.parent_path());
    tree.whole = tree.own;
    applyPresets(tree.whole, presets.get());
    const std::vector<Parameter> parameters = takeParameters(tree.whole);
    tree.own.erase("expand");
    const Node* const name = tree.whole.find("name");
    const std::string baseName = name != nullptr ? name->text : "";
    const Combination combination = chooseCombination(caseName, baseName, parameters, values);

    bool isOwnEnough = true;
    const auto set = [&](const std::string& path, const Place& keyPlace, const Node& value) {
        const Setting setting = completeList(tree.whole, path, value);
        setByPath(tree.whole, setting.path, keyPlace, setting.value);
        try {
            setByPath(tree.own, setting.path, keyPlace, setting.value);
        } catch (const InputError&) { // it leads into what a preset says
            isOwnEnough = false;
        }
    };
    for (size_t i = 0; i < parameters.size(); ++i)
        set(parameters[i].path, parameters[i].keyPlace, parameters[i].values[combination[i]]);
    for (const auto& [path, value] : values) {
        requireKnownPath(path, value);
        set(path, value.place, value);
    }
    if (isOwnEnough) {
        Node laid = tree.own;
        applyPresets(laid, presets.get());
        isOwnEnough = saysTheSame(laid, tree.whole);
    }
    if (!isOwnEnough) {
        tree.own = tree.whole;
        tree.own.erase("use");
    }
    tree.testCase = buildCase(tree.whole, file, presets.get());
    tree.testCase.name += formatLabel(parameters, combination);
    return tree;
}

} // namespace crossray
