// The commands that play over DDS say what is wrong, and end in good order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "loadgen/dds/dds_absence.h"
#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class DdsCommand : public test::CommandTest {
 protected:
  DdsCommand() : CommandTest("dds-command") {}
  void SetUp() override {
    if (dds_absence != nullptr) GTEST_SKIP() << dds_absence;
  }
};

TEST_F(DdsCommand, NamesWhatIsWrong) {
  EXPECT_EQ(run("dds bots --count 2"), 2);
  EXPECT_THAT(said_, HasSubstr("--domain: is missing"));
  EXPECT_EQ(run("dds watch"), 2);
  EXPECT_EQ(run("dds serve --domain 100"), 2);
  EXPECT_EQ(run("dds serve --clients 1000 --scene arena --domain 3"), 2);
  EXPECT_THAT(said_, HasSubstr("--clients: 1000 for the"));
  EXPECT_EQ(run("dds serve --cell-size 0.01 --scene crowd"), 1);
  EXPECT_THAT(said_, AllOf(HasSubstr("--cell-size"), HasSubstr("writers")));
  EXPECT_EQ(run("dds bots --domain 98 --patience 0.3"), 17);
  EXPECT_THAT(said_, HasSubstr("nobody began a game in domain 98"));
  EXPECT_EQ(run("dds serve --patience 0.3"), 17);
  EXPECT_THAT(said_, HasSubstr("0 of 1 bots came"));
}

TEST_F(DdsCommand, RefusesADomainThatIsInUse) {
  const std::string serve = test::binary_folder() + "/bin/rink-dds serve --patience 5 ";
  // The first says its domain, which is free; the second asks for it.
  const std::string script = serve + ">" + file("first") +
                             " 2>&1 & first=$!; for k in 1 2 3 4 5 6 7 8 9 10; do "
                             "grep -qs listening " +
                             file("first") +
                             " && break; sleep 0.2; done; "
                             "number=$(sed 's/.* //' " +
                             file("first") + "); " + serve + "--domain $number 2>" + file("said") +
                             "; status=$?; kill $first; wait $first; exit $status";
  const int status = std::system(script.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 10) << content("said");
  EXPECT_THAT(content("said"), HasSubstr("is in use on this machine"));
}

TEST_F(DdsCommand, EndsWithTheServerAndLeavesNoProcessBehind) {
  const std::string program = test::binary_folder() + "/bin/rink-dds ";
  const std::string script =
      program + "serve --clients 1 --duration 30 >" + file("first") +
      " 2>&1 & first=$!; "
      "for k in 1 2 3 4 5 6 7 8 9 10; do grep -qs listening " +
      file("first") + " && break; sleep 0.2; done; (sleep 1.5; kill -INT $first) & " + program +
      "bots --duration 30 --domain $(sed 's/.* //' " + file("first") + ") 2>" + file("said") +
      "; status=$?; wait $first; echo $? >" + file("ended") + "; exit $status";
  const int status = std::system(script.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 16) << content("said");
  EXPECT_THAT(content("said"), HasSubstr("the server left the domain"));
  EXPECT_EQ(content("ended"), "130\n");
}

}  // namespace
}  // namespace rink::loadgen
