// Lies about what another peer owns: whoever can check them names the liar, and the others go on.
#include <gtest/gtest.h>

#include <array>

#include "tests/peer/session_play.h"

namespace rink::peer::test {
namespace {

/// Peer 1 of three lies from its fifth window on. What the honest ones say when they lose it.
std::string named_by_the_others(const std::function<bool(std::vector<std::uint8_t>&, bool&)>& lie) {
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
  std::array<std::string, 3> losses;
  std::array<std::vector<PeerNumber>, 3> gone;
  play.before_window = [&](Session& session, End peer) {
    losses[peer] = session.last_loss();
    gone[peer] = session.lost();
  };
  play.run();
  EXPECT_TRUE(has_lied);
  for (const End honest : {0, 2}) {
    EXPECT_EQ(play.fates[honest], Fate::done) << play.messages[honest];
    EXPECT_EQ(gone[honest], (std::vector<PeerNumber>{1}));
  }
  return losses[0] + losses[2];
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

/// Who keeps its replica would hand that body over in its place, and be believed.
TEST(FalseOwner, IsNamedByWhoKeepsItsReplica) {
  const std::string named = named_by_the_others([](auto& bytes, bool& is_late) {
    PartChange part;
    if (!has_played(bytes, is_late) || is_of_a_window(bytes) || !read(bytes, part) ||
        part.bodies.empty())
      return false;
    Handover::Body body = part.bodies.front();
    for (const double x : {0.1, 3.9}) {  // at least one of them is not in its zone
      body.state.flight.x = x, body.state.flight.time = part.time;
      part.bodies.push_back(body);
    }
    bytes = written(part);
    return true;
  });
  EXPECT_NE(named.find("as its own, which is in another's zone"), std::string::npos) << named;
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

}  // namespace
}  // namespace rink::peer::test
