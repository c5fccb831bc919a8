#include "harness/base/temporary_folder.h"

#include "harness/base/error.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace crossray {

TemporaryFolder::TemporaryFolder(std::string_view purpose)
{
    const std::filesystem::path parent = std::filesystem::temp_directory_path();
    std::string name = (parent / fmt::format("crossray-{}-XXXXXX", purpose)).string();
    if (!::mkdtemp(name.data())) {
        throw EnvironmentError(fmt::format("{}: no temporary folder can be made here", parent.string()));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace crossray
