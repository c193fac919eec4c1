// What holds for every test: a name that can be typed, and folders and ports that no other test
// has.
#include <gmock/gmock.h>

#include <array>
#include <set>

#include "tests/house/source_tree.h"

namespace rink::house {
namespace {

/// The names that CMake's discovery gave the tests, from the scripts that ctest reads before it
/// runs any.
std::vector<std::string> names_of_tests() {
  static const std::regex addition(R"(^add_test\(\[=*\[(.*?)\]=*\])");
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(test::binary_folder() + "/tests")) {
    if (!entry.path().filename().string().ends_with("_tests.cmake")) continue;
    std::ifstream stream(entry.path());
    for (std::string line; std::getline(stream, line);)
      if (std::smatch match; std::regex_search(line, match, addition)) names.push_back(match[1]);
      else if (line.starts_with("add_test")) names.push_back(line);
  }
  return names;
}

TEST(Tests, AreCalledByWordsThatCanBeTyped) {
  static const std::regex words("[A-Za-z0-9_]+(-[a-z]+)*/[A-Za-z0-9_./]+");
  const std::vector<std::string> names = names_of_tests();
  EXPECT_THAT(names, testing::Contains("house/Tests.AreCalledByWordsThatCanBeTyped"))
      << "ctest writes the list";
  for (const std::string& name : names) EXPECT_TRUE(std::regex_match(name, words)) << name;
}

TEST(Tests, AreCalledByNamesOfTheirOwn) {
  std::set<std::string> seen;
  for (const std::string& name : names_of_tests()) EXPECT_TRUE(seen.insert(name).second) << name;
}

/// What two processes side by side would share: a fixed file in the temporary folder, a number made
/// of a process's, a fixed port to listen at.
bool is_shared(const std::string& line) {
  static const std::regex place(
      R"(\b(TempDir|temp_directory_path|getpid|tmpnam|tempnam)\s*\(|"/tmp/)");
  static const std::regex port(
      R"(\blisten\("[^"]*", *[1-9]|"--port", *"[1-9]|--(host|port|peer-listen) (\S+:)?([1-9][0-9]{3}|[1-6][0-9]{4})\b)");
  return std::regex_search(line, place) || std::regex_search(line, port);
}

TEST(Tests, ShareNoFolderAndNoPort) {
  // The one makes such folders and names; the other holds the lines below.
  const std::array<std::string, 2> exempt{"tests/temporary_folder.h", "tests/house/tests_test.cpp"};
  for (const SourceFile& source : read_sources({"tests"}, code_extensions))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      if (std::ranges::find(exempt, source.path) == exempt.end() && is_shared(source.lines[i]))
        report(source, i,
               "two runs side by side would share it: take test::TemporaryFolder, "
               "test::unique_name() or port 0");
}

TEST(TestsThemselves, TellWhatIsSharedFromWhatIsNot) {
  for (const char* line :
       {"testing::TempDir() + \"match.keys\"", "std::filesystem::temp_directory_path() / name",
        "20'000 + getpid() % 10'000", "tcp.listen(\"127.0.0.1\", 4711)", "{\"--port\", \"4711\"}",
        "play(\"--host 4711\")", "play(\"--peer-listen 127.0.0.1:4800\")"})
    EXPECT_TRUE(is_shared(line)) << line;
  for (const char* line : {"test::TemporaryFolder folder(\"keys\");", "play(\"--host 99999\")",
                           "tcp.listen(\"127.0.0.1\", 0)", "{\"--port\", \"0\"}",
                           "\"--join 127.0.0.1:1\"", "play(\"--peer-listen 127.0.0.1:0\")"})
    EXPECT_FALSE(is_shared(line)) << line;
}

}  // namespace
}  // namespace rink::house
