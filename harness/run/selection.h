// Which cases a command line asks for.
#pragma once

#include "harness/case/case.h"

#include <memory>
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

} // namespace crossray
