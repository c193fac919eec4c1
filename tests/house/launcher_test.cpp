// The launcher ./rink: what it installs, builds and runs for each command, and the status that it
// ends with. All that it calls are stubs that note how they were called.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::house {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Makes `rink-COMMAND` programs that say their arguments and end with $STATUS.
constexpr const char* ninja =
    R"([ -z "${FAILS_TO_BUILD:-}" ] || { echo "harbour.cpp:3: error: no ship"; exit 1; }
mkdir -p "$2/bin"
for target in "$@"; do
  printf '#!/bin/sh\necho "$(basename "$0") got: $*"\nexit "${STATUS:-0}"\n' >"$2/bin/$target" 2>/dev/null && chmod +x "$2/bin/$target" || :
done)";
constexpr const char* cmake =
    R"([ -z "${FAILS_TO_CONFIGURE:-}" ] || { echo "CMake Error: no compass"; exit 1; }
case $2 in release) touch build/build.ninja ;; *) touch "build-$2/build.ninja" ;; esac)";
constexpr const char* python = R"(exit "${STATUS:-0}")";
constexpr const char* cpack =
    R"([ -z "${FAILS_TO_PACK:-}" ] || { echo "CPack Error: no crate"; exit 1; }
touch rink_7.8.9_amd64.deb)";
constexpr const char* dpkg_query = R"(shift 2
for package in "$@"; do case " ${MISSING:-} " in *" $package "*) ;; *) echo "$package installed" ;; esac; done)";
constexpr const char* apt_get =
    R"([ -z "${FAILS_TO_INSTALL:-}" ] || { echo "E: no network"; exit 100; })";

class Launcher : public testing::Test {
 protected:
  Launcher() {
    std::filesystem::copy_file(test::source_folder() + "/rink", folder_ / "rink");
    std::ofstream(folder_ / "CMakeLists.txt") << "project(rink VERSION 7.8.9 LANGUAGES CXX)\n";
    for (const char* name : {"stubs", "tools"}) std::filesystem::create_directory(folder_ / name);
    for (const char* tool :
         {"sh", "dirname", "basename", "readlink", "sed", "sort", "grep", "awk", "mkdir", "flock",
          "cat", "mktemp", "rm", "nproc", "touch", "chmod", "env", "ls"}) {
      for (const std::string place : {"/usr/bin/", "/bin/"})
        if (std::error_code taken; std::filesystem::exists(place + tool))
          std::filesystem::create_symlink(place + tool, folder_ / "tools" / tool, taken);
    }
    for (const auto& [name, does] :
         std::map<std::string, const char*>{{"ninja", ninja},
                                            {"cmake", cmake},
                                            {"python3", python},
                                            {"dpkg-query", dpkg_query},
                                            {"apt-get", apt_get},
                                            {"sudo", "exit 1"},
                                            {"cpack", cpack},
                                            {"id", "echo \"${USER_NUMBER:-0}\""}})
      stub(name, does);
  }

  void stub(const std::string& name, const std::string& does) {
    const std::filesystem::path file = folder_ / "stubs" / name;
    const std::string notes =
        name == "id" || name == "dpkg-query"
            ? ""
            : "echo \"$(basename \"$0\") $*\" >>" + (folder_ / "calls").string() + "\n";
    std::ofstream(file) << "#!/bin/sh\n" << notes << does << '\n';
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }

