// A server and bots over DDS in this process: what comes is what was published, and what a reader
// in time should have is there.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <thread>
#include <vector>

#include <dds/dds.h>
#include "game/model/scene_file.h"
#include "game/net/scene_choice.h"
#include "game/players/random_plan.h"
#include "loadgen/dds/dds_bot.h"
#include "loadgen/dds/dds_server.h"

namespace rink::loadgen {
namespace {

double clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What came, by bot, tick and body.
class Notes : public DdsBot::Listener {
 public:
  using Ticks = std::map<std::int64_t, std::map<std::uint32_t, DdsReplica>>;
  void state_came(const DdsBot& bot, std::uint32_t body, std::int64_t stamp_ns) override {
    of_bot[bot.number()][stamp_ns][body] = bot.replicas()[body];
  }
  void scope_changed(const DdsBot& bot, std::uint32_t body, bool is_in) override {
    auto& known = of_bot_known[bot.number()];
    EXPECT_EQ(known.contains(body), !is_in) << "comes and goes by turns";
    auto& left_at = of_bot_left[bot.number()];
    if (is_in) {
      known.insert(body);
      const auto left = left_at.find(body);
      flaps += left != left_at.end() && left->second == bot.newest_ns() ? 1 : 0;
    } else {
      known.erase(body);
      left_at[body] = bot.newest_ns();
    }
  }
  std::map<std::uint32_t, Ticks> of_bot;
  std::map<std::uint32_t, std::set<std::uint32_t>> of_bot_known;
  std::map<std::uint32_t, std::map<std::uint32_t, std::int64_t>> of_bot_left;  ///< when
  int flaps = 0;  ///< bodies that came back within the tick at which they left
};

class ReceivedStates : public testing::Test {
 protected:
  static constexpr std::uint32_t bot_count = 2;

  game::ServedGame played(bool has_keys) const {
    game::ServedGame played;
    played.choice = {.scene = "crowd", .puck_count = 150, .seed = 3};
    played.scene = game::chosen_scene(played.choice);
    played.replay.emplace();
    if (has_keys) *played.replay = game::random_plan(3, 100, 10.0);
    return played;
  }

  void play(game::ServedGame&& served) {
    DdsServeOptions options;
    options.scheme = scheme_, options.cell_size = cell_size_, options.clients = bot_count;
    options.duration_s = 1.0, options.patience_s = 20.0;
    DdsServer server(options, served, clock_s);
    const DdsEntity waiting = require(dds_create_waitset(DDS_CYCLONEDDS_HANDLE), "waiting");
    DdsBotsOptions of_bots;
    of_bots.domain = server.domain(), of_bots.view_area = 4.0;
    std::vector<std::unique_ptr<DdsBot>> bots;
    // Instance 0 is the server's in this process.
    for (std::uint32_t k = 0; k < bot_count; ++k)
      bots.push_back(std::make_unique<DdsBot>(of_bots, k, waiting, notes_, 1));
    std::atomic<bool> is_done = false;
    std::thread serving([&] {
      if (server.gather()) server.run();
      is_done = true;
    });
    const auto look = [&] {
      std::vector<dds_attach_t> which(256);
      const auto count =
          require(dds_waitset_wait(waiting, which.data(), which.size(), DDS_MSECS(5)), "waiting");
      for (dds_return_t k = 0; k < count; ++k) {
        const auto each = which[static_cast<std::size_t>(k)];
        bots[DdsBot::bot_of(each)]->take(DdsBot::reader_of(each));
      }
      for (const auto& bot : bots) bot->settle();
      for (const auto& bot : bots) bot->follow(clock_s()), bot->say_ready();
    };
    while (!is_done) look();
    for (int more = 0; more < 40; ++more) look();
    serving.join();
    ticks_ = static_cast<std::size_t>(std::lround(options.duration_s * options.rate_hz)) + 1;
    rate_hz_ = options.rate_hz;
    dds_delete(waiting);
  }

