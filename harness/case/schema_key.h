// How the tables of the schema are written down; nothing but schema_table*.cpp includes it.
#pragma once

#include "harness/case/schema.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crossray {

// One line a key: what it may be, what it is when it is left out, what it means.
class Key {
  public:
    Key(std::string_view table, std::string_view key, KeyType type)
    {
        spec_.table = table;
        spec_.key = key;
        spec_.type = type;
    }
    Key& above(double bound) { return spec_.range.min = bound, spec_.range.minIsOut = true, *this; }
    Key& atLeast(double bound) { return spec_.range.min = bound, *this; }
    Key& below(double bound) { return spec_.range.max = bound, spec_.range.maxIsOut = true, *this; }
    Key& atMost(double bound) { return spec_.range.max = bound, *this; }
    Key& oneOf(std::vector<std::string> choices) { return spec_.choices = std::move(choices), *this; }
    Key& allowed(std::string_view words) { return spec_.allowedWords = words, *this; }
    Key& required() { return spec_.required = true, *this; }
    Key& byDefault(std::string_view toml)
    {
        spec_.defaultValue = parseToml("value = " + std::string(toml), "default").find("value")[0];
        spec_.defaultWords = toml;
        return *this;
    }
    Key& withoutIt(std::string_view words) { return spec_.defaultWords = words, *this; }
    KeySpec says(std::string_view summary)
    {
        spec_.summary = summary;
        return std::move(spec_);
    }

  private:
    KeySpec spec_;
};

// The choices that several tables share.
std::vector<std::string> outputNames();
const std::vector<std::string>& backendNames();

// The tables of schema_table_trace.cpp: [material], [projection], [[expect]], [expand], [[known_failure]].
std::vector<KeySpec> materialKeys();
std::vector<KeySpec> projectionKeys();
// Those of schema_table_probe.cpp: [[probe]] with [environment], [sky].
std::vector<KeySpec> probeKeys();
std::vector<KeySpec> skyKeys();
std::vector<KeySpec> historyKeys();
std::vector<KeySpec> expectKeys();
std::vector<KeySpec> otherKeys();

} // namespace crossray
