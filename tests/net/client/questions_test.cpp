// What a client asks the server beside the game, and what it keeps of the answers.
#include <gtest/gtest.h>

#include "game/net/client/interest_questions.h"
#include "game/net/client/match_remote.h"
#include "game/net/client/receipt_log.h"
#include "game/net/interest_codec.h"
#include "game/replication/trajectory_codec.h"
#include "rti/wire/stream.h"
#include "tests/places.h"

namespace rink::game {
namespace {

/// A federate that has said that it joins, and nobody has heard it.
struct Lonely {
  const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  const ObjectModel model{fom};
  rti::FederateAmbassador callbacks;
  rti::Ambassador ambassador{fom, callbacks};
  Lonely() { ambassador.join("rink", "lonely", "player"); }
};

TEST(AMatchRemote, GivesTheNewestAnswerOnce) {
  Lonely lonely;
  MatchRemote remote(lonely.ambassador, lonely.model);
  EXPECT_FALSE(remote.take_pong());
  remote.receive({7, 1.5});
  remote.receive({8, 2.5});
  const auto pong = remote.take_pong();
  ASSERT_TRUE(pong);
  EXPECT_EQ(pong->number, 8u);
  EXPECT_EQ(pong->server_s, 2.5);
  EXPECT_FALSE(remote.take_pong());
}

TEST(InterestQuestions, KeepAnAnswerUntilItIsTakenAndNothingThatIsNone) {
  Lonely lonely;
  InterestQuestions questions(lonely.ambassador, lonely.model);
  InterestSeen seen{.asked = 5, .views = {}, .heard = {}};
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  exchange(writer, seen);
  questions.receive(bytes);
  questions.receive(rti::Bytes(bytes).first(3));
  EXPECT_EQ(questions.take(), seen);
  EXPECT_FALSE(questions.take());
}

TEST(AHeardLog, KeepsNothingUnlessItIsWatched) {
  ReceiptLog log;
  log.note_scope({1}, true);
  log.note_update({1}, 12);
  EXPECT_TRUE(log.scopes().empty() && log.updates().empty());
  log.watch();
  log.note_scope({1}, false);
  log.note_update({2}, 12);
  ASSERT_EQ(log.scopes().size(), 1u);
  EXPECT_FALSE(log.scopes()[0].is_in);
  ASSERT_EQ(log.updates().size(), 1u);
  EXPECT_EQ(log.updates()[0].bytes, 12u);
  log.forget();
  EXPECT_TRUE(log.scopes().empty() && log.updates().empty());
}

}  // namespace
}  // namespace rink::game
