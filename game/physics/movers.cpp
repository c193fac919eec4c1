// Two sorted lists, merged at each look.
#include "game/physics/movers.h"
#include "im/basics/sorted_set.h"

#include <algorithm>

namespace rink::physics::inline RINK_PRECISION {

void Movers::look(const World& world) {
  const std::span<const BodyId> changed = world.changed(cursor_);
  changed_.assign(changed.begin(), changed.end());
  make_sorted_set(changed_);
  if (changed_.size() == world.body_count()) moving_.clear();  // it may be another world's
  still_moving_.clear();
  auto next = moving_.begin();
  for (const BodyId body : changed_) {
    for (; next != moving_.end() && *next < body; ++next) still_moving_.push_back(*next);
    if (next != moving_.end() && *next == body) ++next;
    if (world.is_in_play(body) && !world.is_resting(body)) still_moving_.push_back(body);
  }
  still_moving_.insert(still_moving_.end(), next, moving_.end());
  moving_.swap(still_moving_);
}

}  // namespace rink::physics::inline RINK_PRECISION
