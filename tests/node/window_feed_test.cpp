// What all nodes have told, window by window, and what of it a loss undoes.
#include "game/node/window_feed.h"

#include <gtest/gtest.h>

namespace rink::game::window_feed {
namespace {

constexpr double tick_s = 0.1;

/// Of one key.
peer::PartChange change(std::uint64_t stretch) {
  peer::PartChange change;
  change.step = stretch, change.time = tick_s * static_cast<double>(stretch);
  change.log = {{change.time, static_cast<std::uint32_t>(stretch), {0.0, 0.0}, 1}};
  return change;
}

/// Node 0 of three has played `own` windows, of which the others have told so many.
void play(WindowFeed& feed, std::uint64_t own, std::uint64_t second, std::uint64_t third) {
  for (std::uint64_t k = 1; k <= own; ++k) {
    feed.expect({}, tick_s * static_cast<double>(k + 1));
    feed.add(0, change(k));
    if (k <= second) feed.add(1, change(k));
    if (k <= third) feed.add(2, change(k));
  }
}

TEST(WindowFeed, ForgetsWhatIsUndoneAndTakesItAnew) {
  WindowFeed feed(3, tick_s);
  play(feed, 3, 2, 2);
  EXPECT_EQ(feed.stretch_until(feed.end_of(2)), 2u);
  EXPECT_TRUE(feed.rewind(2));
  for (const peer::PeerNumber node : {0u, 1u, 2u}) EXPECT_EQ(feed.count(node), 2u);
  feed.expect({}, 4.0 * tick_s);
  for (const peer::PeerNumber node : {0u, 1u, 2u}) feed.add(node, change(3));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(feed.take(1.0));
  EXPECT_FALSE(feed.take(1.0));
}

TEST(WindowFeed, WaitsForNothingMoreOfALostNode) {
  WindowFeed feed(3, tick_s);
  play(feed, 2, 2, 1);
  EXPECT_EQ(feed.take_felt().size(), 3u) << "the second window is not whole";
  EXPECT_TRUE(feed.rewind(2));
  EXPECT_FALSE(feed.is_whole(2));
  feed.add(2, change(2));  // by whoever stands in for it
  feed.close(2);
  EXPECT_EQ(feed.take_felt().size(), 3u);
  feed.expect({}, 4.0 * tick_s);
  feed.add(0, change(3)), feed.add(1, change(3));
  EXPECT_TRUE(feed.has_come(3.0 * tick_s));
  for (const std::size_t told : {3u, 3u, 2u}) EXPECT_EQ(feed.take(1.0)->changes.size(), told);
}

}  // namespace
}  // namespace rink::game::window_feed
