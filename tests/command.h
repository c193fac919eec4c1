// Commands as their users run them: from a shell, to their exit status and what they say.
#pragma once

#include <sys/wait.h>

#include <cstdlib>

#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::test {

/// A test of a command; each has a folder of its own.
class CommandTest : public testing::Test {
 protected:
  explicit CommandTest(const std::string& command) : folder_(command) {}

  /// Where `name` lies in the test's folder, for a command line.
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string content(const std::string& name) const { return text_of(folder_ / name); }

  /// The exit status of `rink ARGUMENTS`; what it prints is in `printed_`, what it says on standard
  /// error in `said_`.
  int run(const std::string& arguments) {
    const int status = std::system((test::binary_folder() + "/bin/rink-" + arguments + " >" +
                                    file("printed") + " 2>" + file("said"))
                                       .c_str());
    printed_ = content("printed");
    said_ = content("said");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder folder_;
  std::string printed_, said_;
};

}  // namespace rink::test
