// What is known of all entities or of all subscribers, as pair functions see it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "im/filter.h"
#include "im/pairs/pair_function.h"

namespace rink::im {

/// By id, 120 bytes each up to the largest. Setters return whether anything changed that the pair
/// function uses; what it does not use is not kept. An id that is not there is ignored by all but
/// `place`.
class Parties {
 public:
  explicit Parties(const PairUses& uses) : uses_(uses) {}

  bool place(std::uint32_t id, const Region& region);
  bool set_role(std::uint32_t id, const Role& role);
  bool set_facts(std::uint32_t id, const Facts& facts);
  /// Goes before the heading of the facts.
  bool set_heading(std::uint32_t id, const Heading& heading);
  void remove(std::uint32_t id);
  bool contains(std::uint32_t id) const { return id < known_.size() && known_[id].is_there; }
  std::size_t size() const { return parties_.size(); }

  /// All ages at `now` [s].
  void age(double now);
  /// True if some facts changed an age since the last call.
  bool take_stale() { return std::exchange(is_stale_, false); }

  const rink_party* data() const { return parties_.data(); }
  static Region region_of(const rink_party& party) {
    return {party.low_x, party.low_y, party.high_x, party.high_y};
  }
  Region region(std::uint32_t id) const { return region_of(parties_[id]); }
  std::size_t bytes() const {
    return parties_.capacity() * sizeof(rink_party) + known_.capacity() * sizeof(Known);
  }

 private:
  struct Known {
    bool is_there = false, has_heading = false;
    double changed_at = -std::numeric_limits<double>::infinity();
  };
  static rink_party nobody(std::uint32_t id);

  PairUses uses_;
  bool is_stale_ = false;
  std::vector<rink_party> parties_;
  std::vector<Known> known_;
};

}  // namespace rink::im
