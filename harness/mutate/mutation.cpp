#include "harness/mutate/mutation.h"

#include "harness/base/error.h"
#include "harness/mutate/glsl_tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace crossray {

const std::vector<MutationOperation>& mutationOperations()
{
    static const std::vector<MutationOperation> operations{
        {"operator",
         "+ and -, * and /, && and ||, shifts, & and |, any and all, floor and ceil, sin and cos exchanged"},
        {"comparison", "turned, or made strict, or no longer strict"},
        {"constant", "whole numbers plus 1; 0.0 to 1.0; others by a quarter, very small and very large ones by 1000"},
        {"sign", "a minus or a `not` dropped"},
        {"guard", "clamp, saturate, max, min, normalize, abs, a check, an if or one side of a choice removed"},
        {"swizzle", "components exchanged"},
        {"term", "an operand of +, -, && or || dropped"},
        {"space", "a name exchanged for one of the same type in another space"},
        {"order", "arguments exchanged"},
    };
    return operations;
}

std::string Mutation::id() const
{
    return fmt::format("{}:{}:{} {}{}{}: {} -> {}", file, line, column, function, function.empty() ? "" : " ",
                       operation, was, replacement);
}

std::string applyMutation(std::string_view text, const Mutation& mutation)
{
    if (mutation.offset > text.size() || mutation.length > text.size() - mutation.offset) {
        throw InputError(fmt::format("{}: the edit lies outside the text", mutation.file));
    }
    std::string result(text.substr(0, mutation.offset));
    result += mutation.replacement;
    result += text.substr(mutation.offset + mutation.length);
    return result;
}

std::string formatMutationDiff(const Mutation& mutation)
{
    return fmt::format("{}:{}:{} {}\n-{}\n+{}\n", mutation.file, mutation.line, mutation.column,
                       mutation.function.empty() ? "" : "in " + mutation.function, mutation.before, mutation.after);
}

namespace {

// Names of the global constants of a text with the tokens of their values.
struct GlobalConstant {
    std::string_view name;
    size_t begin = 0, end = 0;
};

std::vector<GlobalConstant> findConstants(const GlslSource& source)
{
    std::vector<GlobalConstant> constants;
    const auto& tokens = source.tokens();
    for (size_t i = 0; i + 3 < tokens.size(); ++i) {
        if (!tokens[i].is("const") || source.functionAt(i) != nullptr || !tokens[i + 3].is("=")) continue;
        size_t end = i + 4;
        while (end < tokens.size() && !tokens[end].is(";"))
            ++end;
        constants.push_back({tokens[i + 2].text, i + 4, end});
        i = end;
    }
    return constants;
}

} // namespace

std::string constantAt(std::string_view text, const Mutation& mutation)
{
    const GlslSource source(text);
    for (const GlobalConstant& constant : findConstants(source)) {
        const bool startsBefore = source.tokens()[constant.begin].offset <= mutation.offset;
        if (startsBefore && mutation.offset < source.tokens()[constant.end - 1].end())
            return std::string(constant.name);
    }
    return {};
}

std::vector<std::string> findUsers(const std::vector<std::string>& texts, const std::string& name)
{
    std::vector<GlslSource> sources(texts.begin(), texts.end());
    std::set<std::string> functions, names{name};
    for (size_t known = 0; known != names.size();) {
        known = names.size();
        for (const GlslSource& source : sources) {
            const auto& tokens = source.tokens();
            for (const GlobalConstant& constant : findConstants(source)) {
                for (size_t i = constant.begin; i < constant.end; ++i) {
                    if (names.contains(std::string(tokens[i].text))) names.insert(std::string(constant.name));
                }
            }
        }
    }
    for (const GlslSource& source : sources) {
        for (const GlslFunction& function : source.functions()) {
            if (function.name == name) functions.insert(name);
            for (size_t i = function.open; i < function.close; ++i) {
                if (names.contains(std::string(source.tokens()[i].text))) functions.insert(std::string(function.name));
            }
        }
    }
    return {functions.begin(), functions.end()};
}

} // namespace crossray
