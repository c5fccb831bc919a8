// What is cut from a failing case: whole tables and keys first, then items of lists, then numbers towards plain ones.
#include "tests/fuzz/case_generator.h"

#include "harness/case/schema.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace crossray {

namespace {

// What every case has, and what says what is looked at.
bool isKept(const NodeEntry& entry)
{
    constexpr std::array<std::string_view, 6> kKept{"schema", "name", "summary", "outputs", "expect", "scene"};
    return std::find(kKept.begin(), kKept.end(), entry.key) != kKept.end();
}

class Cutter {
  public:
    explicit Cutter(const Node& root) : copy_(root) {}

    std::vector<Node> cut()
    {
        cutTable(copy_, "");
        std::stable_sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) { return a.rank < b.rank; });
        std::vector<Node> nodes;
        for (Cut& cut : cuts_)
            nodes.push_back(std::move(cut.node));
        return nodes;
    }

  private:
    struct Cut {
        int rank; // the boldest first
        Node node;
    };

    void keep(int rank) { cuts_.push_back({rank, copy_}); }

    void cutTable(Node& table, const std::string& schemaTable)
    {
        for (size_t i = 0; i < table.entries.size(); ++i) {
            const NodeEntry entry = table.entries[i];
            const bool isWhole = &table == &copy_ && isKept(entry);
            if (!isWhole) {
                table.entries.erase(table.entries.begin() + static_cast<std::ptrdiff_t>(i));
                keep(entry.value.kind == NodeKind::kTable || entry.value.kind == NodeKind::kList ? 0 : 2);
                table.entries.insert(table.entries.begin() + static_cast<std::ptrdiff_t>(i), entry);
            }
            if (isWhole && entry.key != "scene") continue;
            cutValue(table.entries[i].value, schemaTable, entry.key);
        }
    }

    void cutValue(Node& value, const std::string& table, const std::string& key)
    {
        const KeySpec* spec = findKeySpec(table, key);
        if (value.kind == NodeKind::kTable) return cutTable(value, subTableName(table, key));
        if (spec == nullptr) return;
        if (value.kind == NodeKind::kList) return cutList(value, table, key);
        if (value.kind == NodeKind::kString && spec->type == KeyType::kChoice) cutChoice(value, *spec);
        if (value.isNumber()) cutNumber(value, *spec);
    }

    void cutList(Node& list, const std::string& table, const std::string& key)
    {
        const KeySpec& spec = *findKeySpec(table, key);
        const bool isOfFixedLength = spec.type == KeyType::kVec3 || spec.type == KeyType::kSize ||
                                     spec.type == KeyType::kExtents || spec.type == KeyType::kRotation;
        for (size_t i = 0; i < list.items.size(); ++i) {
            if (!isOfFixedLength) {
                const Node item = list.items[i];
                list.items.erase(list.items.begin() + static_cast<std::ptrdiff_t>(i));
                keep(1);
                list.items.insert(list.items.begin() + static_cast<std::ptrdiff_t>(i), item);
            }
            Node& item = list.items[i];
            if (item.kind == NodeKind::kTable) cutTable(item, subTableName(table, key));
            if (item.isNumber()) cutNumber(item, spec);
        }
    }

    void tryValue(Node& node, Node smaller, int rank)
    {
        std::swap(node, smaller);
        keep(rank);
        std::swap(node, smaller);
    }

    // Earlier choices are the plainer ones.
    void cutChoice(Node& node, const KeySpec& spec)
    {
        if (node.text != spec.choices.front()) tryValue(node, makeString(spec.choices.front()), 3);
    }

    void cutNumber(Node& node, const KeySpec& spec)
    {
        const double value = node.number;
        const bool isInteger = node.kind == NodeKind::kInteger;
        std::vector<double> plainer{0.0, 1.0};
        if (isInteger) {
            plainer.push_back(std::floor(value / 2));
            plainer.push_back(value - 1);
        } else {
            const double unit = std::pow(10.0, std::floor(std::log10(std::max(std::fabs(value), 1e-300))));
            plainer.insert(plainer.end(), {std::round(value / unit) * unit, std::round(value / unit * 10) * unit / 10,
                                           std::round(value / unit * 1000) * unit / 1000});
        }
        for (const double candidate : plainer) {
            const bool isPlainer =
                weigh(candidate) < weigh(value) || (isInteger && std::fabs(candidate) < std::fabs(value));
            if (!isPlainer || !spec.range.holds(candidate)) continue;
            tryValue(node, isInteger ? makeInteger(static_cast<int64_t>(candidate)) : makeNumber(candidate), 4);
        }
    }

    // By the number of characters; so that cutting comes to an end, each cut is shorter than what it replaces.
    static size_t weigh(double value)
    {
        if (value == 0.0) return std::signbit(value) ? 2 : 0;
        if (value == 1.0) return 1;
        return 2 + formatCase([&] {
                       Node table;
                       setKey(table, "x", makeNumber(value));
                       return table;
                   }())
                       .size();
    }

    Node copy_;
    std::vector<Cut> cuts_;
};

} // namespace

rc::Seq<Node> shrinkCase(const Node& root)
{
    return rc::seq::fromContainer(Cutter(root).cut());
}

} // namespace crossray
