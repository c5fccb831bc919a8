// Runs the built crossray as a person would: in a folder of its own, with caches of its own.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>

struct Outcome {
    int exitCode = -1; // -1: ended by a signal
    std::string out, err;
    std::string lastLine() const; // of standard output
};

class CliTest : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;

    // `arguments` are words for a shell, in which the test's folder is the current one; `variables` stand before them.
    // Those by which engines name parts of a run are not set otherwise.
    Outcome run(const std::string& arguments, const std::string& variables = "") const;
    // Starts it, waits until `file` has appeared, calls `action` with its process id and waits for the end.
    template <typename Action>
    Outcome runWhile(const std::string& arguments, const Action& action) const
    {
        const int process = start(arguments);
        action(process);
        return finish(process);
    }

    void writeFile(const std::string& name, std::string_view content) const;
    std::string readFile(const std::string& name) const;
    // A case that cpu64 answers in a millisecond: the mirrored rays of a plane. `expect` is its [[expect]] table's
    // body.
    void writeCase(const std::string& file, const std::string& name, const std::string& more = "",
                   const std::string& expect = kHolds) const;
    nlohmann::json readRun(const std::string& folder = "out/last") const;

    static constexpr const char* kHolds = "output = \"HitSuccess\"\nconstant = \"no_raycast\"\nwhere = \"all\"\n";
    static constexpr const char* kFails = "output = \"HitSuccess\"\nconstant = \"hit\"\nwhere = \"all\"\n";

    std::filesystem::path folder_;

  private:
    int start(const std::string& arguments, const std::string& variables = "") const;
    Outcome finish(int process) const;
};

// Process ids of the workers that a crossray process has started for a backend, by /proc.
std::vector<int> findWorkers(int process, const std::string& backend);
