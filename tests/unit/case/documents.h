// Files of the repository, for the tests that hold documents against them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

inline const std::filesystem::path kSource = CROSSRAY_SOURCE_DIR;

inline std::string readAll(const std::string& name)
{
    std::ifstream stream(kSource / name);
    EXPECT_TRUE(stream) << name;
    return {std::istreambuf_iterator<char>(stream), {}};
}
