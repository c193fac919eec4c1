// Clients that are told of the game less often than it ticks: what they hold is the truth whenever
// they are told, and what happens to their own bat they are told at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include "game/net/server/serving.h"
#include "game/replication/trajectory_codec.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

constexpr double crowd_rate_hz = 60.0;

/// Twelve clients of a crowd at 60 Hz, and the ticks at which each heard of others than its own
/// bat.
class RatedCrowd {
 public:
  RatedCrowd(const std::string& policy, const std::string& scheme, double output_rate_hz)
      : rink(small_crowd(), {.scheme = scheme,
                             .clients = 12,
                             .rate_hz = crowd_rate_hz,
                             .view_fraction = 0.3,
                             .update_rate = update_rate_of(output_rate_hz, crowd_rate_hz),
                             .server = {.policy = policy,
                                        .tick_s = 1.0 / crowd_rate_hz,
                                        .replay = keys_for(small_crowd(), 5, 20.0)}}) {
    rink.start();
    for (int tick = 0; tick < 24; ++tick) rink.tick();  // a seat and its bat take a turn each
    told.resize(rink.client_count());
    for (std::size_t k = 0; k < rink.client_count(); ++k) {
      rink.client(k).received().watch();
      rink.client(k).on_news = [this](const rti::Stamp& stamp) {
        ages.push_back(rink.server().game().now() - stamp.time);
      };
    }
  }
  /// Plays a tick; calls `at_turn(client, view)` for each client that hears of others in it, with
  /// the view that it had declared before.
  template <class AtTurn>
  void tick(AtTurn at_turn) {
    rink.settle();
    std::vector<im::Region> views;
    for (std::size_t k = 0; k < rink.client_count(); ++k) {
      views.push_back(rink.client(k).view());
      rink.client(k).received().forget();
    }
    rink.tick();
    for (std::size_t k = 0; k < rink.client_count(); ++k) {
      const ReceiptLog& received = rink.client(k).received();
      const rti::ObjectHandle own = rink.client(k).bat()->object;
      const auto is_other = [&](const auto& each) { return each.object != own; };
      if (!std::ranges::any_of(received.updates(), is_other) &&
          !std::ranges::any_of(received.scopes(), is_other))
        continue;
      told[k].push_back(rink.tick_number);
      at_turn(k, views[k]);
    }
  }
  /// How far the client's replica of `entity` is off, per axis and at the tick [m]; a NaN if it has
  /// none in scope.
  double off(std::size_t client, const Entity& entity) {
    const EntityReplica* replica =
        rink.client(client).replicas().find(rink.server().publisher().object(entity.id));
    if (replica == nullptr || !replica->in_scope || !replica->is_placed) return std::nan("");
    const Game& game = rink.server().game();
    return (replica->position_at(game.now()) - game.position(entity.id)).norm();
  }

  /// All in the client's view is known to it, and all that is known is right to `error_max` [m].
  void expect_truth(std::size_t client, const im::Region& view, double error_max,
                    std::size_t& compared, double& greatest) {
    const Game& game = rink.server().game();
    const bool is_by_centre = rink.scheme() == "grid";
    for (const Entity& entity : game.entities()) {
      const double distance = off(client, entity);
      ASSERT_TRUE(!std::isnan(distance) ||
                  !overlaps(view, game.position(entity.id),
                            is_by_centre ? Vector2(0.0, 0.0) : entity.half_extent))
          << "client " << client << " misses entity " << entity.id.index;
      if (std::isnan(distance)) continue;
      ASSERT_LE(distance, error_max)
          << "client " << client << ", entity " << entity.id.index << ", tick " << rink.tick_number;
      greatest = std::max(greatest, distance);
      ++compared;
    }
  }

  LockstepRink rink;
  std::vector<std::vector<std::uint64_t>> told;  ///< ticks, by client
  std::vector<double> ages;                      ///< of all news, in s
};

