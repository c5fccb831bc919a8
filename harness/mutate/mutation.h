// Small bugs for a GLSL text: each one edit of the kind that people make.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

struct Mutation {
    std::string file;      // "crossray/core/math.glsl"
    std::string function;  // whose body is changed; empty outside all
    std::string operation; // "operator", "comparison", ...: a name of mutationOperations()
    size_t offset = 0, length = 0;
    std::string replacement;
    int line = 0, column = 0;
    std::string before, after; // the lines that it touches, each run of blanks as one

    std::string id() const; // "crossray/core/math.glsl:52:19 isFinite comparison: < -> <="
    std::string was;        // the text that goes, for the id
};

struct MutationOperation {
    std::string_view name, summary;
};
const std::vector<MutationOperation>& mutationOperations();

// All that the operations find in the text, in its order; edits that come to the same text are there once. What stands
// outside functions is changed where it is a constant's value.
std::vector<Mutation> findMutations(const std::string& file, std::string_view text);

// Throws InputError when the edit lies outside the text.
std::string applyMutation(std::string_view text, const Mutation& mutation);

// As of `diff -U0`, with the file's name and line.
std::string formatMutationDiff(const Mutation& mutation);

// Functions of these texts that use a name, directly or by constants that are made of it; `name` itself where it is a
// function of them.
std::vector<std::string> findUsers(const std::vector<std::string>& texts, const std::string& name);
// The constant whose value holds the mutation; empty inside functions.
std::string constantAt(std::string_view text, const Mutation& mutation);

} // namespace crossray
