// How late news comes, of a network that is known.
#include "game/match/news_delay.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rink::game {
namespace {

/// A server that ticks every `tick` and has news at every third tick, `way` each way; the client
/// looks every `frame`.
double delay_measured(double tick, double way, double frame, double frame_phase) {
  NewsDelay delay;
  for (int number = 1; number <= 300; number += 3) {
    const double told = number * tick, heard = told + way;
    const double before = frame_phase + std::ceil((heard - frame_phase) / frame - 1.0) *
                                            frame;  // the last frame before it was heard
    delay.received(before + way, told - tick);  // a key pressed in that frame is felt a way later
  }
  return delay.delay().value_or(-1.0);
}

TEST(NewsDelay, IsThereAndBackAndATick) {
  for (const double way : {0.0, 0.02, 0.1})
    for (const double tick : {1.0 / 60.0, 1.0 / 30.0}) {
      const double longest = 2.0 * way + tick + NewsDelay::spare;
      EXPECT_NEAR(delay_measured(tick, way, 1.0 / 1000.0, 0.0004), longest, 1.1e-3)
          << "who looks often waits for all of it";
      EXPECT_NEAR(delay_measured(tick, way, 1.0 / 144.0, 0.0), longest, 1.5e-3)
          << "frames that pass through all phases of the ticks meet the worst";
      EXPECT_LE(delay_measured(tick, way, 1.0 / 60.0, 0.003), longest + 1e-9)
          << "who looks seldom never needs more";
    }
}

TEST(NewsDelay, SaysNothingBeforeItHasHeardEnoughAndForgets) {
  NewsDelay delay;
  for (std::size_t k = 1; k < NewsDelay::needed; ++k) delay.received(1.0, 0.5);
  EXPECT_FALSE(delay.delay());
  delay.received(1.0, 0.5);
  EXPECT_DOUBLE_EQ(delay.delay().value_or(0.0), 0.5 + NewsDelay::spare);
  for (std::size_t k = 0; k < NewsDelay::remembered; ++k) delay.received(1.0, 0.9);
  EXPECT_DOUBLE_EQ(delay.delay().value_or(0.0), 0.1 + NewsDelay::spare);
}

TEST(NewsDelay, IsNotThatOfTheOnePieceInThirtyThatWasHeldUp) {
  NewsDelay delay;
  for (int k = 0; k < 62; ++k) delay.received(1.0, 0.9);
  delay.received(1.0, 0.5), delay.received(1.0, 0.4);
  EXPECT_DOUBLE_EQ(delay.delay().value_or(0.0), 0.1 + NewsDelay::spare);
  delay.received(10.0, 0.0);
  EXPECT_DOUBLE_EQ(delay.delay().value_or(0.0), 0.1 + NewsDelay::spare)
      << "seconds late: a machine that slept";
}

}  // namespace
}  // namespace rink::game
