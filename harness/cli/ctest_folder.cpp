#include "harness/cli/ctest_folder.h"

#include "harness/run/environment.h"
#include "harness/run/plane_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

namespace crossray {

namespace fs = std::filesystem;

namespace {

// A case as an argument that means it alone, wherever it is given from.
std::string formatArgument(const Case& testCase)
{
    const size_t bracket = testCase.name.find('[');
    return fs::absolute(testCase.file).lexically_normal().string() +
           (bracket == std::string::npos ? "" : testCase.name.substr(bracket));
}

// A bracket argument of CMake's, which takes all that is in it as it stands.
std::string quote(const std::string& text)
{
    return fmt::format("[======[{}]======]", text);
}

// The results go below the folder, from wherever CTest starts: another project may include it in its own tests.
std::string formatTest(const Case& testCase, const std::vector<std::string>& common, const fs::path& folder)
{
    std::string text = fmt::format("add_test({}", quote(testCase.name));
    for (const std::string& word : common)
        text += fmt::format(" {}", quote(word));
    return text + fmt::format(" {} {})\nset_tests_properties({} PROPERTIES LABELS {} TIMEOUT 600)\n",
                              quote("--output=" + (folder / "out" / testCase.name).string()),
                              quote(formatArgument(testCase)), quote(testCase.name),
                              quote(fmt::format("{}", fmt::join(testCase.tags, ";"))));
}

} // namespace

int writeCtestFolder(const GlobalOptions& global, const SelectionOptions& selection, const std::string& folder)
{
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const SelectedCases selected = selectCases(selection, folders.cases, "out/last", false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    const std::vector<std::string> common{fs::read_symlink("/proc/self/exe").string(),
                                          "run",
                                          "--shaders=" + fs::absolute(folders.shaders).string(),
                                          "--cache-dir=" + fs::absolute(folders.cache).string(),
                                          "--jobs=1",
                                          "--no-report",
                                          "--progress=none"};
    std::string text = "# Made by crossray list --ctest. Each case is a test, its tags are labels.\n";
    for (const Case& testCase : selected.cases)
        text += formatTest(testCase, common, fs::absolute(folder).lexically_normal());
    std::error_code failure;
    fs::create_directories(folder, failure);
    writeFileWhole(fs::path(folder) / "CTestTestfile.cmake", text);
    fmt::print("{} tests; ctest --test-dir {}\n", selected.cases.size(), folder);
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
