// How often a federate receives the changes of objects, where that is less often than they are
// matched.
#pragma once

#include <cassert>
#include <cstdint>

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

}  // namespace rink::rti
