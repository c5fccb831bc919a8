// run.json: read whole and case by case. What is read can be told, and telling it again changes nothing.
#include "tests/fuzz/targets/target.h"

#include "harness/run/merge_inputs.h"
#include "harness/run/run_json.h"

#include <array>

using namespace crossray;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::string_view text = fuzz::textOf(data, size);
    const auto run = fuzz::readOrRefuse([&] { return parseRunJson(text, "run.json"); }, "run.json");
    if (run) {
        const std::string told = formatRunJson(*run);
        const RunResult again = parseRunJson(told, "told");
        fuzz::expect(formatRunJson(again) == told, "a run that is told, read and told again is the same");
        fuzz::expect(!formatSummaryJson(*run).empty(), "a run has a summary");
    }

    const fuzz::MemoryFile memory(text);
    const std::string name = memory.path().string();
    const auto file = fuzz::readOrRefuse([&] { return std::make_unique<RunFile>(memory.path()); }, name);
    fuzz::expect(!run || !file || (*file)->cases().size() == run->cases.size(), "a case at a time gives as many");
    for (const std::string_view each : file ? (*file)->cases() : std::span<const std::string_view>{})
        fuzz::readOrRefuse([&] { return (*file)->parse(each); }, name);

    // As the only shard of a merge. What it says may be about several files, and so begin with none.
    const std::array<std::filesystem::path, 1> inputs{memory.path()};
    fuzz::readOrRefuse([&] { return readMergeInputs(inputs, true); }, "");
    return 0;
}
