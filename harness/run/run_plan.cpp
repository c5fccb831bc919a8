#include "harness/run/run_plan.h"

#include "harness/base/text.h"
#include "harness/compile/compile.h"
#include "harness/run/environment.h"
#include "harness/run/source_hash.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace crossray {

namespace fs = std::filesystem;

RunPlan describeSelection(const std::map<std::string, Hash128>& filesOfNames)
{
    RunPlan plan;
    plan.cases = plan.ownCases = filesOfNames.size();
    Hasher names, contents;
    for (const auto& [name, files] : filesOfNames) {
        names.addString(name);
        contents.addString(name).addHash(files);
    }
    plan.names = names.finish().hex();
    plan.contents = contents.finish().hex();
    return plan;
}

std::string describePartition(std::span<const std::string> names, std::span<const int> parts, int count, bool isByTime)
{
    if (!isByTime) return fmt::format("{} parts by name", count);
    std::map<std::string_view, int> partOf;
    for (size_t i = 0; i < names.size(); ++i)
        partOf[names[i]] = parts[i];
    Hasher hasher;
    for (const auto& [name, part] : partOf)
        hasher.addString(name).addNumber(static_cast<uint64_t>(part));
    return fmt::format("{} parts by time {}", count, hasher.finish().hex());
}

std::string hashFolder(const fs::path& folder)
{
    std::map<std::string, fs::path> files;
    std::error_code failure;
    for (fs::recursive_directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (entry->is_regular_file(failure))
            files[entry->path().lexically_relative(folder).generic_string()] = entry->path();
    }
    Hasher hasher;
    for (const auto& [name, path] : files)
        hasher.addString(name).addString(readText(path).value_or(""));
    return hasher.finish().hex();
}

std::string describeHarness()
{
    std::string text = fmt::format("crossray {} {}", toolVersion(), sourceHash());
    for (const auto& [name, version] : ShaderCompiler::versions())
        text += fmt::format(", {} {}", name, version);
    return text;
}

std::string describeOptions(const ExecuteOptions& options, bool validation)
{
    return fmt::format("backends {}; repeat {}; time-out {}; validation {}{}", fmt::join(options.backends, ","),
                       options.repeat,
                       options.timeoutSeconds ? fmt::format("{} s", *options.timeoutSeconds) : "of each case",
                       validation ? "on" : "off", options.passedBefore ? "; changed cases alone" : "");
}

std::string hashPlan(const RunPlan& plan)
{
    return Hasher()
        .addNumber(plan.cases)
        .addString(plan.names)
        .addString(plan.contents)
        .addString(plan.shaders)
        .addString(plan.harness)
        .addString(plan.options)
        .finish()
        .hex();
}

} // namespace crossray
