#include "harness/inspector/controls.h"

#include "harness/case/build.h"
#include "harness/case/key_path.h"
#include "harness/case/presets.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 8> kTables{"camera",  "scene", "material", "projection",
                                                  "history", "probe", "profile",  "sky"};
// Every case has them, whether its file says so or not.
constexpr std::array<std::string_view, 4> kAlways{"camera", "material", "projection", "projection.linear"};

bool isOneOf(std::span<const std::string_view> names, std::string_view name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool contains(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

std::string unitOf(const KeySpec& spec)
{
    if (contains(spec.key, "degrees") || contains(spec.summary, "in degrees") ||
        contains(spec.summary, "Euler degrees"))
        return "degrees";
    if (spec.key == "size" || contains(spec.summary, "Pixels") || contains(spec.summary, "pixels")) return "px";
    if (contains(spec.summary, "1/m")) return "1/m";
    if (contains(spec.summary, "metres") || contains(spec.summary, "Metres")) return "m";
    return "";
}

std::string labelOf(const KeySpec& spec)
{
    if (spec.key == "ior") return "IOR";
    if (spec.key == "fov") return "field of view";
    std::string label = spec.key;
    std::replace(label.begin(), label.end(), '_', ' ');
    return label;
}

std::string componentOf(const KeySpec& spec, size_t index)
{
    static constexpr std::string_view kSize[] = {"width", "height"}, kColor[] = {"red", "green", "blue"},
                                      kAxes[] = {"x", "y", "z"};
    if (spec.type == KeyType::kSize) return std::string(kSize[index]);
    const bool isColor = contains(spec.key, "color") || spec.table == "scene.sky" || spec.key == "solid";
    return std::string(isColor ? kColor[index] : kAxes[index]);
}

struct Rule {
    std::string_view key, other;
    std::vector<std::string> values;
};

// Keys that a setting of another makes idle.
std::optional<Control::When> conditionOf(const std::string& schemaName)
{
    static const std::vector<Rule> rules{
        {"camera.fov", "camera.projection", {"perspective"}},
        {"camera.height", "camera.projection", {"orthographic"}},
        {"camera.far", "camera.depth", {"reversed", "standard"}},
        {"material.thickness", "material.refraction_model", {"sphere", "box"}},
        {"projection.min_level", "projection.model", {"hiz"}},
        {"projection.max_level", "projection.model", {"hiz", "patches"}},
        {"projection.max_iterations", "projection.model", {"hiz", "patches", "own"}},
        {"projection.depth_bias", "projection.model", {"hiz", "own"}},
        {"projection.caution", "projection.model", {"patches"}},
        {"projection.depth_error", "projection.model", {"patches"}},
        {"projection.linear.", "projection.model", {"linear"}},
        {"projection.proxy.radius", "projection.model", {"proxy_sphere"}},
        {"projection.proxy.half_extents", "projection.model", {"proxy_box"}},
        {"projection.proxy.", "projection.model", {"proxy_box", "proxy_sphere"}},
    };
    for (const Rule& rule : rules) {
        const bool isTable = rule.key.ends_with('.');
        if (isTable ? schemaName.starts_with(rule.key) : schemaName == rule.key)
            return Control::When{std::string(rule.other), rule.values};
    }
    return std::nullopt;
}

Node makeInteger(int value)
{
    Node node;
    node.kind = NodeKind::kInteger;
    node.integer = value;
    node.number = value;
    return node;
}

// What a key that is left out stands for where the schema has words alone.
std::optional<Node> impliedDefault(const std::string& path, const Case& testCase)
{
    const ProjectionModel model = testCase.projection.model;
    if (path == "projection.max_level")
        return makeInteger(model == ProjectionModel::kPatches ? PatchSettings{}.maxLevel : HizSettings{}.maxLevel);
    if (path == "projection.max_iterations") {
        if (model == ProjectionModel::kPatches) return makeInteger(PatchSettings{}.maxIterations);
        if (model == ProjectionModel::kOwn) return makeInteger(OwnSettings{}.maxIterations);
        return makeInteger(HizSettings{}.maxIterations);
    }
    return std::nullopt;
}

class Collector {
  public:
    explicit Collector(const CaseTree& tree) : tree_(tree), presets_(findPresets(tree.testCase.file.parent_path())) {}

    std::vector<Control> collect()
    {
        const bool isRecorded = tree_.testCase.recorded.has_value();
        for (const KeySpec& spec : keySpecs()) {
            if (!spec.table.empty()) continue;
            const Node* const node = tree_.whole.find(spec.key);
            const bool hasProbes = !tree_.testCase.probes.empty();
            if ((spec.key == "dominant_direction" || spec.key == "probe_profile") && hasProbes)
                addValue(spec, spec.key, "", node);
            if (!isOneOf(kTables, spec.key) || (isRecorded && (spec.key == "camera" || spec.key == "scene"))) continue;
            addTableOrList(spec, spec.key, node);
        }
        return std::move(controls_);
    }

  private:
    void addTableOrList(const KeySpec& spec, const std::string& path, const Node* node)
    {
        if (spec.type == KeyType::kTableList) {
            for (size_t i = 0; node != nullptr && i < node->items.size(); ++i)
                addTable(fmt::format("{}.{}", path, i), &node->items[i]);
        } else if (node != nullptr || isOneOf(kAlways, path)) {
            addTable(path, node);
        }
    }

    void addTable(const std::string& path, const Node* table)
    {
        const std::string name = schemaPath(splitPath(path + ".")); // "scene.primitives." of one of them
        const std::string schemaName = name.substr(0, name.size() - 1);
        for (const KeySpec& spec : keySpecs()) {
            if (spec.table != schemaName) continue;
            const Node* const node = table != nullptr ? table->find(spec.key) : nullptr;
            const std::string key = path + "." + spec.key;
            if (spec.type == KeyType::kTable || spec.type == KeyType::kTableList ||
                (spec.type == KeyType::kRotation && node != nullptr && node->kind == NodeKind::kTable)) {
                addTableOrList(spec, key, node);
            } else {
                addValue(spec, key, path, node);
            }
        }
    }

    // A generator has a camera of its own, and a list of primitives would be long with all its defaults.
    bool isLeftOut(const KeySpec& spec, const Node* node) const
    {
        if (spec.table == "camera" && (spec.key == "eye" || spec.key == "target" || spec.key == "up"))
            return findByPath(tree_.whole, "scene.generator") != nullptr;
        if (spec.table == "scene" && spec.key == "seed") return findByPath(tree_.whole, "scene.generator") == nullptr;
        return spec.table == "scene.primitives" && node == nullptr;
    }

    // Whether the key may be given at all beside the others.
    bool fits(const std::string& path, const Node& value) const
    {
        try {
            Node root = tree_.whole;
            setByPath(root, path, {}, value);
            buildCase(root, tree_.testCase.file, presets_.get());
            return true;
        } catch (const InputError&) {
            return false;
        }
    }

    void addValue(const KeySpec& spec, const std::string& path, const std::string& group, const Node* node)
    {
        if (isLeftOut(spec, node)) return;
        Control control;
        control.path = path;
        control.group = group;
        control.label = labelOf(spec);
        control.unit = unitOf(spec);
        control.summary = spec.summary;
        control.minimum = spec.range.min;
        control.maximum = spec.range.max;
        control.minimumIsOut = spec.range.minIsOut;
        control.maximumIsOut = spec.range.maxIsOut;
        control.choices = spec.choices;
        control.when = conditionOf(schemaPath(splitPath(path)));
        control.preset = spec.defaultValue ? spec.defaultValue : impliedDefault(path, tree_.testCase);
        if (node != nullptr) control.value = *node;
        if (!control.value) control.value = control.preset;
        if (!control.value) return; // what is left out and has no default is no value to turn
        if (node == nullptr && !fits(path, *control.value)) return;
        switch (spec.type) {
        case KeyType::kNumber:
            return add(control, ControlType::kNumber);
        case KeyType::kInteger:
            return add(control, ControlType::kInteger);
        case KeyType::kBoolean:
            return add(control, ControlType::kBoolean);
        case KeyType::kChoice:
            return add(control, ControlType::kChoice);
        default:
            if (isNumberList(spec)) addComponents(spec, control);
        }
    }

    void add(Control control, ControlType type)
    {
        control.type = type;
        controls_.push_back(std::move(control));
    }

    void addComponents(const KeySpec& spec, const Control& list)
    {
        for (size_t i = 0; i < list.value->items.size(); ++i) {
            Control control = list;
            control.path += fmt::format(".{}", i);
            control.label += fmt::format(" {}", componentOf(spec, i));
            control.value = list.value->items[i];
            if (control.preset && i < control.preset->items.size()) control.preset = Node(control.preset->items[i]);
            add(control, spec.type == KeyType::kSize ? ControlType::kInteger : ControlType::kNumber);
        }
    }

    const CaseTree& tree_;
    const std::shared_ptr<const Node> presets_;
    std::vector<Control> controls_;
};

Json toJson(const std::optional<Node>& node)
{
    if (!node) return nullptr;
    switch (node->kind) {
    case NodeKind::kInteger:
        return node->integer;
    case NodeKind::kNumber:
        return node->number;
    case NodeKind::kBoolean:
        return node->boolean;
    default:
        return node->text;
    }
}

std::string_view nameOf(ControlType type)
{
    switch (type) {
    case ControlType::kNumber:
        return "number";
    case ControlType::kInteger:
        return "integer";
    case ControlType::kBoolean:
        return "boolean";
    case ControlType::kChoice:
        break;
    }
    return "choice";
}

} // namespace

std::vector<Control> listControls(const CaseTree& tree)
{
    return Collector(tree).collect();
}

std::string formatControlsJson(const std::vector<Control>& controls)
{
    Json list = Json::array();
    for (const Control& control : controls) {
        Json entry{{"path", control.path}, {"group", control.group},     {"label", control.label},
                   {"unit", control.unit}, {"summary", control.summary}, {"type", nameOf(control.type)}};
        if (std::isfinite(control.minimum)) entry["minimum"] = control.minimum;
        if (std::isfinite(control.maximum)) entry["maximum"] = control.maximum;
        if (control.minimumIsOut) entry["exclusiveMinimum"] = true;
        if (control.maximumIsOut) entry["exclusiveMaximum"] = true;
        entry["value"] = toJson(control.value);
        entry["default"] = toJson(control.preset);
        if (control.type == ControlType::kChoice) entry["choices"] = control.choices;
        if (control.when) entry["when"] = {{"path", control.when->path}, {"values", control.when->values}};
        list.push_back(std::move(entry));
    }
    return Json{{"controls", list}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace crossray
