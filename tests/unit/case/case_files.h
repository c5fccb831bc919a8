// Case files on the fly: a folder of its own a test, and a short way to state what a file is refused with.
#pragma once

#include "harness/base/temporary_folder.h"
#include "harness/case/case.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

// The head of a line whose rest is a list of all that is allowed.
#define EXPECT_OPENS(text, head) EXPECT_EQ((text).substr(0, std::string_view(head).size()), head)

namespace crossray {

class CaseFiles : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const
    {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    std::vector<Case> read(const std::string& text) const { return readCaseFile(write("a.toml", text)); }
    Case readOne(const std::string& text) const
    {
        const std::vector<Case> cases = read(text);
        EXPECT_EQ(cases.size(), 1u);
        return cases.at(0);
    }

    // The message without the folder: "a.toml:4:1: ...".
    template <typename Action>
    std::string messageOf(Action action) const
    {
        try {
            action();
        } catch (const InputError& error) {
            EXPECT_EQ(error.exitCode(), ExitCode::kUsage);
            std::string text = error.what();
            for (size_t at; (at = text.find(folder_.string() + "/")) != std::string::npos;) {
                text.erase(at, folder_.string().size() + 1);
            }
            for (size_t at; (at = text.find(folder_.string())) != std::string::npos;) {
                text.replace(at, folder_.string().size(), "FOLDER");
            }
            return text;
        }
        return "nothing was thrown";
    }
    std::string refusal(const std::string& text) const
    {
        return messageOf([&] { read(text); });
    }
    // Lines 1 to 8 are a case that is complete but for its tables; `rest` opens on line 9.
    static std::string complete(const std::string& rest, const std::string& top = "")
    {
        return "schema = 1\nname = \"a/b\"\nsummary = \"It holds.\"\n" + top + (top.empty() ? "" : "\n") +
               "[[expect]]\noutput = \"RayDirWS\"\nanalytic = \"x\"\ntolerance = { degrees = 1e-3 }\n" +
               (top.empty() ? "\n" : "") + rest;
    }
    // The same with a [scene].
    static std::string withScene(const std::string& rest) { return complete("[scene]\n" + rest); }

    TemporaryFolder temporary_{"case"};
    const std::filesystem::path folder_ = temporary_.path();
};

} // namespace crossray
