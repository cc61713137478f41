// A folder for the files a case writes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace ag::test {

// The process's folder, gone at its end: ctest runs cases as processes of their own, several at once, and two
// builds may be tested side by side.
class ProcessFolder {
  public:
    ProcessFolder() = default;
    ProcessFolder(const ProcessFolder&) = delete;
    ProcessFolder& operator=(const ProcessFolder&) = delete;
    ~ProcessFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("afterglow_test_" + std::to_string(getpid()));
};

// The folder of the running case: no other case and no other process writes there. Empty at first.
inline std::filesystem::path ownFolder() {
    static const ProcessFolder process;
    const testing::TestInfo& running = *testing::UnitTest::GetInstance()->current_test_info();
    const auto path = process.path / running.test_suite_name() / running.name();
    std::filesystem::create_directories(path);
    return path;
}

// Where the running case puts a file of this name.
inline std::string ownFile(const std::string& name) {
    return (ownFolder() / name).string();
}

}  // namespace ag::test
