#include "tests/fuzz/case_generator.h"

#include "harness/base/outputs.h"
#include "harness/case/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

// How far from the ordinary the numbers of a case go: most findings need one odd number in an ordinary case.
enum class Temper { kTame, kMixed, kWild, kExtreme };

class Dice {
  public:
    explicit Dice(rc::Random random) : random_(random) {}
    double unit() { return static_cast<double>(random_.next() >> 11U) * 0x1p-53; }
    bool chance(double probability) { return unit() < probability; }
    size_t below(size_t count) { return static_cast<size_t>(random_.next() % count); }
    double between(double low, double high) { return low + (high - low) * unit(); }
    double ratio(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    double sign() { return chance(0.5) ? 1.0 : -1.0; }

  private:
    rc::Random random_;
};

// Keys whose largest values ask for memory and time and for nothing else. History has as many levels as its image.
double costlyFrom(const KeySpec& spec)
{
    if (spec.path() == "scene.size" || spec.path() == "probe.mirror.size") return 24;
    if (spec.path() == "scene.poison_every") return 5; // these images are small
    if (spec.path() == "environment.size") return 32;
    if (spec.path() == "environment.bounces") return 2;
    if (spec.path() == "scene.primitives.object") return 4;
    return spec.range.max;
}

// What is no matter of the shaders: names, files, expectations, and how a case is run and benched.
bool isDrawn(const KeySpec& spec)
{
    using enum KeyType;
    for (const KeyType type : {kString, kDate, kStringList, kTableOrPreset, kConstant, kExpansion}) {
        if (spec.type == type) return false;
    }
    if (!spec.table.empty()) return true;
    constexpr std::array<std::string_view, 14> kFixed{"schema",  "name",      "summary", "outputs",      "backends",
                                                      "timeout", "must_fail", "bench",   "needs",        "budget",
                                                      "gbuffer", "expect",    "expand",  "known_failure"};
    return std::find(kFixed.begin(), kFixed.end(), spec.key) == kFixed.end();
}

class Drawer {
  public:
    Drawer(rc::Random structure, rc::Random values) : structure_(structure), values_(values)
    {
        const double temper = values_.unit();
        temper_ = temper < 0.4    ? Temper::kTame
                  : temper < 0.7  ? Temper::kMixed
                  : temper < 0.85 ? Temper::kWild
                                  : Temper::kExtreme;
    }

    Node drawTable(std::string_view table)
    {
        Node node;
        for (const KeySpec& spec : keySpecs()) {
            if (spec.table != table || !isDrawn(spec)) continue;
            // Both are drawn for each key, so that one key's absence does not shift what is drawn for the next.
            const bool isThere = diceFor(table).chance(presence(spec));
            if (isThere || spec.required) setKey(node, spec.key, drawValue(spec));
        }
        return node;
    }

    Node drawValue(const KeySpec& spec)
    {
        using enum KeyType;
        Dice& dice = diceFor(spec.table);
        switch (spec.type) {
        case kChoice:
            return makeString(spec.choices[dice.below(spec.choices.size())]);
        case kChoiceList:
            return drawChoices(spec, dice);
        case kBoolean: {
            Node node;
            node.kind = NodeKind::kBoolean;
            node.boolean = dice.chance(0.5);
            return node;
        }
        case kInteger:
            return makeInteger(drawInteger(spec));
        case kSize:
            return makeList({makeInteger(drawInteger(spec)), makeInteger(drawInteger(spec))});
        case kVec3:
            return drawVector(spec, 3);
        case kExtents:
            return drawVector(spec, values_.chance(0.5) ? 2 : 3);
        case kVec3List:
            return drawVectors(spec, dice.chance(0.5) ? 6 : 1 + dice.below(4));
        case kRotation:
            return drawRotation();
        case kTable:
            return drawTable(subTableName(spec.table, spec.key));
        case kTableList:
            return drawTables(spec, dice);
        default:
            return makeNumber(drawNumber(spec));
        }
    }

