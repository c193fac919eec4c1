// Goals and face-offs among peers: every body at every window as in one game, whose score and hash
// are the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <thread>

#include "game/model/scene_file.h"
#include "game/net/peer/shared_game.h"
#include "tests/peer/thread_mail.h"

namespace rink::game {
namespace {

/// A small field with wide goals, crowded about the spots where pucks come back.
Scene goal_mouths(std::uint64_t seed, std::uint32_t pucks, const std::string& rules) {
  return with_seed(parse_scene(R"(name = "mouths"
[field]
length = 3.0
width = 1.6
goal_width = 0.9
[drag]
pucks = 0.1
bats = 3.0
[materials]
restitution = 0.95
[match]
)" + rules + R"(
[[post]]
position = [1.4, 0.3]
radius = 0.05
[[population]]
name = "bat"
kind = "bat"
count = 6
mass = 2.0
[[population]]
name = "puck"
kind = "puck"
count = )" + std::to_string(pucks) +
                                   R"(
mean_speed = 1.2
speeds = "maxwell"
)",
                               "mouths.toml"),
                   seed);
}

/// What one peer had at each window's end.
class Notes final : public WindowParticipant {
 public:
  struct Window {
    double time;
    std::vector<peer::Handover::Body> own;
  };
  void after_window(const peer::Session& session) override {
    windows.push_back({session.peer().now(), {}});
    for (const std::uint32_t body : session.peer().owned())
      windows.back().own.push_back({body, session.peer().share().state(body)});
    repeats = session.counters().peer.repeats, stretches = session.counters().peer.windows;
  }
  std::vector<Window> windows;
  std::uint64_t repeats = 0, stretches = 0;
};

struct Shared {
  std::vector<Notes> notes;
  std::vector<PlayedPart> parts;
};

Shared shared_by(std::uint32_t peers, const SharedGame& game, const Terms& terms) {
  std::vector<PeerInfo> peer_infos(peers);
  for (std::uint32_t k = 0; k < 6; ++k) ++peer_infos[k % peers].bat_count;
  for (std::uint32_t k = 1; k < peers; ++k)
    peer_infos[k].first_bat = peer_infos[k - 1].first_bat + peer_infos[k - 1].bat_count;
  for (PeerInfo& info : peer_infos) info.puck_count = 8;
  Shared shared{std::vector<Notes>(peers), std::vector<PlayedPart>(peers)};
  peer::test::PostOffice office(peers);
  std::vector<std::thread> threads;
  for (std::uint32_t k = 0; k < peers; ++k)
    threads.emplace_back([&, k] {
      peer::test::ThreadMail mail(office, k);
      PartOptions part_options;
      part_options.players = {"chaser", "random"};
      part_options.participant = &shared.notes[k];
      shared.parts[k] = game.play(terms, peer_infos, k, mail, part_options);
    });
  for (std::thread& thread : threads) thread.join();
  return shared;
}

TEST(GoalsAmongPeers, AreCountedAndTheirPucksComeBackAsInOneGameToTheLastDigit) {
  std::uint64_t goals = 0, off_spot = 0, compared = 0, repeats = 0;
  for (std::uint64_t seed = 1; seed <= 10 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto peers = static_cast<std::uint32_t>(seed == 4 || seed == 9 ? 9 : 2 + seed % 3);
    // Spots near the borders of zones and in their middles; delays that end together, and in the
    // middle of a window.
    const std::string rules = "face_off_delay = " + std::string(seed % 2 == 0 ? "0.25" : "0.4371") +
                              "\nface_off_distance = " + (seed % 3 == 0 ? "0.48" : "0.3");
    const Scene scene = goal_mouths(seed, seed == 5 ? 150 : 40, rules);
    const SharedGame game(scene, {});
    const Terms terms{.peer_count = peers,
                      .until = 4.0,
                      .window = seed % 4 == 0 ? 0.07 : 0.02,
                      .balance_windows = 25,
                      .is_replicated = seed % 2 == 0};
    const Shared shared = shared_by(peers, game, terms);

    Game one(scene);
    auto key = shared.parts[0].keys.begin();
    const std::uint64_t goals_before = goals;
    for (std::size_t k = 0; k < shared.notes[0].windows.size() && !testing::Test::HasFailure();
         ++k) {
      // Keys that are stamped with a window's end are played at the beginning of the next.
      for (; key != shared.parts[0].keys.end() && key->time < shared.notes[0].windows[k].time;
           ++key)
        one.submit(*key);
      one.advance(shared.notes[0].windows[k].time);
      for (const ScoredGoal& goal : one.scored()) goals += goal.time > 0.0;
      std::size_t count = 0;
      for (const Notes& notes : shared.notes)
        for (const auto& [body, state] : notes.windows[k].own) {
          ++count;
          ASSERT_EQ(peer::bytes_of(state),
                    peer::bytes_of(physics::Subdomain::state_in(one.world(), body)))
              << "window " << k << ", body " << body;
        }
      ASSERT_EQ(count, one.world().body_count()) << "window " << k;
      // Nobody but who has just come back lies still.
      for (const Entity& entity : one.entities())
        off_spot += entity.kind == physics::BodyKind::puck &&
                    one.simulator().is_in_play(entity.id) && one.velocity(entity.id).isZero(0.0) &&
                    one.position(entity.id).y() != 0.8;
      compared += count;
    }
    for (; key != shared.parts[0].keys.end(); ++key) one.submit(*key);
    one.advance(one.now());
    for (const PlayedPart& part : shared.parts) {
      EXPECT_EQ(part.hash, one.hash());
      EXPECT_EQ(part.score, one.score());
      EXPECT_EQ(part.time, one.now());
    }
    for (const Notes& notes : shared.notes) {
      repeats += notes.repeats;
      EXPECT_LE(notes.stretches, notes.windows.size() + goals - goals_before)
          << "windows are cut more often than pucks come back";
    }
  }
  std::cout << goals << " goals, " << compared << " states compared, " << repeats
            << " windows repeated\n";
  EXPECT_GT(goals, 100u);
  EXPECT_GT(off_spot, 0u) << "no spot was taken";
}

