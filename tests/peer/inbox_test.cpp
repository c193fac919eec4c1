// What a session believes of its mail, and how it learns of losses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "game/peer/session/inbox.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;

/// Hands out what was put into it.
class Letters : public Mail {
 public:
  void send(PeerNumber, std::vector<std::uint8_t> bytes) override { sent.push_back(bytes); }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    if (waiting.empty()) throw PeerGone(from, true, "has left");
    const std::vector<std::uint8_t> first = waiting.front();
    waiting.pop_front();
    return first;
  }
  void part(PeerNumber peer, bool) override { parted.push_back(peer); }
  std::deque<std::vector<std::uint8_t>> waiting;
  std::vector<std::vector<std::uint8_t>> sent;
  std::vector<PeerNumber> parted;
};

struct Receiver {
  explicit Receiver(bool is_replicated) {
    settings.number = 0, settings.peer_count = 3, settings.is_replicated = is_replicated;
    world.add(physics::PuckSpec{.position = {1.0, 1.0}});
    now.members = {0, 1, 2}, now.slots = now.next_number = 3;
    inbox.make_room(3);
  }
  physics::World world{physics::test::rink_of(4.0, 2.0)};
  SessionSettings settings;
  State now{.cuts = Cuts::by_count(field, {}, 3)};
  Letters mail;
  Inbox inbox{settings, Validator(world), mail, false};
};

TEST(Inbox, LearnsOfALossOnce) {
  Receiver receiver(true);
  const std::vector<std::uint8_t> loss = written(Loss{.step = 0, .gone = {2}});
  receiver.mail.waiting = {loss, loss, written(Verdict{.window = 7})};
  EXPECT_THROW(receiver.inbox.received<Verdict>(1, receiver.now), PeerGone);
  EXPECT_TRUE(receiver.inbox.must_recover());
  EXPECT_THAT(receiver.inbox.losses().gone(), ElementsAre(2u));
  EXPECT_THAT(receiver.mail.parted, ElementsAre(2u));
  EXPECT_EQ(receiver.inbox.received<Verdict>(1, receiver.now).window, 7u)
      << "the second is no news";
}

TEST(Inbox, NamesWhoSendsWhatCannotBe) {
  Receiver receiver(true);
  Handover handover;
  handover.keys = {{0.0, 0, {0.0, 0.0}, 1}};
  receiver.mail.waiting = {written(handover)};
  try {
    receiver.inbox.checked<Handover>(1, receiver.now, 0.0);
    ADD_FAILURE() << "body 0 is no bat";
  } catch (const PeerGone& gone) {
    EXPECT_EQ(gone.peer(), 1u);
    EXPECT_THAT(gone.what(), testing::StartsWith("peer 1 hands over a key of bat 0"));
  }
  receiver.mail.waiting = {written(Loss{.step = 0, .gone = {2, 1}})};
  EXPECT_THROW(receiver.inbox.received<Verdict>(1, receiver.now), PeerGone) << "not in order";
  receiver.mail.waiting = {written(Loss{.step = 0, .gone = {0}})};
  EXPECT_THROW(receiver.inbox.received<Verdict>(1, receiver.now), Halt) << "it is given up itself";
}

TEST(Inbox, EndsWithOneResultAlone) {
  std::vector<Handover> parts(3);
  parts[1].free_flights = {{.position = {1.0, 1.0}}};
  Receiver receiver(true), other(true);
  other.mail.waiting = {written(Handover{})};
  EXPECT_THROW(other.inbox.confirm(parts, other.now), ProtocolError);
  receiver.mail.waiting = {other.mail.sent.front(), other.mail.sent.front()};
  receiver.inbox.confirm(parts, receiver.now);
  parts[1].free_flights.front().velocity.x() = 1e-9;
  receiver.mail.waiting = {other.mail.sent.front(), other.mail.sent.front()};
  try {
    receiver.inbox.confirm(parts, receiver.now);
    ADD_FAILURE() << "others have another result";
  } catch (const ProtocolError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("peer 1 ended with another result"));
  }
}