  private:
    static bool isOfScene(std::string_view table)
    {
        return table.starts_with("scene") || table.starts_with("history.moved");
    }
    Dice& diceFor(std::string_view table) { return isOfScene(table) ? values_ : structure_; }

    // Alternatives of which exactly one may stand are rarely drawn alone; the reader sorts that out.
    static double presence(const KeySpec& spec)
    {
        if (spec.table == "environment" && spec.defaultWords == "one content is required") return 0.3;
        if (spec.path() == "scene.poison") return 0.25;
        if (spec.key == "history" || spec.key == "probe_profile") return 0.3;
        if (spec.path() == "material.refraction_model") return 0.5;
        if (spec.path() == "scene.generator" || spec.path() == "scene.seed") return 0.4;
        if (spec.path() == "scene" || spec.path() == "projection" || spec.path() == "projection.model") return 1.0;
        if (spec.path() == "scene.size" || spec.path() == "scene.primitives") return 1.0;
        return 0.5;
    }

    Node drawChoices(const KeySpec& spec, Dice& dice)
    {
        std::vector<Node> items;
        for (const std::string& choice : spec.choices) {
            if (dice.chance(0.6)) items.push_back(makeString(choice));
        }
        return makeList(std::move(items));
    }

    Node drawTables(const KeySpec& spec, Dice& dice)
    {
        std::vector<Node> items;
        const size_t count = spec.key == "probe" ? dice.below(10) / 2 : dice.below(4);
        for (size_t i = 0; i < count; ++i)
            items.push_back(drawTable(subTableName(spec.table, spec.key)));
        return makeList(std::move(items));
    }

    Node drawVector(const KeySpec& spec, size_t count)
    {
        std::vector<Node> items;
        const bool isAlongAxis = values_.chance(0.15); // exact zeros, and directions along an axis
        const size_t axis = values_.below(count);
        for (size_t i = 0; i < count; ++i) {
            const double number = drawNumber(spec);
            items.push_back(makeNumber(isAlongAxis && i != axis && spec.range.holds(0) ? 0.0 : number));
        }
        return makeList(std::move(items));
    }

    Node drawVectors(const KeySpec& spec, size_t count)
    {
        std::vector<Node> items;
        for (size_t i = 0; i < count; ++i)
            items.push_back(drawVector(spec, 3));
        return makeList(std::move(items));
    }

    Node drawRotation()
    {
        std::vector<Node> angles;
        for (int i = 0; i < 3; ++i)
            angles.push_back(makeNumber(values_.chance(0.5) ? 90.0 * static_cast<double>(values_.below(5)) - 180.0
                                                            : values_.between(-180, 180)));
        return makeList(std::move(angles));
    }

    int64_t drawInteger(const KeySpec& spec)
    {
        const double low = std::max(spec.range.min, -1e6), high = std::min(costlyFrom(spec), 1e9);
        if (values_.chance(temper_ >= Temper::kWild ? 0.3 : 0.1))
            return static_cast<int64_t>(values_.chance(0.5) ? low : high);
        if (spec.path() == "environment.size") return int64_t{1} << values_.below(6);
        // Small ones are where borders and caps are met.
        const double span = high - low;
        const double number = span <= 32 ? values_.between(low, high + 1) : low + values_.ratio(1, span + 1) - 1;
        return static_cast<int64_t>(std::clamp(std::floor(number), low, high));
    }

    double defaultOf(const KeySpec& spec)
    {
        const bool isNumber = spec.defaultValue && spec.defaultValue->isNumber();
        return isNumber && spec.defaultValue->number != 0.0 ? spec.defaultValue->number : 1.0;
    }

    double ordinaryNumber(const KeySpec& spec)
    {
        const bool isSigned = spec.range.min < 0;
        if (std::isfinite(spec.range.min) && spec.range.max <= 10.0)
            return values_.between(spec.range.min, spec.range.max);
        const double size = values_.chance(0.5) ? defaultOf(spec) * values_.ratio(0.2, 5) : values_.ratio(0.05, 20);
        return isSigned ? values_.sign() * size : size;
    }

