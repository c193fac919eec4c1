// Lies about what another peer owns: whoever can check them names the liar, and the others go on.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "game/peer/standby/packed_states.h"
#include "tests/peer/session_play.h"

namespace rink::peer::test {
namespace {

/// Peer 1 of three lies from its fifth window on. What the honest ones say when they lose it.
/// `hear`, if not empty, is told what it receives.
std::string named_by_the_others(const std::function<bool(std::vector<std::uint8_t>&, bool&)>& lie,
                                std::function<void(std::span<const std::uint8_t>)> hear = {}) {
  Play play(0, 3, 30);
  play.is_live = true;
  std::atomic<bool> has_lied = false;
  bool is_late = false;
  play.on_the_way = [&](End peer, std::vector<std::uint8_t>& bytes) {
    if (peer != 1) return;
    // Given up by one, it would tell the other that this one is gone, which is believed of anybody.
    if (Loss loss; has_lied && read(bytes, loss)) bytes.clear();
    else if (lie(bytes, is_late)) has_lied = true;
  };
  if (hear)
    play.on_arrival = [&](End peer, std::vector<std::uint8_t>& bytes) {
      if (peer == 1) hear(bytes);
    };
  play.run();
  EXPECT_TRUE(has_lied);
  for (const End honest : {0, 2}) {
    EXPECT_EQ(play.fates[honest], Fate::done) << play.messages[honest];
    EXPECT_EQ(play.lost[honest], (std::vector<PeerNumber>{1}));
  }
  return play.last_losses[0] + play.last_losses[2];
}

/// True, and `is_late` from then on, once the liar has played five windows.
bool has_played(std::span<const std::uint8_t> bytes, bool& is_late) {
  Claims claims;
  is_late = is_late || (read(bytes, claims) && claims.window >= 5);
  return is_late;
}

bool is_of_a_window(std::span<const std::uint8_t> bytes) {
  Claims claims;
  Verdict verdict;
  Handover handover;
  return read(bytes, claims) || read(bytes, verdict) || read(bytes, handover);
}

/// Two bodies, in addition, at the ends of the field: at least one of them is far from its zone.
void add_others_bodies(PartRecord& record, const physics::World& start) {
  const Validator scene(start);
  std::vector<Handover::Body> bodies = unpacked(record.committed.states, scene).value();
  for (const auto& [number, x] : {std::pair(0u, 0.1), {1u, 3.9}}) {
    std::erase_if(bodies, [number = number](const auto& body) { return body.number == number; });
    std::erase(record.committed.known, number);
    bodies.push_back({number, physics::Subdomain::state_in(start, number)});
    physics::Flight& flight = bodies.back().state.flight;
    flight.x = x, flight.y = 1.0, flight.vx = flight.vy = 0.0;
  }
  std::ranges::sort(bodies, {}, &Handover::Body::number);
  StatePacker packer(scene);
  for (const auto& [number, state] : bodies) packer.add(number, state);
  record.committed.states = packer.take();
}

/// Who keeps its replica would play on with that body in its place.
TEST(FalseOwner, IsNamedByWhoKeepsItsReplica) {
  const SharedScene scene = shared_scene(0, 0.3);
  const std::string named = named_by_the_others([&](auto& bytes, bool& is_late) {
    PartRecord record;
    if (!has_played(bytes, is_late) || is_of_a_window(bytes) || !read(bytes, record)) return false;
    add_others_bodies(record, scene.world);
    bytes = written(record);
    return true;
  });
  EXPECT_NE(named.find("as its own, which is in another's zone"), std::string::npos) << named;
}

/// What comes to a part comes from others, who know it: here bodies of the keeper's own, or ghosts,
/// of which the numbers would be enough.
TEST(FalseOwner, OfABodyThatItsReplicasKeeperSeesIsNamed) {
  const SharedScene scene = shared_scene(0, 0.3);
  const Validator validator(scene.world);
  Handover last;
  const auto lie = [&](std::vector<std::uint8_t>& bytes, bool& is_late) {
    PartRecord record;
    if (!has_played(bytes, is_late) || is_of_a_window(bytes) || !read(bytes, record)) return false;
    std::vector<Handover::Body> bodies = unpacked(record.committed.states, validator).value();
    const auto altered = std::ranges::find_if(last.bodies, [&](const Handover::Body& body) {
      return std::erase(record.committed.known, body.number) > 0;
    });
    if (altered == last.bodies.end()) return false;
    bodies.push_back(*altered);
    bodies.back().state.repeats += 3;
    std::ranges::sort(bodies, {}, &Handover::Body::number);
    StatePacker packer(validator);
    for (const auto& [number, state] : bodies) packer.add(number, state);
    record.committed.states = packer.take();
    bytes = written(record);
    return true;
  };
  const std::string named = named_by_the_others(lie, [&](std::span<const std::uint8_t> bytes) {
    if (Handover handover; read(bytes, handover) && !handover.bodies.empty()) last = handover;
  });
  EXPECT_NE(named.find(" is as it is not"), std::string::npos) << named;
}

/// A body of which the number alone is said must be here.
TEST(FalseOwner, OfABodyThatItsReplicasKeeperHasNotIsNamed) {
  const std::string named = named_by_the_others([](auto& bytes, bool& is_late) {
    PartRecord record;
    if (!has_played(bytes, is_late) || is_of_a_window(bytes) || !read(bytes, record)) return false;
    record.committed.known.push_back(4'000'000'000);
    bytes = written(record);
    return true;
  });
  EXPECT_NE(named.find("says that body 4000000000 is here, which is not"), std::string::npos)
      << named;
}

/// Peer 1 tells both others another end than it has.
TEST(FalseOwner, OfAnotherEndIsNamed) {
  const std::string named = named_by_the_others([](auto& bytes, bool&) {
    Handover end;
    if (!read(bytes, end) || end.window != 30 || end.free_flights.size() + end.bodies.size() == 0)
      return false;
    for (FreeFlightState& flight : end.free_flights) flight.velocity.x() *= 1.0 + 1e-9;
    for (Handover::Body& body : end.bodies) body.state.repeats += 3;
    bytes = written(end);
    return true;
  });
  EXPECT_NE(named.find(" is as it is not"), std::string::npos) << named;
}

template <class Message>
std::string named_for_another_window() {
  return named_by_the_others([](auto& bytes, bool& is_late) {
    Message message;
    if (!has_played(bytes, is_late) || !read(bytes, message)) return false;
    ++message.window;
    bytes = written(message);
    return true;
  });
}

TEST(FalseOwner, OfAnotherWindowIsNamed) {
  const std::string judge = named_for_another_window<Verdict>(),
                    owner = named_for_another_window<Handover>();
  EXPECT_NE(judge.find("peer 1 judges window "), std::string::npos) << judge;
  EXPECT_NE(owner.find("peer 1 hands over for window "), std::string::npos) << owner;
}

/// Where a peer goes back to is no more than a step away.
TEST(FalseOwner, OfAStepThatNobodyHasPlayedIsNamed) {
  const std::string named = named_by_the_others([](auto& bytes, bool& is_late) {
    Claims claims;
    if (!has_played(bytes, is_late) || !read(bytes, claims)) return false;
    bytes = written(Loss{.step = claims.window + 100, .gone = {0}});
    return true;
  });
  EXPECT_NE(named.find("peer 1 is at step 10"), std::string::npos) << named;
}

/// The accused answers, so its accuser goes.
TEST(FalseOwner, WhoMissesAPeerThatAnswersIsNamed) {
  const std::string named = named_by_the_others([](auto& bytes, bool& is_late) {
    Claims claims;
    if (!has_played(bytes, is_late) || !read(bytes, claims)) return false;
    bytes = written(Loss{.step = claims.window, .questions = {{0, Answer::missed}}});
    return true;
  });
  EXPECT_NE(named.find("peer 1 says that peer 0 is gone, which answers"), std::string::npos)
      << named;
}

}  // namespace
}  // namespace rink::peer::test
