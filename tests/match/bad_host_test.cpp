// Hosts that are none, or none any more: a player is told what happened, on the screen, within
// seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <utility>

#include "game/net/client/network_match.h"
#include "rti/refusal_words.h"
#include "rti/transport/tcp/tcp.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

using testing::HasSubstr;

/// Listens on a port of this machine, and answers the first bytes of whoever comes with `answer`,
/// or not at all.
class FalseHost final : public rti::TransportListener {
 public:
  explicit FalseHost(std::vector<std::byte> answer) : answer_(std::move(answer)) {
    port_ = tcp_.listen("127.0.0.1", 0);
  }
  std::uint16_t port() const { return port_; }
  void poll() { tcp_.poll({}, *this); }

 private:
  void on_open(rti::ConnectionId) override {}
  void on_bytes(rti::ConnectionId connection, rti::Bytes) override {
    const std::vector<std::byte> once = std::exchange(answer_, {});
    const rti::Bytes answer = once;
    if (!answer.empty()) tcp_.send(connection, std::span(&answer, 1));
  }
  void on_close(rti::ConnectionId, rti::CloseReason, const std::string&) override {}

  rti::TcpTransport tcp_;
  std::vector<std::byte> answer_;
  std::uint16_t port_ = 0;
};

std::vector<std::byte> garbage(std::initializer_list<unsigned> bytes) {
  std::vector<std::byte> all;
  for (const unsigned byte : bytes) all.push_back(static_cast<std::byte>(byte));
  return all;
}

template <class Message>
std::vector<std::byte> frame_of(Message message) {
  rti::FrameWriter frame(rti::frame_max_to_federate);
  write(frame.begin_message(measure(message)), message);
  frame.appended();
  return {frame.bytes().begin(), frame.bytes().end()};
}

struct Outcome {
  MatchPhase phase;
  std::string notice;
  double after_s;
};

/// Joins the host and looks on until the match is lost, at most `patience_s` of a clock that does
/// not wait.
Outcome joining(FalseHost& host, double patience_s) {
  const ObjectModel model(rink_fom());
  rti::TcpTransport transport;
  NetworkMatch match(rink_fom(), model, transport, transport.connect("127.0.0.1", host.port()), {});
  double passed_s = 0.0;
  while (passed_s < patience_s && match.sight().phase != MatchPhase::lost) {
    match.advance(50.0 + passed_s);
    host.poll();
    passed_s += 1.0 / 60.0;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return {match.sight().phase, match.sight().notice, passed_s};
}

TEST(AHostThatIsNone, OfAnotherVersionIsNamedSo) {
  FalseHost host(frame_of(rti::RefusedMessage{
      static_cast<std::uint8_t>(rti::Refusal::wrong_version), rti::refused_version(12, 11)}));
  const Outcome outcome = joining(host, 3.0);
  EXPECT_EQ(outcome.phase, MatchPhase::lost);
  EXPECT_THAT(outcome.notice, HasSubstr("this Rink and the host's are of different versions"));
  EXPECT_THAT(outcome.notice, HasSubstr("the federate speaks version 12, the RTI version 11"));
}

TEST(AHostThatIsNone, ThatNeverAnswersIsGivenUpAfterFiveSeconds) {
  FalseHost host({});
  const Outcome outcome = joining(host, 20.0);
  EXPECT_EQ(outcome.phase, MatchPhase::lost);
  EXPECT_THAT(outcome.notice, HasSubstr("no answer from the host: "));
  EXPECT_NEAR(outcome.after_s, 5.0, 0.5);
}

TEST(AHostThatIsNone, BecauseItHostsNoMatchSaysThatItCanBeWatched) {
  FalseHost host(frame_of(rti::JoinedMessage{1, 1}));
  const Outcome outcome = joining(host, 20.0);
  EXPECT_EQ(outcome.phase, MatchPhase::lost);
  EXPECT_THAT(outcome.notice, HasSubstr("no match is hosted there"));
  EXPECT_LT(outcome.after_s, 4.0);
}

TEST(AHostThatIsNone, ThatTalksNonsenseIsLeft) {
  const std::vector<std::vector<std::byte>> answers{
      garbage({0xff, 0xff, 0xff, 0xff, 1, 2, 3}),  // a frame of 4 GB
      garbage({3, 0, 0, 0, 200, 1, 2}),            // a message that is none
      std::vector<std::byte>(1000),                // zeros: frames without messages
      garbage({'H', 'T', 'T', 'P', '/', '1', '.', '1', ' ', '4'}),  // somebody else's protocol
      garbage({2, 0, 0, 0, 64, 1}),                                 // half a message
      frame_of(rti::StampMessage{{1.0, 2}})};                       // before joining
  for (const std::vector<std::byte>& answer : answers) {
    FalseHost host(answer);
    const Outcome outcome = joining(host, 20.0);
    EXPECT_EQ(outcome.phase, MatchPhase::lost);
    EXPECT_THAT(outcome.notice, HasSubstr("no answer from the host: "))
        << static_cast<int>(answer[0]);
    EXPECT_LT(outcome.after_s, 5.6);
  }
}

}  // namespace
}  // namespace rink::game