  /// The exit status of `./rink ARGUMENTS` under `surroundings`, which are NAME=VALUE words; what
  /// was called meanwhile is in `calls_`, with our folder as ".".
  int run(const std::string& arguments, const std::string& surroundings = {}) {
    std::filesystem::remove(folder_ / "calls");
    const std::string own = folder_.path().string();
    const std::string command = "cd / && env -i PATH=" + own + "/stubs:" + own +
                                "/tools TMPDIR=" + own + " " + surroundings + " " + own + "/rink " +
                                arguments + " >" + own + "/printed 2>" + own + "/said </dev/null";
    const int status = std::system(command.c_str());
    printed_ = test::text_of(folder_ / "printed");
    said_ = test::text_of(folder_ / "said");
    calls_.clear();
    std::ifstream stream(folder_ / "calls");
    for (std::string line; std::getline(stream, line);) {
      for (auto at = line.find(own); at != std::string::npos; at = line.find(own))
        line.replace(at, own.size(), ".");
      calls_.push_back(line);
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  test::TemporaryFolder folder_{"launcher"};
  std::vector<std::string> calls_;
  std::string printed_, said_;
};

TEST_F(Launcher, SaysWhatItKnowsAndDoesNothingElse) {
  for (const char* words : {"", "help", "--help", "-h"}) {
    EXPECT_EQ(run(words), 0) << words;
    for (const char* command :
         {"play", "compare", "test", "serve", "rti", "peer", "duel", "bots", "dds", "simulate",
          "replay", "accuracy", "bench", "results", "package", "setup"})
      EXPECT_THAT(printed_, HasSubstr("\n  " + std::string(command) + " ")) << words;
    EXPECT_THAT(calls_, IsEmpty()) << words;
  }
}

TEST_F(Launcher, RefusesACommandThatThereIsNot) {
  EXPECT_EQ(run("ply"), 2);
  EXPECT_THAT(said_,
              AllOf(HasSubstr("there is no command 'ply'"), HasSubstr("COMMAND [ARGUMENTS]")));
  EXPECT_EQ(printed_, "");
  EXPECT_THAT(calls_, IsEmpty());
}

TEST_F(Launcher, BuildsWhatACommandNeedsAndHandsItTheArguments) {
  const std::map<std::string, std::string> targets{
      {"compare", "rink-compare rink-serve rink-bots rink-dds"},
      {"play", "rink-play rink-serve"},
      {"serve", "rink-serve"},
      {"rti", "rink-rti"},
      {"bots", "rink-bots"},
      {"dds", "rink-dds"},
      {"duel", "rink-duel"},
      {"peer", "rink-peer"},
      {"simulate", "rink-simulate"},
      {"replay", "rink-replay"}};
  for (const auto& [command, all] : targets) {
    EXPECT_EQ(run(command + " --help one 'two  words'"), 0) << said_;
    EXPECT_EQ(printed_, "rink-" + command + " got: --help one two  words\n");
    EXPECT_EQ(calls_.back(), "ninja -C ./build " + all);
  }
}

TEST_F(Launcher, MeasuresWithoutAsserts) {
  for (const std::string command : {"bench", "accuracy"}) {
    EXPECT_EQ(run(command + " --filter im"), 0) << said_;
    EXPECT_EQ(printed_, "rink-" + command + " got: --filter im\n");
    EXPECT_EQ(calls_.back(), "ninja -C ./build-bench rink-" + command);
  }
}

TEST_F(Launcher, EndsWithTheStatusOfItsCommand) {
  for (const char* command : {"compare", "play", "serve", "rti", "peer", "duel", "bots", "dds",
                              "simulate", "replay", "accuracy", "bench", "test", "results"})
    EXPECT_EQ(run(command, "STATUS=17"), 17) << command;
}

TEST_F(Launcher, ConfiguresOnceUnlessItIsAskedTo) {
  run("serve");
  EXPECT_THAT(calls_, ElementsAre("cmake --preset release", "ninja -C ./build rink-serve"));
  run("serve");
  EXPECT_THAT(calls_, ElementsAre("ninja -C ./build rink-serve"));
  run("serve", "RINK_CONFIGURE='-DRINK_UNITY=OFF -DA=B'");
  EXPECT_THAT(calls_, ElementsAre("cmake --preset release -DRINK_UNITY=OFF -DA=B",
                                  "ninja -C ./build rink-serve"));
}

TEST_F(Launcher, SaysWhatKeptItFromBuildingAndRunsNothing) {
  EXPECT_EQ(run("serve", "FAILS_TO_CONFIGURE=1"), 4);
  EXPECT_THAT(said_,
              AllOf(HasSubstr("CMake Error: no compass"), HasSubstr("rink: configuring failed")));
  EXPECT_EQ(run("serve", "FAILS_TO_BUILD=1"), 4);
  EXPECT_THAT(said_, AllOf(HasSubstr("harbour.cpp:3: error: no ship"),
                           HasSubstr("rink: the build failed")));
  EXPECT_EQ(printed_, "");
}

TEST_F(Launcher, RunsTheQuickTestsUnlessOthersAreAskedFor) {
  const std::string runs = "python3 ./tests/run_ctest.py ./build";
  EXPECT_EQ(run("test"), 0) << said_;
  EXPECT_THAT(calls_,
              ElementsAre("cmake --preset release", "ninja -C ./build all", runs + " -LE long"));
  run("test -R physics");
  EXPECT_EQ(calls_.back(), runs + " -LE long -R physics");
  run("test --long -j 1");
  EXPECT_EQ(calls_.back(), runs + " -j 1");
  run("test --long-share");
  EXPECT_EQ(calls_.back(), runs + " --long-share");
  run("test --preset asan");
  EXPECT_THAT(calls_, ElementsAre("cmake --preset asan", "ninja -C ./build-asan all",
                                  runs + "-asan -LE long"));
}

TEST_F(Launcher, LeavesToTheProgramOfThePageWhatItBuilds) {
  run("results --resume");
  EXPECT_THAT(calls_, ElementsAre("python3 ./bench/results.py --resume"));
}

TEST_F(Launcher, RunsTheThreadedTestsUnderTheThreadSanitizer) {
  const std::string runs = "python3 ./tests/run_ctest.py ./build-tsan";
  run("test --preset tsan");
  EXPECT_THAT(calls_, ElementsAre("cmake --preset tsan", "ninja -C ./build-tsan test-threaded",
                                  runs + " -L threaded"));
  run("test --preset tsan -R Udp");
  EXPECT_THAT(calls_, ElementsAre("ninja -C ./build-tsan all", runs + " -LE long -R Udp"));
}

TEST_F(Launcher, RunsThreeAreasWithTheFlagsOfTheBenchmarks) {
  const std::string runs = "python3 ./tests/run_ctest.py ./build-bench";
  run("test --preset ndebug");
  EXPECT_THAT(calls_, ElementsAre("cmake --preset bench",
                                  "ninja -C ./build-bench test-physics test-im test-rti",
                                  runs + " -LE long -R ^(physics|im|rti)/"));
}

/// The programs of tests but those of the house, which are of no use under a sanitizer.
std::multiset<std::string> programs_of_tests() {
  static const std::regex definition(R"(^rink_tests\(([a-z-]+))");
  std::multiset<std::string> programs;
  const std::string tests = test::source_folder() + "/tests";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tests)) {
    if (entry.path().filename() != "CMakeLists.txt") continue;
    std::ifstream stream(entry.path());
    for (std::string line; std::getline(stream, line);)
      if (std::smatch match; std::regex_search(line, match, definition) && match[1] != "house")
        programs.insert("test-" + match[1].str());
  }
  return programs;
}

