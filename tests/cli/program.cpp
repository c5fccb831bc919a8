#include "tests/cli/program.h"

#include <fmt/format.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace {

std::string readAll(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
}

} // namespace

std::string Outcome::lastLine() const
{
    std::string_view text = out;
    while (text.ends_with('\n'))
        text.remove_suffix(1);
    const size_t lineBreak = text.rfind('\n');
    return std::string(lineBreak == std::string_view::npos ? text : text.substr(lineBreak + 1));
}

void CliTest::SetUp()
{
    const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / fmt::format("crossray-cli-{}-{}", test->name(), getpid());
    fs::create_directories(folder_ / "cases");
    // Compiled shaders are shared by all tests; verdicts are not, since one test's cases are like another's.
    fs::create_directories(folder_ / "cache");
    for (const char* part : {"spirv", "mesa"}) {
        const fs::path shared = fs::absolute("cli-test-cache") / part;
        fs::create_directories(shared);
        fs::create_directory_symlink(shared, folder_ / "cache" / part);
    }
}

void CliTest::TearDown()
{
    fs::remove_all(folder_);
}

int CliTest::start(const std::string& arguments, const std::string& variables) const
{
    const std::string command = fmt::format(
        "cd '{}' && unset CI_NODE_INDEX CI_NODE_TOTAL TEST_TOTAL_SHARDS GTEST_TOTAL_SHARDS SLURM_ARRAY_TASK_ID "
        "JOB_COMPLETION_INDEX; export CROSSRAY_CASES=cases CROSSRAY_CACHE='{}' GITHUB_ACTIONS= {}; "
        "exec '{}' {} >'{}/.stdout' 2>'{}/.stderr'",
        folder_.string(), (folder_ / "cache").string(), variables, fs::absolute("crossray").string(),
        arguments, folder_.string(), folder_.string());
    const pid_t process = fork();
    if (process == 0) {
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    return process;
}

Outcome CliTest::finish(int process) const
{
    int status = 0;
    waitpid(process, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(".stdout"), readFile(".stderr")};
}

Outcome CliTest::run(const std::string& arguments, const std::string& variables) const
{
    return finish(start(arguments, variables));
}

void CliTest::writeFile(const std::string& name, std::string_view content) const
{
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
}

std::string CliTest::readFile(const std::string& name) const
{
    return readAll(folder_ / name);
}

void CliTest::writeCase(const std::string& file, const std::string& name, const std::string& more,
                        const std::string& expect) const
{
    writeFile(file, fmt::format("schema = 1\nname = \"{}\"\nsummary = \"A plane of the test.\"\n{}\n"
                                "[scene]\nsize = [8, 8]\n"
                                "primitives = [{{ shape = \"plane\", center = [0, 0, -4], normal = [0, 0, 1] }}]\n\n"
                                "[[expect]]\n{}",
                                name, more, expect));
}

nlohmann::json CliTest::readRun(const std::string& folder) const
{
    return nlohmann::json::parse(readFile(folder + "/run.json"));
}

std::vector<int> findWorkers(int process, const std::string& backend)
{
    std::vector<int> workers;
    const fs::path children = fmt::format("/proc/{}/task", process);
    std::error_code failure;
    for (const auto& task : fs::directory_iterator(children, failure)) {
        std::istringstream ids(readAll(task.path() / "children"));
        for (int id = 0; ids >> id;) {
            const std::string words = readAll(fmt::format("/proc/{}/cmdline", id));
            if (words.find("worker") != std::string::npos && words.find(backend) != std::string::npos)
                workers.push_back(id);
        }
    }
    return workers;
}