/// Who leaves without its confirmation may have told another end.
TEST(Inbox, DoesNotEndWithWhoLeavesUnconfirmed) {
  Receiver receiver(true), other(true);
  other.mail.waiting = {written(Handover{})};
  EXPECT_THROW(other.inbox.confirm({}, other.now), ProtocolError);
  receiver.mail.waiting = {other.mail.sent.front()};
  EXPECT_THROW(receiver.inbox.confirm({}, receiver.now), LossTold);
  EXPECT_TRUE(receiver.inbox.has_confirmed(1));
  EXPECT_FALSE(receiver.inbox.has_confirmed(2));
  EXPECT_TRUE(receiver.inbox.is_confirmed(receiver.now)) << "by whom is left";
  EXPECT_TRUE(receiver.inbox.must_recover());
}

/// Who misses a peer waits for the others' results, but not of whom it hears that it recovers.
TEST(Inbox, DoesNotAwaitTheResultOfWhoRecovers) {
  Receiver receiver(true);
  receiver.inbox.note_gone(2, "peer 2 is gone");
  receiver.mail.waiting = {written(Loss{.step = 0, .questions = {{2, Answer::missed}}})};
  EXPECT_THROW(receiver.inbox.confirm({}, receiver.now), LossTold);
  EXPECT_FALSE(receiver.inbox.is_confirmed(receiver.now));
}

TEST(Inbox, BoundsWhatIsSaidInARecovery) {
  Receiver receiver(true);
  for (int recoveries = 0; recoveries < 2; ++recoveries) {
    for (std::uint32_t word = 0; word < Inbox::said_max; ++word) receiver.inbox.count_word(1);
    receiver.inbox.recovered();
  }
  for (std::uint32_t word = 0; word < Inbox::said_max; ++word) receiver.inbox.count_word(1);
  receiver.inbox.count_word(2);
  EXPECT_THROW(receiver.inbox.count_word(1), LossTold);
  EXPECT_THAT(receiver.inbox.losses().last(), testing::HasSubstr("peer 1 speaks of losses"));
}

/// Peer 1 asks for peer 2, which answers, and says so in the end.
TEST(Inbox, GivesUpWhoBeginsRecoveriesOfNobody) {
  Receiver receiver(true);
  const auto word = [](Answer answer) { return written(Loss{.questions = {{2, answer}}}); };
  const auto recover = [&] {
    receiver.mail.waiting = {word(Answer::open)};
    EXPECT_THROW(receiver.inbox.received<Verdict>(1, receiver.now), LossTold);
    if (receiver.inbox.losses().is_gone(1)) return;
    for (const PeerNumber from : {1u, 2u})
      receiver.inbox.learns_of_loss(from, word(Answer::heard), receiver.now);
    EXPECT_TRUE(receiver.inbox.has_settled(receiver.now));
    receiver.inbox.recovered();
  };
  for (std::uint32_t alarm = 0; alarm < Inbox::alarms_max; ++alarm) recover();
  EXPECT_THAT(receiver.inbox.losses().gone(), testing::IsEmpty());
  recover();
  EXPECT_THAT(receiver.inbox.losses().gone(), ElementsAre(1u));
  EXPECT_EQ(receiver.inbox.losses().last(), "peer 1 asks again and again for peers that answer");
}

TEST(Inbox, EndsASessionWithoutReplicas) {
  Receiver receiver(false);
  receiver.mail.waiting = {written(Loss{.step = 0, .gone = {2}})};
  EXPECT_THROW(receiver.inbox.received<Verdict>(1, receiver.now), ProtocolError);
  EXPECT_THROW(receiver.inbox.note_gone(2, "peer 2 is gone"), Halt);
}

}  // namespace
}  // namespace rink::peer::test