TEST_F(Launcher, RunsAThirdOfTheProgramsOfTestsByTurns) {
  stub("git", "echo $COMMITS");
  std::multiset<std::string> sanitized, without_asserts;
  for (const int commits : {300, 301, 302})
    for (const std::string preset : {"asan", "ndebug"}) {
      ASSERT_EQ(
          run("test --preset " + preset + " --share -j 1", "COMMITS=" + std::to_string(commits)), 0)
          << said_;
      std::istringstream words(*(calls_.end() - 2));
      std::string chosen, word;
      words >> word >> word >> word;  // ninja -C FOLDER
      while (words >> word) {
        (preset == "asan" ? sanitized : without_asserts).insert(word);
        chosen += (chosen.empty() ? "" : "|") + word.substr(std::string("test-").size());
      }
      EXPECT_THAT(calls_.back(), EndsWith(" -LE long -R ^(" + chosen + ")/ -j 1"));
    }
  EXPECT_EQ(sanitized, programs_of_tests());
  EXPECT_THAT(without_asserts,
              testing::UnorderedElementsAre("test-physics", "test-im", "test-rti"));
}

TEST_F(Launcher, RefusesAShareOfWhatIsNotShared) {
  for (const char* arguments : {"test --share", "test --preset tsan --share"}) {
    EXPECT_EQ(run(arguments), 2);
    EXPECT_THAT(said_, HasSubstr("--share goes with --preset asan or ndebug, not"));
    EXPECT_THAT(calls_, testing::Each(HasSubstr("git"))) << "nothing was built";
  }
}

