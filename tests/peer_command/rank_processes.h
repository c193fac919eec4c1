// Processes that mpirun starts on this machine, with more ranks than processors.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "game/process/process.h"
#include "rti/transport/mpi/ranks.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
using namespace std::chrono_literals;
using Words = std::vector<std::string>;

/// The processes of `program` that `parent` started, the launcher's ranks.
inline std::vector<pid_t> children_of(pid_t parent, const std::string& program) {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string number, name, state;
    pid_t its_parent = 0;
    if (stat >> number >> name >> state >> its_parent && its_parent == parent &&
        name == "(" + program + ")")
      children.push_back(std::stoi(number));
  }
  return children;
}

/// The processor time that the process has taken, in ticks of 10 ms.
inline long ticks_of(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string field;
  for (int k = 1; k <= 13; ++k) stat >> field;
  long user = 0, system = 0;
  stat >> user >> system;
  return user + system;
}

class RankProcesses : public testing::Test {
 protected:
  void SetUp() override {
    if (!rti::Ranks::is_built_in()) GTEST_SKIP() << "this build has no MPI";
    // What the launcher and MPI's own threads leave behind at the end is not ours.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  }
  void TearDown() override { unsetenv("ASAN_OPTIONS"); }

  static Words with_program(Words arguments, const std::string& program, const Words& further) {
    arguments.insert(arguments.begin(), further.begin(), further.end());
    arguments.insert(arguments.begin(),
                     {test::binary_folder() + "/bin/" + program, "--transport", "mpi"});
    return arguments;
  }
  /// `groups` of ranks that differ in what they are given.
  Process& run(const std::vector<std::pair<int, Words>>& groups) {
    Words arguments{"mpirun", "--allow-run-as-root", "--oversubscribe"};
    for (const auto& [count, words] : groups) {
      if (&words != &groups.front().second) arguments.push_back(":");
      arguments.insert(arguments.end(), {"-np", std::to_string(count)});
      arguments.insert(arguments.end(), words.begin(), words.end());
    }
    output_ = (folder_ / "output").string();
    std::filesystem::remove(output_);  // of an earlier run
    // The shell keeps what is written, however long it is, and becomes the launcher.
    arguments.insert(arguments.begin(), {"-c", "exec \"$@\" > '" + output_ + "'", "sh"});
    return *(launcher_ = std::make_unique<Process>("/bin/sh", arguments));
  }
  bool ends(std::chrono::seconds limit = 40s) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!launcher_->ending() && std::chrono::steady_clock::now() < end) launcher_->attend(10ms);
    return launcher_->ending().has_value();
  }
  /// One of four ranks in the middle of a long game.
  pid_t one_of_four_that_play(const std::string& program) {
    std::vector<pid_t> ranks;
    const auto end = std::chrono::steady_clock::now() + 60s;
    // Where a host's own name is unknown MPI takes seconds to begin, and under a sanitizer half a
    // second of a processor; whoever has taken a second and a half of it plays.
    const auto do_play = [&] {
      return ranks.size() == 4 &&
             std::ranges::all_of(ranks, [](pid_t rank) { return ticks_of(rank) >= 150; });
    };
    while (!do_play() && std::chrono::steady_clock::now() < end)
      launcher_->attend(10ms), ranks = children_of(launcher_->id(), program);
    return do_play() ? ranks[2] : 0;
  }

  test::TemporaryFolder folder_{"ranks"};
  std::string output_;
  std::unique_ptr<Process> launcher_;
};

}  // namespace rink::game