    // Borders, zeros, what is nearly there, and what is far off.
    double oddNumber(const KeySpec& spec)
    {
        const bool isSigned = spec.range.min < 0;
        constexpr std::array<double, 16> kSpecial{0.0,  -0.0, 1.0, -1.0, 0.5,   2.0,  1e-3, 1e-6,
                                                  1e-7, 1e3,  1e4, 1e-5, 65504, 90.0, 1e-4, 1e-12};
        switch (values_.below(temper_ == Temper::kExtreme ? 7 : temper_ == Temper::kWild ? 5 : 4)) {
        case 0:
            return std::isfinite(spec.range.min) ? spec.range.min : 0.0;
        case 1:
            return std::isfinite(spec.range.max) ? spec.range.max : 1e3;
        case 2:
            return kSpecial[values_.below(kSpecial.size())];
        case 3: // beside a special one, by a few units in the last place of a float
            return kSpecial[values_.below(kSpecial.size())] * (1.0 + values_.between(-4, 4) * 0x1p-24);
        case 4:
            return (isSigned ? values_.sign() : 1.0) * values_.ratio(1e-9, 1e9);
        case 5:
            return (isSigned ? values_.sign() : 1.0) * values_.ratio(1e-30, 1e15);
        default: // to the ends of what a float holds
            return (isSigned ? values_.sign() : 1.0) * values_.ratio(1e-44, 3e38);
        }
    }

    double drawNumber(const KeySpec& spec)
    {
        const double share = temper_ == Temper::kTame ? 0.04 : temper_ == Temper::kWild ? 0.4 : 0.15;
        for (int attempt = 0; attempt < 16; ++attempt) {
            const double number = values_.chance(share) ? oddNumber(spec) : ordinaryNumber(spec);
            if (spec.range.holds(number)) return number;
        }
        return spec.range.holds(defaultOf(spec)) ? defaultOf(spec) : spec.range.min;
    }

