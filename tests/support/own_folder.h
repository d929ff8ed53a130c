#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>

namespace vellus::test {

/// An empty folder that no other test process uses, gone at the end.
class OwnFolder {
  public:
    explicit OwnFolder(std::string_view name)
        : path_(std::filesystem::temp_directory_path() /
                fmt::format("vellus_{}_{}", name, ::getpid())) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~OwnFolder() {
        std::error_code code;
        std::filesystem::remove_all(path_, code);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace vellus::test