TEST(GoalsAmongPeers, EndTheGameWithTheWindowInWhichOneSideHasWon) {
  const Scene scene = goal_mouths(3, 30, "face_off_delay = 0.5\ngoals_to_win = 4");
  const SharedGame game(scene, {});
  const Shared shared = shared_by(3, game,
                                  {.peer_count = 3,
                                   .until = 60.0,
                                   .window = 0.02,
                                   .balance_windows = 0,
                                   .is_replicated = true});
  Game one(scene);
  for (const InputEvent& event : shared.parts[1].keys) one.submit(event);
  while (!one.is_over()) one.advance(one.now() + 0.001);
  EXPECT_LT(one.now(), 60.0);
  EXPECT_NEAR(shared.parts[1].time, one.now(), 0.021);
  one.advance(shared.parts[1].time);
  for (const PlayedPart& part : shared.parts) EXPECT_EQ(part.hash, one.hash());
  EXPECT_EQ(std::max(one.score().left, one.score().right), 4u);
}

/// As each peer plays a match: the whole of it, with pucks that go to the other side.
TEST(GoalsAmongPeers, PeerThatPlaysTheWholeMovesPucksThatStayTooLongAsOneGameDoes) {
  std::size_t served = 0, goals = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene =
        goal_mouths(seed, seed == 3 ? 1 : 12,
                    "face_off_delay = 0.4371\nface_off_distance = 0.3\npossession_s = 0.6137");
    const SharedGame game(scene, {});
    const Shared shared = shared_by(1, game,
                                    {.peer_count = 1,
                                     .until = 10.0,
                                     .window = seed == 2 ? 0.07 : 1.0 / 60.0,
                                     .balance_windows = 0,
                                     .is_replicated = false});
    Game one(scene);
    auto key = shared.parts[0].keys.begin();
    for (const Notes::Window& window : shared.notes[0].windows) {
      for (; key != shared.parts[0].keys.end() && key->time < window.time; ++key) one.submit(*key);
      one.advance(window.time);
      served += served_in(one).size(), goals += one.scored().size();
      for (const auto& [body, state] : window.own)
        ASSERT_EQ(peer::bytes_of(state),
                  peer::bytes_of(physics::Subdomain::state_in(one.world(), body)))
            << "at " << window.time << " s, body " << body;
    }
    for (; key != shared.parts[0].keys.end(); ++key) one.submit(*key);
    one.advance(one.now());
    EXPECT_EQ(shared.parts[0].hash, one.hash());
    EXPECT_EQ(shared.parts[0].score, one.score());
    EXPECT_FALSE(stays_in(one).empty());
  }
  EXPECT_GT(served, 100u);
  EXPECT_GT(goals, 0u);
}

TEST(GoalsAmongPeers, PeersThatDivideAGameRefuseARuleThatTheyCannotKeep) {
  const SharedGame game(goal_mouths(1, 10, "possession_s = 7.0"), {});
  EXPECT_THROW(game.require_divisible(), SceneError);
  peer::test::PostOffice office(1);
  peer::test::ThreadMail mail(office, 0);
  const std::vector<PeerInfo> peer_infos(1);
  const Terms terms{.peer_count = 1, .until = 1.0, .window = 0.02, .is_replicated = true};
  EXPECT_THROW(game.play(terms, peer_infos, 0, mail, {}), SceneError);
  EXPECT_NO_THROW(SharedGame(goal_mouths(1, 10, ""), {}).require_divisible());
}

TEST(GoalsAmongPeers, NeedWindowsThatEndBeforeAPuckIsToComeBack) {
  const SharedGame game(goal_mouths(1, 10, "face_off_delay = 0.05"), {});
  EXPECT_NO_THROW(game.require_window(0.05));
  try {
    game.require_window(0.06);
    ADD_FAILURE() << "nobody minds";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("windows are 0.060000 s long"));
  }
}

}  // namespace
}  // namespace rink::game
