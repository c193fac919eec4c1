// Peers' connections in one process: frames, admission, dialling, and mail between two ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "game/net/peer/network/peer_admission.h"
#include "game/net/peer/network/peer_conversation.h"
#include "game/net/peer/network/peer_dialling.h"

namespace rink::game {
namespace {

using ::testing::HasSubstr;
using Message = std::vector<std::uint8_t>;

double clock_s = 0.0;
double now() { return clock_s; }

PeerInfo info_at(std::uint16_t port, std::uint32_t bats = 1, std::uint64_t token = 0) {
  return {.place = {"127.0.0.1", port}, .bat_count = bats, .token = token};
}

/// One peer's connections and all that handles them, without waiting.
class End final : public rti::TransportListener {
 public:
  End() : port(sockets.listen("127.0.0.1", 0)), roster(info_at(port), 4, {}, 5) {}

  void poll() {
    links.push_all();
    sockets.get().poll(std::chrono::milliseconds(1), *this);
  }
  /// The next frame of any connection.
  std::optional<std::pair<rti::ConnectionId, Frame>> frame() {
    for (auto& [connection, link] : links.all())
      if (auto next = link.frames.next(peer_frame_max)) return {{connection, std::move(*next)}};
    return std::nullopt;
  }

  rti::SocketTransport sockets{"tcp"};
  std::uint16_t port;
  PeerRoster roster;
  PeerLosses losses;
  PeerLinks links{sockets, now};
  PeerAdmission admission{links, roster, now};
  PeerDialling dialling{links, roster, losses};
  PeerConversation conversation{links, roster, losses};

 private:
  void on_open(rti::ConnectionId connection) override { links.open(connection); }
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override {
    links.add(connection, bytes);
    if (PeerLink* const link = links.find(connection)) link->frames.keep();
  }
  void on_close(rti::ConnectionId connection, rti::CloseReason, const std::string&) override {
    if (links.find(connection)) links.note_close(connection);
  }
};

class PeerConnections : public ::testing::Test {
 protected:
  PeerConnections() { clock_s = 100.0; }

  /// The guest's next frame, or the host's; none after two seconds of nothing.
  std::optional<Frame> frame_of(End& end) {
    for (int looks = 0; looks < 1000; ++looks) {
      host.poll(), guest.poll();
      if (auto next = end.frame()) {
        from = next->first;
        return std::move(next->second);
      }
    }
    return std::nullopt;
  }
  /// A connection between both that is the peer's at each end.
  void connect() {
    const rti::ConnectionId at_guest = guest.links.dial(info_at(host.port), LinkRole::peer);
    guest.links.identify(at_guest, 0, info_at(host.port));
    guest.links.send(at_guest, FrameKind::sign, {});
    ASSERT_TRUE(frame_of(host));
    host.links.identify(from, 1, info_at(guest.port));
  }
  /// What the host answers to a stranger's frame.
  std::optional<Frame> answer_to(FrameKind kind, const Message& content) {
    const rti::ConnectionId stranger = guest.links.dial(info_at(host.port), LinkRole::asked);
    guest.links.send(stranger, kind, content);
    const std::optional<Frame> frame = frame_of(host);
    if (!frame || !host.admission.handle(from, *frame)) return std::nullopt;
    return frame_of(guest);
  }
  void found(std::uint32_t peers) {
    host.roster.found({.peer_count = peers, .until = 10.0, .window = 0.1});
  }

