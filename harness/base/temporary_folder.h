// A folder of its own below the system's folder for temporary files; it is gone, with all in it, when this is.
#pragma once

#include <filesystem>
#include <string_view>

namespace crossray {

class TemporaryFolder {
  public:
    // `purpose` becomes part of the folder's name. Throws EnvironmentError when none can be made.
    explicit TemporaryFolder(std::string_view purpose);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace crossray
