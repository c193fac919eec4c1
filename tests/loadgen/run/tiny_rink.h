// A rink of one bat and three pucks in which every figure of truth is known by arithmetic.
#pragma once

#include "loadgen/measure/truth/relevance.h"
#include "tests/loadgen/run/judged_rink.h"

namespace rink::loadgen {

/// One bat at rest in the middle of a field without drag; three pucks: one at rest beside it, one
/// that flies by, one far away.
class TinyRink : public JudgedRink {
 protected:
  static constexpr double view_half_side = 1.0;
  static constexpr std::uint32_t bat = 0, still = 1, flying = 2,
                                 far = 3;  // bodies in the order of their making

  void SetUp() override {
    lay({.field = "length = 20.0\nwidth = 20.0\n",
         .bats = {"10.0, 10.0"},
         .pucks = {{"10.5, 10.5"}, {"8.0, 9.5", "1.0, 0.0"}, {"2.0, 2.0"}}});
    end_at(4.0);
    play();
    know({bat, still});
  }
  TruthFigures judged(const RelevanceArea& area = {RelevanceArea::Shape::square,
                                                   view_half_side}) const {
    return truth_of(server_, bots_, area);
  }
};

}  // namespace rink::loadgen