  End host, guest;
  rti::ConnectionId from = 0;
};

TEST_F(PeerConnections, CarryAFrameThatIsLargerThanAQueueAndCountItsBytes) {
  connect();
  const std::uint64_t before = guest.links.bytes_sent();
  const Message large(3 * 1024 * 1024, 9);
  ASSERT_TRUE(guest.links.send_to(0, FrameKind::mail, large));
  EXPECT_TRUE(guest.links.is_sending());
  const std::optional<Frame> frame = frame_of(host);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->content, large);
  EXPECT_FALSE(guest.links.is_sending());
  EXPECT_EQ(guest.links.bytes_sent() - before, framed_size(large.size()));
  EXPECT_FALSE(guest.links.send_to(7, FrameKind::mail, {1}));
}

TEST_F(PeerConnections, KeepMailForWhoWillConnect) {
  guest.links.keep_for(0, {1, 2});
  guest.links.keep_for(3, {4});
  guest.links.release(3);
  guest.links.identify(guest.links.dial(info_at(host.port), LinkRole::peer), 0, {});
  const std::optional<Frame> mail = frame_of(host);
  ASSERT_TRUE(mail);
  EXPECT_EQ(mail->kind, FrameKind::mail);
  EXPECT_EQ(mail->content, (Message{1, 2}));
}

TEST_F(PeerConnections, ShowSignsOfLifeToWhoWasSentNothingForAQuarterOfThePatience) {
  connect();
  clock_s += 2.0;
  guest.links.show_signs(10.0);
  EXPECT_FALSE(guest.links.is_sending());
  clock_s += 1.0;
  guest.links.show_signs(10.0);
  const std::optional<Frame> sign = frame_of(host);
  ASSERT_TRUE(sign);
  EXPECT_EQ(sign->kind, FrameKind::sign);
}

TEST_F(PeerConnections, DismissStrangersWithoutAWordAndThoseWhoAreNeverExpected) {
  host.links.open(901), host.links.open(902);
  host.links.find(902)->early = Greeting{};
  clock_s += 5.1;
  host.links.dismiss_idle(30.0);
  EXPECT_EQ(host.links.dismissed(), 1u);
  EXPECT_FALSE(host.links.find(901));
  clock_s += 25.0;
  host.links.dismiss_idle(30.0);
  EXPECT_EQ(host.links.dismissed(), 2u);
}

/// The other end may have its number already, and play; but nobody may fill the memory here.
TEST_F(PeerConnections, DismissWhoseGreetingCameEarlyWhenTooMuchFollowsIt) {
  host.links.open(901), host.links.open(902);
  for (const rti::ConnectionId early : {901, 902}) host.links.find(early)->early = Greeting{};
  const std::vector<std::byte> part(1024 * 1024);
  for (int parts = 0; parts < 4; ++parts) host.links.add(901, part);
  EXPECT_TRUE(host.links.find(901));
  host.links.add(901, std::span(part).first(1));
  EXPECT_FALSE(host.links.find(901));
  EXPECT_EQ(host.links.dismissed(), 1u);
  host.links.identify(902, 1, info_at(guest.port));
  for (int parts = 0; parts < 5; ++parts) host.links.add(902, part);
  EXPECT_TRUE(host.links.find(902)) << "it is a peer";
}

TEST_F(PeerConnections, AreSeatedByTheFirstPeerAndRefusedWithAReason) {
  found(2);
  Hello hello;
  hello.info = info_at(guest.port);
  hello.session_fingerprint.scene = 1;
  const auto other = answer_to(FrameKind::hello, bytes_of(hello));
  ASSERT_TRUE(other);
  EXPECT_THAT(message_from<Refused>(other->content)->reason, HasSubstr("another scene"));
  EXPECT_EQ(host.links.dismissed(), 1u);
  hello.session_fingerprint.scene = 0;
  const auto seated = answer_to(FrameKind::hello, bytes_of(hello));
  ASSERT_TRUE(seated);
  EXPECT_EQ(message_from<Welcome>(seated->content)->number, 1u);
  ASSERT_TRUE(host.links.at(1));
  EXPECT_TRUE(host.links.at(1)->is_counted);
  EXPECT_FALSE(host.admission.handle(from, {FrameKind::mail, {}}));
}

TEST_F(PeerConnections, AnnounceACallerOnceAndMakeItAPeerWhenAllDecideOnIt) {
  found(1);
  host.roster.begin();
  Hello hello;
  hello.info = info_at(guest.port, 1, 42);
  const rti::ConnectionId asking = guest.links.dial(info_at(host.port), LinkRole::asked);
  guest.links.send(asking, FrameKind::hello, bytes_of(hello));
  const std::optional<Frame> frame = frame_of(host);
  ASSERT_TRUE(frame && host.admission.handle(from, *frame));
  const std::vector<peer::Newcomer> callers = host.admission.callers();
  ASSERT_EQ(callers.size(), 1u);
  EXPECT_EQ(callers[0].token, 42u);
  EXPECT_TRUE(host.admission.callers().empty());

  peer::State state{.cuts = peer::Cuts::whole({})};
  state.members = {0};
  const peer::Candidate candidate{.number = 1, .first_bat = 2, .newcomer = callers[0]};
  EXPECT_FALSE(host.admission.expect(candidate, true, state));
  const std::optional<Frame> welcome = frame_of(guest);
  ASSERT_TRUE(welcome);
  EXPECT_EQ(message_from<Welcome>(welcome->content)->first_bat, 2u);
  EXPECT_TRUE(host.admission.reaches(1));
  EXPECT_FALSE(host.links.at(1)->is_counted);
  EXPECT_FALSE(host.admission.has_given_up(1, 30.0));
  clock_s += 30.1;
  EXPECT_TRUE(host.admission.has_given_up(1, 30.0));
  host.admission.decide(1, false);
  const std::optional<Frame> sent_away = frame_of(guest);
  ASSERT_TRUE(sent_away);
  EXPECT_EQ(message_from<Refused>(sent_away->content)->kind, RefusalKind::again);
  EXPECT_FALSE(host.links.at(1));
  EXPECT_FALSE(host.roster.is_expected(1));
}

TEST_F(PeerConnections, LetANewcomerInWhomTheAnswerTellsWhomElseToReach) {
  found(2);
  guest.dialling.ask({"127.0.0.1", host.port}, now());
  guest.dialling.introduce(guest.links.all().begin()->first);
  const std::optional<Frame> hello = frame_of(host);
  ASSERT_TRUE(hello && host.admission.handle(from, *hello));
  const std::optional<Frame> welcome = frame_of(guest);
  ASSERT_TRUE(welcome && guest.dialling.handle(from, *welcome));
  EXPECT_TRUE(guest.roster.is_in());
  EXPECT_EQ(guest.roster.number(), 1u);
  EXPECT_TRUE(guest.links.are_open(2, 1));
  EXPECT_FALSE(guest.links.are_open(3, 1));
}

TEST_F(PeerConnections, AreDialledAgainFiveTimesASecondForFiveSeconds) {
  guest.dialling.ask({"127.0.0.1", 1}, now());
  const auto tries = [&] { return guest.links.all().size(); };
  guest.dialling.note_unanswered(guest.links.all().begin()->second, "nobody listens");
  clock_s += 0.1;
  guest.dialling.ask_again(10.0, now());
  EXPECT_EQ(tries(), 1u);
  clock_s += 0.1001;
  guest.dialling.ask_again(10.0, now());
  EXPECT_EQ(tries(), 2u);
  guest.dialling.note_unanswered(guest.links.all().begin()->second, "nobody listens");
  clock_s += 4.9;
  try {
    guest.dialling.ask_again(10.0, now());
    FAIL() << "a newcomer asks for ever";
  } catch (const SessionError& error) {
    EXPECT_EQ(error.status(), ExitStatus::no_server);
    EXPECT_STREQ(error.what(), "no peer answers at 127.0.0.1:1: nobody listens");
  }
}

TEST_F(PeerConnections, FollowOneRedirectionAndNoSecondOne) {
  guest.dialling.ask({"127.0.0.1", host.port}, now());
  const Frame elsewhere{FrameKind::elsewhere, bytes_of(Elsewhere{{"127.0.0.1", host.port}})};
  EXPECT_TRUE(guest.dialling.handle(guest.links.all().begin()->first, elsewhere));
  ASSERT_EQ(guest.links.all().size(), 1u);
  EXPECT_FALSE(guest.dialling.handle(guest.links.all().begin()->first, elsewhere));
}

TEST_F(PeerConnections, HandMailOutInOrderAndSayWhoLeft) {
  connect();
  host.losses.begin(true);
  PeerLink& link = *host.links.at(1);
  const auto hear = [&](FrameKind kind, const Message& content) {
    return host.conversation.handle(from, link, {kind, content});
  };
  EXPECT_TRUE(hear(FrameKind::mail, {1}) && hear(FrameKind::mail, {2}) &&
              hear(FrameKind::sign, {}));
  EXPECT_EQ(host.conversation.take_mail(1), Message{1});
  EXPECT_EQ(host.conversation.take_mail(1), Message{2});
  EXPECT_EQ(host.conversation.take_mail(1), std::nullopt);
  EXPECT_TRUE(host.conversation.awaits_farewell());
  EXPECT_TRUE(hear(FrameKind::farewell, bytes_of(Farewell{})));
  EXPECT_FALSE(host.conversation.awaits_farewell());
  EXPECT_FALSE(hear(FrameKind::mail, {3}));  // after the farewell
  EXPECT_EQ(host.conversation.take_mail(1), Message{3});
  try {
    host.conversation.may_still_come(1, Patience(10.0, 5.0, now()));
    FAIL() << "it waits for who has left";
  } catch (const peer::PeerGone& gone) {
    EXPECT_EQ(gone.peer(), 1u);
    EXPECT_TRUE(gone.has_finished());
  }
}

TEST_F(PeerConnections, LoseASilentPeerWhileASignOfLifeKeepsIt) {
  connect();
  host.losses.begin(true);
  Patience patience(10.0, 100.0, now());
  patience.look(clock_s += 9.0);
  EXPECT_TRUE(host.conversation.may_still_come(1, patience));
  guest.links.send_to(0, FrameKind::sign, {});
  ASSERT_TRUE(frame_of(host));
  patience.look(clock_s += 9.0);
  EXPECT_TRUE(host.conversation.may_still_come(1, patience));
  patience.look(clock_s += 1.1);
  EXPECT_FALSE(host.conversation.may_still_come(1, patience));
  EXPECT_THROW(host.conversation.take_mail(1), peer::PeerGone);
  host.conversation.part(1, true);
  EXPECT_EQ(host.conversation.take_mail(1), std::nullopt);
  EXPECT_TRUE(host.links.at(1)->is_closed);
}

TEST_F(PeerConnections, KeepSideMessagesUntilSomebodyListensAndDropWhoSendsBadOnes) {
  host.roster.found({.peer_count = 2, .until = 1.0, .window = 0.1, .interest = {.scheme = "aura"}});
  connect();
  host.losses.begin(true);
  PeerLink& link = *host.links.at(1);
  EXPECT_TRUE(host.conversation.handle(from, link, {FrameKind::aside, {5}}));
  host.conversation.defer(1, {6});
  host.conversation.deliver_deferred({});
  std::vector<Message> heard;
  host.conversation.deliver_deferred([&](peer::PeerNumber, Message bytes) {
    heard.push_back(std::move(bytes));
    return heard.size() < 2;
  });
  EXPECT_EQ(heard, (std::vector<Message>{{5}, {6}}));
  EXPECT_THAT(link.loss, HasSubstr("sent a side message that no peer sends"));
}

}  // namespace
}  // namespace rink::game
