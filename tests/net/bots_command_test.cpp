// The command rink-bots from its arguments to its exit status and last words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/process/process.h"
#include "tests/net/guest.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(BotsCommand, NumbersThatAreNoneOrTooLargeAreNamedWithWhatIsAllowed) {
  for (const char* flag :
       {"--count", "--first", "--view", "--duration", "--warm-up", "--patience"}) {
    for (const char* value : {"nan", "inf", "-1", "1e300", "4000000000", "x"}) {
      const Ended ended = run("rink-bots", {flag, value});
      EXPECT_EQ(ended.status, 2) << flag << ' ' << value;
      EXPECT_THAT(ended.words, HasSubstr("is not a number from")) << flag << ' ' << value;
    }
  }
}

/// The port is taken, and nobody there answers.
TEST(BotsCommand, BotsWhoseGameDoesNotStartSayHowLongTheyWaited) {
  rti::TcpTransport silent;
  const std::uint16_t port = silent.listen("127.0.0.1", 0);
  const Ended bots =
      run("rink-bots", {"--connect", "127.0.0.1:" + std::to_string(port), "--patience", "0.5"});
  EXPECT_EQ(bots.status, 11);
  EXPECT_THAT(bots.words, HasSubstr("the game did not start within --patience, 0.5 s"));
}

TEST(BotsCommand, BotsThatWantDatagramsOfAServerWithoutAreToldToLookAtItsTransport) {
  Process server(test::binary_folder() + "/bin/rink-serve",
                 {"--scene", "match", "--clients", "2", "--port", "0"}, {});
  const std::optional<std::string> place = place_of(server);
  ASSERT_TRUE(place) << server.stderr_tail();
  const Ended bots = run(
      "rink-bots", {"--connect", *place, "--transport", "udp", "--count", "2", "--duration", "1"});
  EXPECT_EQ(bots.status, 16);
  EXPECT_THAT(bots.words, HasSubstr("does the server use another transport than udp?"));
}

TEST(BotsCommand, AServerThatIsKilledEndsThemAtOnceWithAStatusOfItsOwn) {
  auto server = std::make_unique<Process>(
      test::binary_folder() + "/bin/rink-serve",
      std::vector<std::string>{"--scene", "match", "--clients", "2", "--port", "0"});
  const std::optional<std::string> place = place_of(*server);
  ASSERT_TRUE(place) << server->stderr_tail();
  Process bots(test::binary_folder() + "/bin/rink-bots",
               {"--connect", *place, "--count", "2", "--duration", "60"}, {});
  for (int i = 0; i < 50; ++i) bots.attend(20ms);
  ASSERT_FALSE(bots.ending()) << bots.stderr_tail();
  server.reset();
  for (int i = 0; i < 100 && !bots.ending(); ++i) bots.attend(20ms);
  ASSERT_TRUE(bots.ending());
  EXPECT_EQ(bots.ending()->exit_status, 16);
  EXPECT_THAT(bots.stderr_tail(), HasSubstr("lost: closed by peer"));
}

}  // namespace
}  // namespace rink::game