TEST_F(Launcher, SaysItsVersionWithoutBuilding) {
  EXPECT_EQ(run("--version"), 0);
  EXPECT_EQ(printed_, "rink 7.8.9 (commit unknown)\n") << "there is no git here";
  EXPECT_THAT(calls_, IsEmpty());
}

TEST_F(Launcher, PacksWhatItHasBuilt) {
  EXPECT_EQ(run("package", "MISSING=help2man"), 0) << said_;
  EXPECT_THAT(calls_, testing::Contains("apt-get install -y --no-install-recommends help2man"));
  EXPECT_EQ(std::vector<std::string>(calls_.end() - 3, calls_.end()),
            (std::vector<std::string>{"ninja -C ./build all", "ninja -C ./build man-pages",
                                      "cpack -G DEB"}));
  EXPECT_THAT(printed_, EndsWith("/build/rink_7.8.9_amd64.deb\n"));
  EXPECT_EQ(run("package", "FAILS_TO_PACK=1"), 4);
  EXPECT_THAT(said_, AllOf(HasSubstr("CPack Error: no crate"), HasSubstr("packing failed")));
  EXPECT_EQ(run("package --help"), 0);
  EXPECT_THAT(calls_, IsEmpty());
  EXPECT_EQ(run("package deb"), 2);
  EXPECT_THAT(calls_, IsEmpty());
}

TEST_F(Launcher, RefusesAPresetThatThereIsNot) {
  EXPECT_EQ(run("test --preset fast"), 2);
  EXPECT_THAT(said_, AllOf(HasSubstr("--preset is release, dev, asan"), HasSubstr("not 'fast'")));
  EXPECT_EQ(run("test --preset"), 2);
  EXPECT_THAT(said_, HasSubstr("usage: ./rink test"));
  EXPECT_THAT(calls_, IsEmpty());
}

TEST_F(Launcher, ExplainsTestsAndSetupWithoutBuilding) {
  for (const char* flag : {"--help", "-h"}) {
    EXPECT_EQ(run(std::string("test ") + flag), 0);
    EXPECT_THAT(printed_, AllOf(HasSubstr("usage: ./rink test"), HasSubstr("--long-share"),
                                HasSubstr("--preset")));
    EXPECT_EQ(run(std::string("setup ") + flag), 0);
    EXPECT_THAT(printed_, AllOf(HasSubstr("usage: ./rink setup"), HasSubstr("libeigen3-dev")));
    EXPECT_THAT(calls_, IsEmpty());
  }
  EXPECT_EQ(run("setup everything"), 2);
  EXPECT_THAT(said_, HasSubstr("usage: ./rink setup"));
}

TEST_F(Launcher, InstallsWhatIsMissingAndOnlyThat) {
  EXPECT_EQ(run("setup"), 0) << said_;
  EXPECT_THAT(calls_, IsEmpty());
  EXPECT_EQ(run("setup", "MISSING=libeigen3-dev"), 0) << said_;
  EXPECT_THAT(calls_, ElementsAre("apt-get update",
                                  "apt-get install -y --no-install-recommends libeigen3-dev"));
  EXPECT_EQ(run("serve", "MISSING=libeigen3-dev RINK_SKIP_PACKAGES=1"), 0) << said_;
  EXPECT_THAT(calls_, ElementsAre("cmake --preset release", "ninja -C ./build rink-serve"));
}