  /// Plays the game again, and compares each state with the body's, to the bit of the float that it
  /// was sent as.
  void expect_the_games_states(game::ServedGame&& served,
                               const std::function<bool(const game::Game&, std::uint32_t bot,
                                                        game::EntityId)>& must_be_there) {
    game::Game game(served.scene);
    for (const game::InputEvent& event : *served.replay) game.submit(event);
    std::size_t compared = 0, expected = 0, missing = 0;
    for (std::size_t tick = 0; tick < ticks_; ++tick) {
      game.advance(static_cast<double>(tick) / rate_hz_);
      const std::int64_t stamp = std::llround(1e9 * game.now());
      for (std::uint32_t bot = 0; bot < bot_count; ++bot) {
        // RTPS rounds time stamps to 2^-32 s.
        const auto near = notes_.of_bot[bot].lower_bound(stamp - 2);
        const bool came = near != notes_.of_bot[bot].end() && near->first <= stamp + 2;
        static const std::map<std::uint32_t, DdsReplica> nothing;
        const auto& states = came ? near->second : nothing;
        for (const game::Entity& entity : game.entities()) {
          const auto found = states.find(entity.id.index);
          const bool must_be = must_be_there(game, bot, entity.id);
          expected += must_be ? 1 : 0, missing += must_be && found == states.end() ? 1 : 0;
          if (found == states.end()) continue;
          const physics::Vector2 place = game.position(entity.id), speed = game.velocity(entity.id);
          ASSERT_EQ(found->second.position.x(), static_cast<float>(place.x()));
          ASSERT_EQ(found->second.position.y(), static_cast<float>(place.y()));
          ASSERT_EQ(found->second.velocity.x(), static_cast<float>(speed.x()));
          ASSERT_EQ(found->second.velocity.y(), static_cast<float>(speed.y()));
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 1000u);
    // A reader keeps the newest state of a body: who takes it late, on a busy machine, misses those
    // before.
    EXPECT_LE(10 * missing, expected) << missing << " of " << expected;
  }

  std::string scheme_ = "grid";
  double cell_size_ = 2.5, rate_hz_ = 0.0;
  std::size_t ticks_ = 0;
  Notes notes_;
};

TEST_F(ReceivedStates, AreAllThatTheGameHasWithoutPartitions) {
  scheme_ = "none";
  play(played(true));
  expect_the_games_states(played(true), [](const auto&, auto, auto) { return true; });
}

/// Without keys the bats rest, so that each reads the cells that it began with.
TEST_F(ReceivedStates, AreThoseOfTheCellsAroundABatAtRest) {
  play(played(false));
  const game::ServedGame served = played(false);
  const PartitionGrid grid(field_of(served.scene), cell_size_);
  expect_the_games_states(played(false), [&](const game::Game& game, std::uint32_t bot,
                                             game::EntityId body) {
    const game::Game start(served.scene);
    const physics::Vector2 place = start.position(*start.bat(bot));
    const double reach = 1.0 + 0.3 + 0.15;  // half the view, the margin, the largest half extent
    const auto cells =
        grid.cells_of({place.x() - reach, place.y() - reach, place.x() + reach, place.y() + reach});
    return std::ranges::binary_search(cells, grid.cell_at(game.position(body)));
  });
}

/// A bat that moves reads other cells than before: all in its view is there but for what is yet to
/// be discovered.
TEST_F(ReceivedStates, FollowABatThatMoves) {
  play(played(true));
  expect_the_games_states(
      played(true), [](const game::Game& game, std::uint32_t bot, game::EntityId body) {
        const physics::Vector2 apart = game.position(body) - game.position(*game.bat(bot));
        return apart.cwiseAbs().maxCoeff() <= 1.0;  // the view
      });
}

/// However readers are asked, a body that goes from a cell that a bot reads to another stays known.
TEST_F(ReceivedStates, StayKnownAcrossTheBordersOfCellsThatAreRead) {
  cell_size_ = 0.8;
  play(played(false));  // bats at rest, whose cells stay the same
  std::size_t comers = 0;
  for (const auto& [bot, known] : notes_.of_bot_known) comers += known.size();
  EXPECT_GT(comers, 10u);
  EXPECT_EQ(notes_.flaps, 0);
}

}  // namespace
}  // namespace rink::loadgen
