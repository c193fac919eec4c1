// A vector as a set: in order, each value once.
#pragma once

#include <algorithm>
#include <vector>

namespace rink {

/// Sorts the values and drops those that are there twice.
template <typename T>
void make_sorted_set(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace rink