    Dice structure_, values_;
    Temper temper_ = Temper::kTame;
};

Node drawExpectations()
{
    Node expect;
    setKey(expect, "output", makeString("HitSuccess"));
    setKey(expect, "agree", makeList({makeString("cpu32"), makeString("cpu64")}));
    return makeList({expect});
}

// The key at a place of the file, and the table that it is in.
struct Found {
    Node* table = nullptr;
    size_t entry = 0;
    size_t item = 0; // of a list, where an item stands there
    bool isItem = false;
    std::string schemaTable;
};

bool stands(const Place& place, const SourcePosition& position)
{
    return place.line == position.line && place.column == position.column;
}

// The innermost wins: a table and its first key may stand at one place.
void findAt(Node& table, const std::string& schemaTable, const SourcePosition& position, std::optional<Found>& found)
{
    for (size_t i = 0; i < table.entries.size(); ++i) {
        NodeEntry& entry = table.entries[i];
        if (stands(entry.keyPlace, position) || stands(entry.value.place, position))
            found = {&table, i, 0, false, schemaTable};
        const std::string inner = subTableName(schemaTable, entry.key);
        if (entry.value.kind == NodeKind::kTable) findAt(entry.value, inner, position, found);
        if (entry.value.kind != NodeKind::kList) continue;
        for (size_t item = 0; item < entry.value.items.size(); ++item) {
            Node& node = entry.value.items[item];
            if (stands(node.place, position)) found = {&table, i, item, true, schemaTable};
            if (node.kind == NodeKind::kTable) findAt(node, inner, position, found);
        }
    }
}

// "KEY" is missing[ in [TABLE]]
struct Missing {
    std::string key, table;
};

std::optional<Missing> readMissing(const std::string& message)
{
    const size_t is = message.find("\" is missing");
    if (is == std::string::npos) return std::nullopt;
    const size_t open = message.rfind('"', is - 1);
    Missing missing{message.substr(open + 1, is - open - 1), {}};
    constexpr std::string_view kIn = "\" is missing in [";
    if (message.compare(is, kIn.size(), kIn) == 0) {
        const size_t start = is + kIn.size();
        missing.table = message.substr(start, message.find(']', start) - start);
    }
    return missing;
}

// The table of the tree by its dotted path, made where it is not there.
Node* findTable(Node& root, const std::string& path)
{
    Node* table = &root;
    for (size_t start = 0; start <= path.size();) {
        const size_t end = std::min(path.find('.', start), path.size());
        const std::string key = path.substr(start, end - start);
        if (table->find(key) == nullptr) setKey(*table, key, Node{});
        table = &table->findEntry(key)->value;
        if (table->kind != NodeKind::kTable) return nullptr;
        start = end + 1;
    }
    return table;
}

// Draws the key that is missed. Where the message names no table it is that of the key it points at, or one inside.
bool addMissing(Node& root, const Missing& missing, const Found& found, Drawer& drawer)
{
    Node* table = found.table;
    std::string schemaTable = found.schemaTable;
    Node& pointed = found.isItem ? found.table->entries[found.entry].value.items[found.item]
                                 : found.table->entries[found.entry].value;
    const std::string inner = subTableName(found.schemaTable, found.table->entries[found.entry].key);
    if (findKeySpec(inner, missing.key) != nullptr && pointed.kind == NodeKind::kTable) {
        table = &pointed;
        schemaTable = inner;
    }
    if (findKeySpec(missing.table, missing.key) != nullptr && !missing.table.empty() && schemaTable != missing.table) {
        table = findTable(root, missing.table);
        schemaTable = missing.table;
    }
    const KeySpec* spec = findKeySpec(schemaTable, missing.key);
    if (table == nullptr || spec == nullptr || !isDrawn(*spec)) return false;
    setKey(*table, missing.key, drawer.drawValue(*spec));
    return true;
}

void takeAway(const Found& found)
{
    auto& entries = found.table->entries;
    if (found.isItem) {
        auto& items = entries[found.entry].value.items;
        items.erase(items.begin() + static_cast<std::ptrdiff_t>(found.item));
    } else {
        entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(found.entry));
    }
}

// "scene: primitive 3: ..." counts those of the generator, those of `primitives` and those of `primitive`, in this
// order.
bool takeAwayPrimitive(Node& root, const std::string& message, size_t count)
{
    constexpr std::string_view kStart = "scene: primitive ";
    const size_t at = message.find(kStart);
    if (at == std::string::npos) return false;
    const size_t number = std::stoul(message.substr(at + kStart.size())); // from 1
    if (number == 0 || number > count) return false;
    size_t fromEnd = count + 1 - number; // 1: the last
    Node& scene = root.findEntry("scene")->value;
    for (const std::string_view key : {"primitive", "primitives"}) {
        if (scene.find(key) == nullptr) continue;
        auto& items = scene.findEntry(key)->value.items;
        if (fromEnd <= items.size()) {
            items.erase(items.end() - static_cast<std::ptrdiff_t>(fromEnd));
            return true;
        }
        fromEnd -= items.size();
    }
    return false;
}

} // namespace

Node drawCase(rc::Random structure, rc::Random values)
{
    Node root;
    setKey(root, "schema", makeInteger(1));
    setKey(root, "name", makeString("fuzz"));
    setKey(root, "summary", makeString("A random case."));
    std::vector<Node> outputs;
    for (const OutputInfo& output : allOutputs())
        outputs.push_back(makeString(output.name));
    setKey(root, "outputs", makeList(std::move(outputs)));
    Node drawn = Drawer(structure, values).drawTable("");
    root.entries.insert(root.entries.end(), drawn.entries.begin(), drawn.entries.end());
    setKey(root, "expect", drawExpectations());
    return root;
}

