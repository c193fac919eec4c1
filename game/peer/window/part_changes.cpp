// Collects the bodies of a change, and their states.
#include "game/peer/window/part_changes.h"
#include "im/basics/sorted_set.h"

#include <algorithm>

namespace rink::peer {

void PartChanges::note_window(const Share& share) {
  if (!is_noting_) return;
  changed_.clear(), free_flights_.clear(), left_.clear();
  for (const auto& kept : share.subdomain().before().flights()) {
    const std::uint32_t body = share.subdomain().number_of(kept.body);
    if (share.owns(body))
      (share.subdomain().has_flown_freely(body) ? free_flights_ : changed_).push_back(body);
  }
}

void PartChanges::note(const Settlement& settled) {
  if (!is_noting_) return;
  changed_.insert(changed_.end(), settled.came.begin(), settled.came.end());
  left_.insert(left_.end(), settled.left.begin(), settled.left.end());
}

PartChange PartChanges::change(const Share& share, const TimedKeys& keys, bool is_whole) const {
  PartChange change{.step = 0,
                    .time = share.world().now(),
                    .is_whole = is_whole,
                    .bodies = {},
                    .gone = {},
                    .rest_contacts = share.own_rest_contacts(),
                    .keys = {},
                    .log = {}};
  std::vector<std::uint32_t> bodies = is_whole ? share.roles().owned() : changed_;
  make_sorted_set(bodies);
  for (const std::uint32_t body : bodies)
    if (share.owns(body)) change.bodies.push_back({body, share.state(body)});
  if (!is_whole) {
    for (const std::uint32_t body : free_flights_)
      if (share.owns(body))
        change.free_flights.push_back(FreeFlightState::of(body, share.subdomain().flight(body)));
    change.gone = left_;
    change.log = keys.log();
  }
  for (const std::vector<Key>* list : {&keys.due(), &keys.later()})
    for (const Key& key : *list)
      if (key.input != 0 && share.owns(key.bat)) change.keys.push_back(key);
  return change;
}

}  // namespace rink::peer
