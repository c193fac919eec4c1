// Saves as files: whole or not at all, whatever their labels are.
#include "rti/save/save_directory.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "rti/fom/fom_module.h"
#include "tests/rti/rig.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

TEST(SaveDirectory, KeepsOneFileForEachFederationAndLabel) {
  const test::TemporaryFolder folder("saves");
  SaveDirectory saves(std::filesystem::path(folder) / "new" / "below");
  const std::vector<std::string> names{
      "rink",     "a/b", "a_b", "..", std::string(255, 'x'), std::string(255, 'x') + "y",
      "\xc3\xa9", "a b"};
  for (const std::string& federation : names)
    for (const std::string& label : names)
      EXPECT_EQ(saves.write(federation, label, bytes_of(federation + "|" + label)), "");
  for (const std::string& federation : names)
    for (const std::string& label : names) {
      const SaveStore::Found found = SaveDirectory(saves).read(federation, label);
      ASSERT_TRUE(found.bytes) << found.why;
      EXPECT_EQ(text_of(*found.bytes), federation + "|" + label);
    }
  EXPECT_EQ(saves.read("rink", "never").why, "there is none");
}

TEST(SaveDirectory, ReplacesASaveWholeOrLeavesIt) {
  const test::TemporaryFolder folder("saves");
  SaveDirectory saves{std::filesystem::path(folder)};
  EXPECT_EQ(saves.write("rink", "noon", bytes_of("the first")), "");
  EXPECT_EQ(saves.write("rink", "noon", bytes_of("the next")), "");
  EXPECT_EQ(text_of(*saves.read("rink", "noon").bytes), "the next");
  // The file that is written first cannot be made: a folder stands in its place.
  std::filesystem::path fresh = saves.file_of("rink", "noon");
  fresh += ".new";
  std::filesystem::create_directory(fresh);
  EXPECT_NE(saves.write("rink", "noon", bytes_of("the third")).find(".save.new: "),
            std::string::npos);
  EXPECT_EQ(text_of(*saves.read("rink", "noon").bytes), "the next");
}

TEST(SaveDirectory, SaysThatADiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const test::TemporaryFolder folder("saves");
  SaveDirectory saves{std::filesystem::path(folder)};
  std::filesystem::path fresh = saves.file_of("rink", "noon");
  fresh += ".new";
  std::filesystem::create_symlink("/dev/full", fresh);
  EXPECT_NE(saves.write("rink", "noon", bytes_of("words")).find("No space left on device"),
            std::string::npos);
  EXPECT_EQ(saves.read("rink", "noon").why, "there is none");
}

TEST(SaveDirectory, IsRefusedByNameWhereNothingCanBeWritten) {
  const test::TemporaryFolder folder("saves");
  const std::filesystem::path file = std::filesystem::path(folder) / "file";
  std::ofstream(file) << "no directory";
  try {
    SaveDirectory saves(file);
    FAIL() << "a file is no directory";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("'" + file.string() + "'"), std::string::npos);
  }
}

}  // namespace
}  // namespace rink::rti::testing
