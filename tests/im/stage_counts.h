// What stages say that they counted.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "im/filter.h"

namespace rink::im {

inline std::uint64_t count(const Filter& filter, const std::string& what) {
  std::vector<StageCount> counts;
  filter.list_counts(counts);
  for (const StageCount& each : counts)
    if (what == each.what) return each.count;
  ADD_FAILURE() << "nothing counts " << what;
  return 0;
}

}  // namespace rink::im
