// What rink-serve --status tells of a running server, and of whoever is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "game/process/process.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/wire/message.h"
#include "tests/net/guest.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(ServeCommand, StatusTellsOfTheFederationsAndFederatesOfARunningServer) {
  Process server(test::binary_folder() + "/bin/rink-serve",
                 {"--scene", "match", "--port", "0", "--scheme", "grid"}, {});
  const std::optional<std::string> place = place_of(server);
  ASSERT_TRUE(place) << server.stderr_tail();
  Process status(test::binary_folder() + "/bin/rink-serve", {"--status", *place}, {});
  for (int i = 0; i < 500 && !status.ending(); ++i) status.attend(10ms);
  ASSERT_TRUE(status.ending());
  EXPECT_EQ(status.ending()->exit_status, 0) << status.stderr_tail();
  EXPECT_THAT(status.line_after("federation rink: ").value_or(""),
              testing::AllOf(HasSubstr("filter grid"), HasSubstr("1 federates"),
                             HasSubstr("connections dropped: none")));
  EXPECT_TRUE(status.line_after("server ")) << "the server's own federate has a line";
  server.stop(5s);
  const Ended nobody = run("rink-serve", {"--status", *place});
  EXPECT_EQ(nobody.status, 11);
  EXPECT_THAT(nobody.words,
              testing::AllOf(HasSubstr("--status: " + *place + ": no server listens there"),
                             HasSubstr("refused")));
}

/// Somebody who listens and speaks something else, or nothing.
struct Foreigner : rti::TransportListener {
  rti::TcpTransport tcp;
  std::uint16_t port = tcp.listen("127.0.0.1", 0);
  bool hangs_up = false;
  void on_open(rti::ConnectionId) override {}
  void on_bytes(rti::ConnectionId connection, rti::Bytes) override {
    if (hangs_up) tcp.close(connection);
  }
  void on_close(rti::ConnectionId, rti::CloseReason, const std::string&) override {}
};

TEST(ServeCommand, StatusTellsARefusalFromSomebodyWhoSpeaksAnotherProtocol) {
  for (const bool hangs_up : {true, false}) {
    Foreigner foreigner;
    foreigner.hangs_up = hangs_up;
    Process status(test::binary_folder() + "/bin/rink-serve",
                   {"--status", "127.0.0.1:" + std::to_string(foreigner.port)}, {});
    for (int i = 0; i < 1000 && !status.ending(); ++i)
      status.attend(5ms), foreigner.tcp.poll(5ms, foreigner);
    ASSERT_TRUE(status.ending());
    EXPECT_EQ(status.ending()->exit_status, 11);
    EXPECT_THAT(status.stderr_tail(),
                HasSubstr("does not speak version " + std::to_string(rti::protocol_version)));
    EXPECT_THAT(status.stderr_tail(),
                HasSubstr(hangs_up ? "closed by peer" : "no answer within 3 s"));
  }
}

/// What is printed later is what is true later: a federate who came in between is there.
TEST(ServeCommand, StatusAsksAgainWhenToldTo) {
  Process server(test::binary_folder() + "/bin/rink-serve", {"--scene", "match", "--port", "0"},
                 {});
  const std::optional<std::string> place = place_of(server);
  ASSERT_TRUE(place) << server.stderr_tail();
  Process status(test::binary_folder() + "/bin/rink-serve", {"--status", *place, "--every", "0.05"},
                 {});
  for (int i = 0; i < 200 && !status.line_after("server "); ++i) status.attend(20ms);
  EXPECT_TRUE(status.line_after("server ")) << status.stderr_tail();
  EXPECT_FALSE(status.line_after("Ada "));
  Guest guest(*place, {.name = "Ada", .only_watches = true});
  for (int i = 0; i < 400 && !status.line_after("Ada "); ++i) guest.exchange(), status.attend(5ms);
  EXPECT_TRUE(status.line_after("Ada ")) << "it asked before Ada came, and again since then";
  EXPECT_FALSE(status.ending()) << "it goes on until it is interrupted: " << status.stderr_tail();
  status.stop(5s);
  EXPECT_EQ(status.ending()->exit_status, 0);
}

}  // namespace
}  // namespace rink::game
