// The pucks that a player watches: the nearest few, which are searched only now and then, since a
// search of all is expensive.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/players/player.h"

namespace rink::game {

/// The number of decisions between two searches: on a crowded rink this makes a decision three
/// times cheaper, and no puck that was not among the nearest comes near enough within a quarter of
/// a second to matter.
inline constexpr std::uint64_t look_about_interval = 5;

/// The nearest `most` of the things shown to it.
template <class Thing>
class Nearest {
 public:
  void clear(std::size_t most) {
    found_.clear();
    most_ = most;
  }
  /// `square` is that of the distance [m^2]. Of two at equal distance the later one counts as
  /// further.
  void show(const Thing& thing, double square) {
    if (found_.size() == most_ && (most_ == 0 || square >= found_.back().square)) return;
    if (found_.size() == most_) found_.pop_back();
    const auto place =
        std::upper_bound(found_.begin(), found_.end(), square,
                         [](double value, const Entry& entry) { return value < entry.square; });
    found_.insert(place, Entry{square, thing});
    assert(found_.size() <= most_);
  }
  struct Entry {
    double square;
    Thing thing;
  };
  const std::vector<Entry>& found() const { return found_; }

 private:
  std::vector<Entry> found_;
  std::size_t most_ = 0;
};

/// The `most` of `seen` that are nearest to `from` [m], the nearest first; of two at equal distance
/// the one that comes first in `seen`.
std::vector<SeenEntity> nearest_of(std::span<const SeenEntity> seen, const Vector2& from,
                                   std::size_t most);

}  // namespace rink::game
