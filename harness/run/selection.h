// Which cases a command line asks for.
#pragma once

#include "harness/case/case.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

// `*` any run of characters (slashes included), `?` any one; everything else, brackets too, stands for itself, since
// the names of sub-cases have brackets.
bool matchesGlob(std::string_view pattern, std::string_view text);
bool isGlob(std::string_view text);

// "hiz and not (slow or real)": a word holds when it is part of the case's name or is one of its tags.
class KeyExpression {
  public:
    // Throws InputError that shows where the expression breaks off.
    static KeyExpression parse(std::string_view text);
    bool matches(const Case& testCase) const;

    struct Node;

  private:
    std::shared_ptr<const Node>
        root_; // shared: expressions are copied with the options that hold them, and never change
};

// Part `index` of `count`, from 1. Which part a case falls into depends on its name alone, so that parts computed on
// different machines fit together.
struct Shard {
    int index = 1;
    int count = 1;
    static Shard parse(std::string_view text); // "2/3"; throws InputError
    bool contains(std::string_view caseName) const;
};

// FNV-1a, 64 bit, with a final mix: the same on every machine and in every version.
uint64_t computeStableHash(std::string_view text);

} // namespace crossray
