// What tests of files and commands share: a folder that goes with them, names that no process
// beside them has, and what a file holds.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace rink::test {

/// All that `file` holds; empty if there is none.
inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A name that no other test, in this process or beside it, uses.
inline std::string unique_name(const std::string& what) {
  static std::atomic<int> count = 0;
  return what + "-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

/// An empty folder that nobody else has, removed with all that is in it at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name) {
    std::string pattern = testing::TempDir() + "rink-" + name + "-XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::filesystem::filesystem_error("no folder for the test", pattern,
                                              std::error_code(errno, std::generic_category()));
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;  // what a test left unreadable must not end the others
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  operator const std::filesystem::path&() const {
    return path_;
  }  // NOLINT: it is used as a path everywhere
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace rink::test