std::unique_ptr<CaseData> readOrRepair(Node& root, rc::Random structure, rc::Random values,
                                       const std::filesystem::path& file)
{
    constexpr int kMostRepairs = 200;
    Drawer drawer(structure, values);
    size_t primitives = 0; // of the scene that was refused
    for (int repair = 0; repair < kMostRepairs; ++repair) {
        try {
            const Case testCase = readTree(root, file);
            primitives = testCase.scene.primitives.size();
            auto data = std::make_unique<CaseData>(testCase);
            data->environments(); // a capture may be refused, too
            return data;
        } catch (const InputError& error) {
            root = parseToml(formatCase(root), file.string()); // with places
            if (takeAwayPrimitive(root, error.what(), primitives)) continue;
            std::optional<Found> found;
            findAt(root, "", error.position(), found);
            if (!found) return nullptr;
            const std::optional<Missing> missing = readMissing(error.what());
            if (missing && addMissing(root, *missing, *found, drawer)) continue;
            takeAway(*found);
        }
    }
    return nullptr;
}

void addReceiver(Node& root, const Case& testCase, rc::Random values)
{
    Dice dice(values);
    const Camera& camera = testCase.camera;
    const bool isOrthographic = camera.projection == ProjectionKind::kOrthographic;
    const double half =
        isOrthographic ? camera.orthographicHeight / 2 : std::tan(glm::radians(camera.fovYDegrees) / 2); // a metre away
    const double far =
        camera.depthConvention == DepthConvention::kInfiniteReversed ? camera.nearDistance * 1e4 : camera.farDistance;
    const double distance =
        camera.nearDistance * std::pow(std::min(far / camera.nearDistance, 1e6), dice.between(0.05, 0.95));
    const double size = half * (isOrthographic ? 1.0 : distance) * dice.ratio(0.2, 4.0);
    const glm::dvec3 center = glm::dvec3(camera.worldFromView * glm::dvec4(0, 0, -distance, 1));
    Node receiver;
    constexpr std::array<const char*, 3> kShapes{"sphere", "box", "plane"};
    const bool reflects = testCase.effect == TraceEffect::kReflection; // a plane of glass has no inside
    const std::string shape = kShapes[dice.below(reflects ? 3 : 2)];
    setKey(receiver, "shape", makeString(shape));
    setKey(receiver, "center", makeList({makeNumber(center.x), makeNumber(center.y), makeNumber(center.z)}));
    setKey(receiver, "material", makeString(reflects ? "mirror" : "glass"));
    if (shape == "sphere") {
        setKey(receiver, "radius", makeNumber(std::max(size, 1e-30)));
    } else {
        std::vector<Node> extents(shape == "box" ? 3 : 2, makeNumber(std::max(size, 1e-30)));
        setKey(receiver, "half_extents", makeList(std::move(extents)));
        std::vector<Node> angles;
        for (int i = 0; i < 3; ++i)
            angles.push_back(
                makeNumber(dice.chance(0.4) ? 90.0 * static_cast<double>(dice.below(4)) : dice.between(-180, 180)));
        setKey(receiver, "rotation", makeList(std::move(angles)));
    }
    Node* scene = &root.findEntry("scene")->value;
    if (scene->find("primitives") == nullptr) setKey(*scene, "primitives", makeList({}));
    auto& items = scene->findEntry("primitives")->value.items;
    items.push_back(std::move(receiver));
}

rc::Gen<Node> genCase(uint64_t structureSeed, std::filesystem::path scratch)
{
    return [=](const rc::Random& random, int) {
        rc::Random values = random;
        rc::Random structure(structureSeed);
        Node root = drawCase(structure.split(), values.split());
        const std::unique_ptr<CaseData> data = readOrRepair(root, structure, values.split(), scratch);
        if (data) {
            const std::vector<bool>& traced = data->tracedPixels();
            const bool traces = std::find(traced.begin(), traced.end(), true) != traced.end();
            if (Dice(values.split()).chance(traces ? 0.3 : 0.9)) addReceiver(root, data->testCase(), values.split());
        }
        return rc::shrinkable::shrinkRecur(std::move(root), shrinkCase);
    };
}

} // namespace crossray
