// Keys on their way from a player's hand to its bat, against a recount of all that was pressed.
#include "game/net/peer/interest/key_counts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rink::game {
namespace {

/// Remembers when each key came, and counts anew for each answer.
class KeyHistory {
 public:
  void begin_window() { ++begun_; }
  void finish_window() { finished_ = begun_; }
  void receive(std::uint32_t player, std::uint32_t count) {
    arrivals_.push_back({player, count, begun_});
  }
  std::uint32_t received(std::uint32_t player) const { return newest(player, begun_ + 1); }
  /// A window feels what came before it began.
  std::uint32_t felt(std::uint32_t player) const { return newest(player, finished_); }
  void tell(std::uint32_t player) { told_.push_back({player, felt(player), 0}); }
  std::uint32_t told(std::uint32_t player) const {
    std::uint32_t most = 0;
    for (const Arrival& each : told_)
      if (each.player == player) most = std::max(most, each.count);
    return most;
  }

 private:
  struct Arrival {
    std::uint32_t player, count;
    int after;  ///< so many windows had begun
  };
  std::uint32_t newest(std::uint32_t player, int before) const {
    std::uint32_t most = 0;
    for (const Arrival& each : arrivals_)
      if (each.player == player && each.after < before) most = std::max(most, each.count);
    return most;
  }

  std::vector<Arrival> arrivals_, told_;
  int begun_ = 0, finished_ = 0;
};

TEST(KeyCounts, AgreeWithARecountOfAllThatWasPressed) {
  constexpr std::uint32_t own = 1;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    KeyCounts counts;
    KeyHistory history;
    counts.set_player_count(3);
    std::uint32_t pressed = 0;
    bool is_within = false;
    for (int step = 0; step < 400; ++step) {
      const auto player = static_cast<std::uint32_t>(random() % counts.player_count());
      switch (random() % 5) {
        case 0:
          is_within ? (counts.finish_window(), history.finish_window())
                    : (counts.begin_window(), history.begin_window());
          is_within = !is_within;
          break;
        case 1:
          ASSERT_EQ(counts.press(own), ++pressed) << "seed " << seed;
          history.receive(own, pressed);
          break;
        case 2: {
          if (player == own) break;
          const auto count = static_cast<std::uint32_t>(random() % 100);
          const bool is_news = count > history.received(player);
          ASSERT_EQ(counts.receive(player, count), is_news) << "seed " << seed;
          history.receive(player, count);
          break;
        }
        case 3: {
          const auto told = counts.take_newly_felt(player);
          ASSERT_EQ(told.has_value(), history.felt(player) > history.told(player));
          if (told) {
            ASSERT_EQ(*told, history.felt(player)) << "seed " << seed;
          }
          history.tell(player);
          break;
        }
        default:
          if (step % 50 == 0) counts.set_player_count(counts.player_count() + 1);
      }
      for (std::uint32_t each = 0; each < counts.player_count(); ++each) {
        ASSERT_EQ(counts.received(each), history.received(each)) << "seed " << seed;
        ASSERT_EQ(counts.felt(each), history.felt(each)) << "seed " << seed;
      }
    }
  }
}

TEST(KeyCounts, FeelAKeyInTheWindowAfterTheOneItCameIn) {
  KeyCounts counts;
  counts.set_player_count(1);
  counts.begin_window();
  EXPECT_EQ(counts.press(0), 1u);
  counts.finish_window();
  EXPECT_EQ(counts.felt(0), 0u);
  EXPECT_FALSE(counts.take_newly_felt(0));
  counts.begin_window();
  counts.finish_window();
  EXPECT_EQ(counts.felt(0), 1u);
  EXPECT_EQ(counts.take_newly_felt(0), 1u);
  EXPECT_FALSE(counts.take_newly_felt(0)) << "told once";
}

}  // namespace
}  // namespace rink::game
