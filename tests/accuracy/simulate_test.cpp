// Every scene of the suite runs under rink simulate and is listed in docs/accuracy-suite.md.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "tests/accuracy/accuracy_scene.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::accuracy {
namespace {

using test::text_of;

std::vector<std::filesystem::path> all_scenes() {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::source_folder() + "/scenes/accuracy"))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// What rink simulate writes about `scene` at `until`.
std::string summary_of(const std::filesystem::path& scene, const std::string& until) {
  const test::TemporaryFolder folder("accuracy");
  const std::string summary = (folder / "summary.json").string();
  const std::string command = test::binary_folder() + "/bin/rink-simulate " + scene.string() +
                              " --until " + until + " --summary " + summary + " >" + summary +
                              ".out 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command << ": " << text_of(summary + ".out");
  return text_of(summary);
}

TEST(EveryAccuracyScene, RunsUnderRinkSimulate) {
  for (const auto& scene : all_scenes())
    EXPECT_THAT(summary_of(scene, "0.001"), testing::HasSubstr("\"collisions\"")) << scene;
}

TEST(EveryAccuracyScene, IsListedInTheDocuments) {
  const std::string document = text_of(test::source_folder() + "/docs/accuracy-suite.md");
  std::vector<std::string> missing;
  for (const auto& scene : all_scenes())
    if (document.find("`" + scene.stem().string() + "`") == std::string::npos)
      missing.push_back(scene.stem().string());
  EXPECT_THAT(missing, testing::IsEmpty());
}

TEST(RinkSimulate, CountsTheDigitsOfPi) {
  EXPECT_THAT(summary_of(test::source_folder() + "/scenes/accuracy/pi-chain-4.toml", "15"),
              testing::HasSubstr("\"collisions\": 31415,"));
}

}  // namespace
}  // namespace rink::accuracy
