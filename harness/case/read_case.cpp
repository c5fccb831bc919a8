// From a file to its cases: presets under it, overrides over it, parameter lists multiplied out, each result checked
// and built.
#include "harness/case/case.h"

#include "harness/case/build.h"
#include "harness/case/expand.h"
#include "harness/case/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace crossray {

namespace {

namespace fs = std::filesystem;

bool isNameCharacter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

bool isCaseName(std::string_view name)
{
    bool wordStarts = true;
    for (const char c : name) {
        if (c == '/' ? wordStarts : !isNameCharacter(c)) return false;
        wordStarts = c == '/';
    }
    return !name.empty() && !wordStarts;
}

bool isTag(std::string_view tag)
{
    return std::all_of(tag.begin(), tag.end(), [](char c) { return isNameCharacter(c) || c == '-'; }) && !tag.empty();
}

void buildTop(const TableReader& top, Case& testCase)
{
    testCase.name = top.text("name");
    if (!isCaseName(testCase.name)) {
        throw InputError(
            top.position("name"),
            fmt::format("\"name\" is \"{}\"; words of a-z, 0-9 and _, joined by /, are allowed", testCase.name));
    }
    testCase.summary = top.text("summary");
    testCase.tags = top.texts("tags");
    for (const Node& tag : top.find("tags")->items) {
        if (!isTag(tag.text)) {
            throw InputError(tag.place.position(),
                             fmt::format("\"{}\" is no tag; a word of a-z, 0-9, _ and - is allowed", tag.text));
        }
    }
    testCase.backends = top.texts("backends");
    testCase.timeoutSeconds = top.number("timeout");
    testCase.mustFail = top.boolean("must_fail");
    if (top.has("bench")) testCase.benchFamily = top.text("bench");
    if (top.has("needs") != top.has("budget")) {
        throw InputError(top.position(top.has("needs") ? "needs" : "budget"),
                         "\"needs\" and \"budget\" stand together; both or neither are allowed");
    }
    if (top.has("needs")) {
        testCase.needs = top.text("needs");
        testCase.budget = top.text("budget");
    }
    if (top.has("scene") == top.has("gbuffer")) {
        throw InputError(top.position(top.has("gbuffer") ? "gbuffer" : ""),
                         top.has("gbuffer") ? "[scene] and [gbuffer] are both given; exactly one of them is allowed"
                                            : "[scene] or [gbuffer] is missing; exactly one of them is required");
    }
}

// All that is written, in id order: the expected outputs, those asked for, and those that masks and budgets read.
void collectOutputs(const TableReader& top, Case& testCase)
{
    std::set<std::string, std::less<>> names;
    for (std::string& name : top.texts("outputs"))
        names.insert(std::move(name));
    for (const Expectation& expectation : testCase.expectations) {
        if (!expectation.output.name.empty()) names.emplace(expectation.output.name);
        const bool asksForHits = expectation.where == Where::kHits || expectation.where == Where::kAnswerableHits;
        if (asksForHits || expectation.budget) names.emplace("HitSuccess");
        if (expectation.budget) names.emplace("HitPositionSS");
    }
    for (const OutputInfo& output : allOutputs()) {
        if (names.contains(output.name)) testCase.outputs.push_back(output);
    }
}

} // namespace

Case buildCase(const Node& root, const fs::path& file, const Node* presets)
{
    checkTable(root, "");
    Case testCase;
    testCase.file = file;
    testCase.position = {file.string(), 1, 1};
    const TableReader top(&root, "");
    buildTop(top, testCase);
    buildMaterial(top, testCase);
    buildProjection(top, testCase);
    if (top.has("scene")) {
        buildScene(top, testCase);
        buildCamera(top, testCase);
    } else {
        buildRecorded(top, testCase);
    }
    buildHistory(top, testCase);
    buildProbes(top, testCase);
    buildProfile(top, testCase);
    buildSky(top, testCase);
    buildHierarchy(top, testCase);
    buildExpectations(
        root, [&](const Node& name) -> const Node& { return findPreset(presets, "tolerance", name); }, testCase);
    buildKnownFailures(root, testCase);
    collectOutputs(top, testCase);
    spreadOverOutputs(testCase);
    return testCase;
}

namespace {

// Every combination of the parameters' values, the first parameter slowest.
std::vector<Case> buildProduct(const Node& root, const std::vector<Parameter>& parameters, const fs::path& file,
                               const Node* presets)
{
    std::vector<Case> cases;
    std::set<std::string> names;
    Combination combination(parameters.size(), 0);
    do {
        Node variant = root;
        for (size_t i = 0; i < parameters.size(); ++i)
            setByPath(variant, parameters[i].path, parameters[i].keyPlace, parameters[i].values[combination[i]]);
        cases.push_back(buildCase(variant, file, presets));
        cases.back().name += formatLabel(parameters, combination);
        if (!names.insert(cases.back().name).second) {
            throw InputError(parameters.back().values[combination.back()].place.position(),
                             fmt::format("[expand] makes \"{}\" twice; each name once is allowed", cases.back().name));
        }
    } while (advance(parameters, combination));
    return cases;
}

} // namespace

// A value as it would stand in the file; what is not TOML is a string, so that `--set projection.model=hiz` needs no
// quotes.
Node parseOverride(const std::string& path, const std::string& text)
{
    const std::string fileName = "--set " + path;
    try {
        const Node root = parseToml("value = " + text, fileName);
        if (root.entries.size() == 1) {
            Node value = root.entries.front().value;
            value.place.line = value.place.column = 0;
            return value;
        }
    } catch (const InputError& error) {
        const std::string message = std::string(error.what()).substr(error.position().format().size() + 2);
        if (!message.starts_with("not valid TOML")) throw InputError({fileName}, message);
    }
    Node value;
    value.kind = NodeKind::kString;
    value.text = text;
    value.place.file = std::make_shared<const std::string>(fileName);
    return value;
}

std::vector<Case> readCaseFile(const fs::path& file)
{
    return readCaseFile(file, {});
}

std::vector<Case> readCaseFile(const fs::path& file, const std::map<std::string, std::string>& overrides)
{
    Node root = readTomlFile(file);
    const std::shared_ptr<const Node> presets = findPresets(file.parent_path());
    applyPresets(root, presets.get());
    std::vector<Parameter> parameters = takeParameters(root);
    for (const auto& [path, text] : overrides) {
        const Node value = parseOverride(path, text);
        setByPath(root, path, value.place, value);
        std::erase_if(parameters, [&path = path](const Parameter& parameter) { return parameter.path == path; });
    }
    return buildProduct(root, parameters, file, presets.get());
}

std::vector<fs::path> findCaseFiles(const fs::path& root)
{
    std::error_code error;
    if (fs::is_regular_file(root, error)) return {root};
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator entry(root, error), end; !error && entry != end; entry.increment(error)) {
        const fs::path& path = entry->path();
        const bool isList = path.filename() == "presets.toml" || path.filename() == "sweeps.toml";
        if (path.extension() == ".toml" && !isList && entry->is_regular_file()) files.push_back(path);
    }
    if (error) throw InputError({root.string()}, "the folder cannot be read: " + error.message());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace crossray