struct RatedCase {
  const char* policy;
  const char* scheme;
  double output_rate_hz, error_max;
};
std::ostream& operator<<(std::ostream& out, const RatedCase& told) {
  return out << told.policy << " under " << told.scheme << " at " << told.output_rate_hz;
}

class OutputRate : public testing::TestWithParam<RatedCase> {};

/// Whatever is in view is known, and all that is known is right, at every turn.
TEST_P(OutputRate, AClientHoldsTheTruthWheneverItIsTold) {
  const RatedCase& parameter = GetParam();
  RatedCrowd crowd(parameter.policy, parameter.scheme, parameter.output_rate_hz);
  std::size_t compared = 0;
  double greatest = 0.0;
  for (int tick = 0; tick < 480 && !testing::Test::HasFatalFailure(); ++tick)
    crowd.tick([&](std::size_t client, const im::Region& view) {
      crowd.expect_truth(client, view, parameter.error_max, compared, greatest);
    });
  EXPECT_GT(compared, 10'000u);
  EXPECT_EQ(crowd.rink.client(0).replicas().counters().malformed, 0u);
  RecordProperty("greatest_mm", std::to_string(1e3 * greatest));

  const double ticks_between = crowd_rate_hz / parameter.output_rate_hz;
  for (const std::vector<std::uint64_t>& each : crowd.told)
    for (std::size_t k = 1; k < each.size(); ++k)
      EXPECT_GE(each[k] - each[k - 1], static_cast<std::uint64_t>(ticks_between));
  const double longest_s = (std::ceil(ticks_between - 1e-9) - 1.0) / crowd_rate_hz;
  for (const double age : crowd.ages) ASSERT_LE(age, longest_s + 1e-9);
}

constexpr double snapshot_error = 0.25e-3 * 1.4143;
INSTANTIATE_TEST_SUITE_P(
    PoliciesAndSchemes, OutputRate,
    testing::Values(RatedCase{"on-event", "region", 20.0, trajectory_error_max},
                    RatedCase{"on-event", "grid", 20.0, trajectory_error_max},
                    RatedCase{"on-event", "none", 12.0, trajectory_error_max},
                    RatedCase{"on-event", "region", 25.0, trajectory_error_max},
                    RatedCase{"on-event", "region", 7.5, trajectory_error_max},
                    RatedCase{"periodic", "region", 20.0, 2e-6},
                    RatedCase{"periodic", "none", 45.0, 2e-6},
                    RatedCase{"snapshot", "region", 20.0, snapshot_error},
                    RatedCase{"snapshot", "grid", 25.0, snapshot_error},
                    RatedCase{"dead-reckoning", "region", 20.0, 5e-3},
                    RatedCase{"dead-reckoning-drag", "region", 20.0, 5e-3}));

/// Who is told of every tick is sent residuals to what it holds, and whoever misses some is not.
TEST(OutputRates, ThatChangeAsTheGameGoesOnLeaveEveryClientWithTheTruth) {
  RatedCrowd crowd("on-event", "region", 20.0);
  std::mt19937 random(3);
  std::size_t compared = 0;
  double greatest = 0.0;
  for (int tick = 0; tick < 480 && !testing::Test::HasFatalFailure(); ++tick) {
    if (tick % 5 == 0) {
      constexpr std::array rates_hz{0.0, 20.0, 7.5, 0.0};
      const auto player = static_cast<std::uint32_t>(random() % crowd.rink.client_count());
      const double rate_hz = rates_hz.at(random() % rates_hz.size());
      crowd.rink.execution().set_update_rate(*crowd.rink.server().seats().federate_of(player),
                                             update_rate_of(rate_hz, crowd_rate_hz));
    }
    crowd.tick([&](std::size_t client, const im::Region& view) {
      crowd.expect_truth(client, view, trajectory_error_max, compared, greatest);
    });
  }
  EXPECT_GT(compared, 10'000u);
  EXPECT_GT(crowd.rink.execution().counters().residuals_sent, 100u);
}

TEST(OutputRates, ClientsTakeTurnsEvenly) {
  RatedCrowd crowd("periodic", "none", 20.0);
  std::map<std::uint64_t, int> by_phase;
  const auto times_updated = [&crowd](std::uint32_t player) {
    return crowd.rink.execution().times_updated(*crowd.rink.server().seats().federate_of(player));
  };
  std::vector<std::uint64_t> before;
  for (std::uint32_t k = 0; k < crowd.rink.client_count(); ++k) before.push_back(times_updated(k));
  for (int tick = 0; tick < 60; ++tick) crowd.tick([](std::size_t, const im::Region&) {});
  for (std::uint32_t k = 0; k < before.size(); ++k)
    EXPECT_EQ(times_updated(k) - before[k], 20u) << "as the server's report counts it";
  for (const std::vector<std::uint64_t>& each : crowd.told) {
    EXPECT_EQ(each.size(), 20u);
    std::set<std::uint64_t> phases;
    for (const std::uint64_t tick : each) phases.insert(tick % 3);
    ASSERT_EQ(phases.size(), 1u);
    ++by_phase[*phases.begin()];
  }
  for (const auto& [phase, clients] : by_phase)
    EXPECT_NEAR(clients, 4, 1) << "the server is a federate, too";
  EXPECT_EQ(by_phase.size(), 3u);
}

/// Two of three ticks' news wait, one or two ticks: a tick on average, which is half of what lies
/// between two turns. Of a few ticks the news of the own bat come first, at once.
TEST(OutputRates, TrajectoriesAgeByHalfOfWhatLiesBetweenTurns) {
  RatedCrowd at_once("on-event", "none", crowd_rate_hz), rated("on-event", "none", 20.0);
  for (int tick = 0; tick < 600; ++tick)
    for (RatedCrowd* each : {&at_once, &rated}) each->tick([](std::size_t, const im::Region&) {});
  const auto mean = [](const std::vector<double>& ages) {
    double sum = 0.0;
    for (const double age : ages) sum += age;
    return sum / static_cast<double>(ages.size());
  };
  ASSERT_GT(at_once.ages.size(), 1000u);
  ASSERT_GT(rated.ages.size(), 1000u);
  EXPECT_EQ(mean(at_once.ages), 0.0);
  EXPECT_LE(mean(rated.ages), 1.02 / crowd_rate_hz);
  EXPECT_GE(mean(rated.ages), 0.75 / crowd_rate_hz);
  EXPECT_EQ(at_once.rink.server().game().hash(), rated.rink.server().game().hash());
}

/// Under "on-event" the own bat is right at every tick, and nothing of it is sent twice.
TEST(OutputRates, AClientIsToldOfItsOwnBatAtOnceAndOnce) {
  RatedCrowd at_once("on-event", "none", crowd_rate_hz), rated("on-event", "none", 20.0);
  std::map<std::size_t, int> own_updates, own_updates_at_once;
  const auto count = [](RatedCrowd& crowd, std::map<std::size_t, int>& counts) {
    for (std::size_t k = 0; k < crowd.rink.client_count(); ++k) {
      const rti::ObjectHandle own = crowd.rink.client(k).bat()->object;
      for (const ReceiptLog::Update& each : crowd.rink.client(k).received().updates())
        counts[k] += each.object == own ? 1 : 0;
      const Game& game = crowd.rink.server().game();
      ASSERT_LE(crowd.off(k, game.entity(*game.bat(static_cast<std::uint32_t>(k)))),
                trajectory_error_max)
          << "client " << k << " at tick " << crowd.rink.tick_number;
    }
  };
  for (int tick = 0; tick < 300; ++tick) {
    for (RatedCrowd* each : {&at_once, &rated}) each->tick([](std::size_t, const im::Region&) {});
    count(at_once, own_updates_at_once);
    count(rated, own_updates);
  }
  EXPECT_EQ(own_updates, own_updates_at_once);
}

}  // namespace
}  // namespace rink::game
