// A case file: read, expanded and built; each of its cases told as a file of its own says the same.
#include "tests/fuzz/targets/target.h"

#include "harness/base/temporary_folder.h"
#include "harness/case/case_tree.h"
#include "harness/scene/file_io.h"

#include <map>

using namespace crossray;

namespace {

constexpr size_t kTold = 4; // of a file's cases: [expand] makes thousands of nearly the same

// Beside the presets that our own cases use.
const std::filesystem::path& scratchFile()
{
    static const TemporaryFolder folder("fuzz-case");
    static const std::filesystem::path file = [] {
        std::filesystem::copy(std::filesystem::path(CROSSRAY_SOURCE_DIR) / "cases/presets.toml", folder.path());
        return folder.path() / "case.toml";
    }();
    return file;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    const std::filesystem::path& file = scratchFile();
    const std::string text(fuzz::textOf(data, size));
    writeWholeFile(file, text);
    const auto cases = fuzz::readOrRefuse([&] { return readCaseFile(file); }, file.string());
    if (!cases) return 0;
    fuzz::expect(!cases->empty(), "a file that is read holds a case");
    for (size_t i = 0; i < std::min(cases->size(), kTold); ++i) {
        const CaseTree tree = readCaseTree(file, (*cases)[i].name, {});
        fuzz::expect(tree.testCase.name == (*cases)[i].name, "a case is found by its name");
        fuzz::expect(!listFiles(tree.testCase).empty(), "a case has the file that it is in");
        const std::string told = formatToml(tree.own);
        fuzz::expect(saysTheSame(parseToml(told, "told"), tree.own), "a tree that is told and read says the same");
    }
    return 0;
}
