// Sorts keys into this window and later ones.
#include "game/peer/window/timed_keys.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

namespace rink::peer {

namespace {

bool is_before(const Key& a, const Key& b) {
  return std::tuple(a.time, a.bat) < std::tuple(b.time, b.bat);
}

}  // namespace

void TimedKeys::repeat_with(std::span<const Key> keys) {
  due_.insert(due_.end(), keys.begin(), keys.end());
  std::stable_sort(due_.begin(), due_.end(), is_before);
}

void TimedKeys::begin_window(double until, const Roles& roles) {
  due_.clear();
  std::vector<Key> later;
  for (const Key& key : later_) {
    if (key.bat >= roles.body_count() || roles.of(key.bat) == Role::away) continue;
    if (key.time <= until) due_.push_back(key);
    else if (roles.owns(key.bat)) later.push_back(key);
  }
  std::stable_sort(due_.begin(), due_.end(), is_before);
  later_ = std::move(later);
  assert(std::ranges::all_of(later_, [until](const Key& key) { return !(key.time <= until); }));
}

void TimedKeys::end_at(double until, const Roles& roles) {
  later_.insert(later_.end(), due_.begin(), due_.end());
  begin_window(until, roles);
}

void TimedKeys::note_log(const Roles& roles) {
  log_.clear();
  for (const Key& key : due_)
    if (key.input != 0 && roles.owns(key.bat)) log_.push_back(key);
}

void TimedKeys::check() const { assert(std::ranges::is_sorted(due_, is_before)); }

}  // namespace rink::peer
