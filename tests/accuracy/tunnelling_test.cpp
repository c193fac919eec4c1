// What the paper's figure 5 shows: without dynamic tests a fast puck passes through an obstacle;
// with them, and without frames, it bounces where it must.
#include "tests/accuracy/accuracy_scene.h"

namespace rink::accuracy {
namespace {

/// Where the puck is after 0.2 s, and how many impacts it had.
std::pair<double, std::uint64_t> flown(const std::string& engine) {
  Game game(scene_named("tunnelling"), {.engine = engine, .dt = 1.0 / 60});
  game.advance(0.2);
  return {game.position({1}).x(), game.simulator().counters().impacts()};
}

TEST(PuckThatIsFasterThanTheFrames,
     BouncesUnderTheExactAndThePapersEngineAndTunnelsUnderTheNaiveOne) {
  const double contact = 1.6 - 0.07, back = contact - (12.0 * 0.2 - (contact - 0.5));
  for (const char* engine : {"exact", "paper"}) {
    const auto [place, impacts] = flown(engine);
    EXPECT_EQ(impacts, 1u) << engine;
    expect_at_most("error of the place [m]", std::abs(place - back), 1e-12);
  }
  const auto [place, impacts] = flown("naive");
  EXPECT_EQ(impacts, 0u);
  EXPECT_NEAR(place, 0.5 + 12.0 * 0.2, 1e-12);
}

}  // namespace
}  // namespace rink::accuracy
