// The body of a request to the inspector: what it changes of a case is set, built, and shown as controls.
#include "tests/fuzz/targets/target.h"

#include "harness/inspector/controls.h"
#include "harness/inspector/question.h"

#include <array>

using namespace crossray;

namespace {

// A case with most of the tables that a request can name keys of.
const std::filesystem::path& caseFile()
{
    static const std::filesystem::path file =
        std::filesystem::path(CROSSRAY_SOURCE_DIR) / "tests/fuzz/targets/question_case.toml";
    return file;
}

void answer(const std::string& body, std::span<const std::string_view> fields)
{
    try {
        const Question question = parseQuestion(body, fields);
        const CaseTree tree = readCaseTree(caseFile(), "fuzz/question_case", question.parameters);
        fuzz::expect(!formatControlsJson(listControls(tree)).empty(), "a case has controls");
        fuzz::expect(saysTheSame(parseToml(formatToml(tree.own), "told"), tree.own),
                     "what would be saved says the same");
    } catch (const BadQuestion&) { // status 400
    } catch (const InputError&) {  // status 422
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    static constexpr std::array<std::string_view, 5> kTrace{"case", "parameters", "backends", "pixel", "generation"};
    static constexpr std::array<std::string_view, 3> kSave{"case", "parameters", "name"};
    const std::string body(fuzz::textOf(data, size));
    answer(body, kTrace);
    answer(body, kSave);
    return 0;
}
