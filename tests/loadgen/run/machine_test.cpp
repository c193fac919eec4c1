// What is read from a machine's files, on machines that are folders.
#include "loadgen/run/machine.h"

#include <gmock/gmock.h>

#include <array>
#include <fstream>

#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

class MachineTest : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  test::TemporaryFolder folder_{"machine"};
};

TEST_F(MachineTest, WithoutAnyOfTheFilesSaysThatItIsUnknown) {
  EXPECT_EQ(governor(folder_ / ""), "none");
  EXPECT_EQ(virtualisation(folder_ / ""), "none seen");
  EXPECT_EQ(load(folder_ / ""), "unknown");
  EXPECT_EQ(packages(folder_ / "", std::array{"libasio-dev"}), "unknown");
}

TEST_F(MachineTest, NamesWhatChoosesItsFrequency) {
  write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n");
  EXPECT_EQ(governor(folder_ / ""), "powersave");
}

TEST_F(MachineTest, IsVirtualByAFlagOfItsProcessor) {
  write("proc/cpuinfo", "processor : 0\nflags\t\t: fpu vme hypervisor avx2\n");
  EXPECT_EQ(virtualisation(folder_ / ""), "virtual machine");
  write("sys/class/dmi/id/sys_vendor", "QEMU\n");
  write("run/.containerenv", "");
  EXPECT_EQ(virtualisation(folder_ / ""), "virtual machine (QEMU), container");
}

TEST_F(MachineTest, SaysItsLoad) {
  write("proc/loadavg", "0.52 1.58 2.59 3/597 11206\n");
  EXPECT_EQ(load(folder_ / ""), "0.52, 1.58, 2.59 over 1, 5, 15 min");
}

TEST_F(MachineTest, ListsVersionsOfInstalledPackagesAlone) {
  write("var/lib/dpkg/status",
        "Package: libasio-dev\nStatus: install ok installed\nVersion: 1:1.22.1-1\n\n"
        "Package: libeigen3-dev\nStatus: deinstall ok config-files\nVersion: 3.4.0-4\n\nPackage: "
        "zlib1g\nStatus: install ok installed\nVersion: 1:1.2.13\n");
  EXPECT_EQ(packages(folder_ / "", std::array{"libasio-dev", "libeigen3-dev", "libspdlog-dev"}),
            "libasio-dev 1:1.22.1-1");
}

}  // namespace
}  // namespace rink::loadgen