TEST_F(Launcher, InstallsClangOnlyForTheTestsThatNeedIt) {
  EXPECT_EQ(run("test", "MISSING=clang"), 0);
  EXPECT_THAT(calls_, Not(testing::Contains("apt-get update")));
  EXPECT_EQ(run("test --long-share", "MISSING=clang"), 0);
  EXPECT_THAT(calls_, testing::Contains("apt-get install -y --no-install-recommends clang"));
}

/// They come with others or by setup; nobody waits for a network, or is refused, without them.
TEST_F(Launcher, GoesOnWithoutPackagesOfWhichAProgramSaysThatItLeavesThemOut) {
  EXPECT_EQ(run("compare", "MISSING=cyclonedds-dev USER_NUMBER=1000"), 0) << said_;
  EXPECT_THAT(calls_, Not(testing::Contains(HasSubstr("apt-get"))));
  EXPECT_EQ(run("setup", "MISSING=cyclonedds-dev"), 0) << said_;
  EXPECT_THAT(calls_, testing::Contains(HasSubstr("--no-install-recommends cyclonedds-dev")));
  stub("apt-get", "case \"$*\" in *cyclone*) echo 'E: none'; exit 100 ;; esac");
  EXPECT_EQ(run("setup", "MISSING=cyclonedds-dev"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("what needs cyclonedds-dev cyclonedds-tools is left out"));
  EXPECT_EQ(run("serve", "MISSING='libeigen3-dev cyclonedds-dev'"), 0) << said_;
  EXPECT_THAT(calls_,
              testing::Contains("apt-get install -y --no-install-recommends libeigen3-dev"));
}

TEST_F(Launcher, SaysWhatToRunWhereItMayNotInstall) {
  for (const char* command : {"setup", "test", "compare", "bench"}) {
    EXPECT_EQ(run(command, "MISSING=libeigen3-dev USER_NUMBER=1000"), 3) << command;
    EXPECT_THAT(said_,
                AllOf(HasSubstr("no right to install"),
                      HasSubstr("apt-get install -y --no-install-recommends libeigen3-dev")));
    EXPECT_THAT(calls_, Not(testing::Contains(HasSubstr("ninja")))) << command;
  }
}

TEST_F(Launcher, AsksSudoWhereThatNeedsNoPassword) {
  stub("sudo", "[ \"$1\" = -n ] || \"$@\"");
  EXPECT_EQ(run("setup", "MISSING=libeigen3-dev USER_NUMBER=1000"), 0) << said_;
  EXPECT_THAT(calls_,
              testing::Contains("apt-get install -y --no-install-recommends libeigen3-dev"));
}

TEST_F(Launcher, ShowsWhyPackagesCouldNotBeInstalled) {
  EXPECT_EQ(run("setup", "MISSING=libeigen3-dev FAILS_TO_INSTALL=1"), 3);
  EXPECT_THAT(said_, AllOf(HasSubstr("E: no network"),
                           HasSubstr("apt-get could not install libeigen3-dev")));
}

TEST_F(Launcher, NamesThePackagesWhereTheSystemIsNoDebian) {
  std::filesystem::remove(folder_ / "stubs/dpkg-query");
  EXPECT_EQ(run("serve"), 3);
  EXPECT_THAT(said_, AllOf(HasSubstr("RINK_SKIP_PACKAGES=1"), HasSubstr("libeigen3-dev")));
  EXPECT_THAT(calls_, IsEmpty());
  EXPECT_EQ(run("serve", "RINK_SKIP_PACKAGES=1"), 0) << said_;
}

}  // namespace
}  // namespace rink::house
