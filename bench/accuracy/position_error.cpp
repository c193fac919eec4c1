// One sort.
#include "bench/accuracy/position_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace rink::accuracy {

PositionError position_error(std::span<const physics::Vector2> places,
                             std::span<const physics::Vector2> true_places) {
  assert(places.size() == true_places.size() && !places.empty());
  std::vector<double> distances;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double distance = (places[i] - true_places[i]).norm();
    distances.push_back(std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance);
  }
  std::ranges::sort(distances);
  const std::size_t rank = (9 * distances.size() + 9) / 10;  // ceil(0.9 n)
  assert(1 <= rank && rank <= distances.size() && 10 * rank >= 9 * distances.size());
  return {distances[rank - 1], distances.back()};
}

}  // namespace rink::accuracy
