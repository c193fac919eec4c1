// What a predicate may answer beside a bool.
#pragma once

namespace rink::im {

/// The answer, and how far both may come from here, the sum of the greatest changes of any
/// coordinate of either [m], before the answer can change, without regard to rounding. 0: not
/// known, so the predicate is called whenever one has moved.
struct Judgement {
  bool is_relevant;
  double slack;
};

}  // namespace rink::im
