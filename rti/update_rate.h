// How often a federate receives the changes of objects, where that is less often than they are
// matched.
#pragma once

#include <cassert>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace rink::rti {

/// A federate receives changes of scope and new values in `turns` of every `matches` matches,
/// spread evenly: after match n if floor(n turns / matches) has grown, counted from a phase that
/// differs among federates. The number of matches between two turns is matches / turns, rounded up
/// or down.
struct UpdateRate {
  /// Both at least 1 and `turns` at most `matches`; else std::invalid_argument is thrown.
  std::uint32_t turns = 1, matches = 1;

  bool is_every_match() const { return turns == matches; }
  bool is_valid() const { return turns >= 1 && turns <= matches; }
  friend bool operator==(const UpdateRate&, const UpdateRate&) = default;
};

/// Throws std::invalid_argument unless `rate` is valid.
inline void require_valid(UpdateRate rate) {
  if (!rate.is_valid())
    throw std::invalid_argument("update rate: " + std::to_string(rate.turns) + " turns in " +
                                std::to_string(rate.matches) +
                                " matches; expected at least 1 turn in at least as many matches");
}

}  // namespace rink::rti
