// What a watcher is told of interest management, against what every client was told of the world.
#include "game/net/server/interest_report.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "game/net/interest_codec.h"
#include "game/replication/attributes.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

/// Ids of what a client was told is in its scope.
std::vector<std::uint32_t> heard_by(const Client& client) {
  std::vector<std::uint32_t> heard;
  for (const EntityReplica& entity : client.replicas().entities())
    if (entity.in_scope) heard.push_back(entity.object.value);
  std::ranges::sort(heard);
  return heard;
}

bool hears(const Client& client, rti::ObjectHandle object) {
  const EntityReplica* entity = client.replicas().find(object);
  return entity != nullptr && entity->in_scope;
}

/// The server's side of a tick, as Serving does it.
void answer(LockstepRink& rink) {
  for (const Inspections::Question& each : rink.server().inspections().take())
    rink.server().send_interest(each.federate,
                                interest_report(rink.server(), rink.execution(), each.object));
  rink.settle();
}

TEST(AnInterestReport, IsWhatEveryClientWasTold) {
  for (const char* scheme : {"none", "grid", "region"}) {
    LockstepRink rink(small_crowd(), {.scheme = scheme, .clients = 6});
    rink.add_client("watcher", true);
    rink.start();
    rink.run(1.0);
    for (std::size_t asked = 0; asked < 6; ++asked) {
      const InterestSeen seen =
          interest_report(rink.server(), rink.execution(), rink.client(asked).bat()->object);
      EXPECT_EQ(seen.heard, heard_by(rink.client(asked))) << scheme << ", bat " << asked;
      EXPECT_EQ(seen.cell_size > 0.0f, std::string(scheme) == "grid");
      ASSERT_EQ(seen.views.size(), 6u) << "and not who watches";
      EXPECT_EQ(seen.view_count, 6u) << "of twelve bats";
      for (std::size_t k = 0; k < 6; ++k) {
        const auto view = std::ranges::find(seen.views, rink.client(k).bat()->object.value,
                                            &InterestSeen::View::bat);
        ASSERT_NE(view, seen.views.end());
        EXPECT_EQ(view->hears, hears(rink.client(k), rink.client(asked).bat()->object))
            << scheme << ": " << k << " of " << asked;
        EXPECT_EQ(view->low_x, static_cast<float>(rink.client(k).view().low_x));
        EXPECT_EQ(view->high_y, static_cast<float>(rink.client(k).view().high_y));
      }
    }
  }
}

TEST(AnInterestReport, IsSentToTheWatcherWhoAsksAndCostsNobodyAnythingElse) {
  LockstepRink rink(small_crowd(), {.clients = 4});
  Client& watcher = rink.add_client("watcher", true);
  rink.start();
  const std::uint64_t before = rink.execution().counters().interactions_sent;
  for (int tick = 0; tick < 30; ++tick) rink.tick(), answer(rink);
  EXPECT_EQ(rink.execution().counters().interactions_sent, before);
  EXPECT_EQ(rink.server().counters().inspections_answered, 0u);
  watcher.questions()->ask(rink.client(2).bat()->object);
  watcher.questions()->ask(rink.client(1).bat()->object);
  rink.settle();
  answer(rink);
  EXPECT_EQ(rink.execution().counters().interactions_sent, before + 3)
      << "two questions, one answer";
  const std::optional<InterestSeen> told = watcher.questions()->take();
  ASSERT_TRUE(told);
  EXPECT_EQ(*told, interest_report(rink.server(), rink.execution(), rink.client(1).bat()->object))
      << "the later question counts";
  EXPECT_FALSE(watcher.questions()->take());
}

TEST(AnInterestReport, ReadsBackAsItWasWritten) {
  InterestSeen seen{.asked = 5,
                    .cell_size = 1.5f,
                    .view_count = 3,
                    .heard_count = 2,
                    .hearer_count = 1,
                    .views = {{5, true, 0.0f, 1.0f, 2.0f, 3.0f}},
                    .heard = {7, 1u << 20, 0xfffffffeu}};
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  exchange(writer, seen);
  InterestSeen back;
  ASSERT_TRUE(decode(bytes, back));
  EXPECT_EQ(back, seen);
}

TEST(AnInterestReport, ThatIsCutShortOrFalseIsNotBelieved) {
  InterestSeen seen{.asked = 5,
                    .view_count = 1,
                    .heard_count = 0,
                    .views = {{5, true, 0.0f, 1.0f, 2.0f, 3.0f}},
                    .heard = {}};
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  exchange(writer, seen);
  InterestSeen back;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode(rti::Bytes(bytes).first(size), back)) << size;
  for (const int more : {0xff, 0x80}) {
    std::vector<std::byte> longer = bytes;
    longer.insert(longer.end(), 11, static_cast<std::byte>(more));
    EXPECT_FALSE(decode(rti::Bytes(longer), back)) << "a step beyond all handles";
  }
}

}  // namespace
}  // namespace rink::game
