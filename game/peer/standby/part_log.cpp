// Collects the inputs of a run.
#include "game/peer/standby/part_log.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "game/peer/standby/packed_states.h"
#include "im/basics/sorted_set.h"

namespace rink::peer {

void PartLog::begin(const Validator& scene) {
  scene_ = &scene;
  next_ = {}, repeated_.clear();
  share_.note_touched();
  contacts_ = share_.subdomain().rest_contacts();
}

bool PartLog::holds_any(std::span<const std::uint32_t> bodies) const {
  return std::ranges::any_of(bodies,
                             [this](std::uint32_t body) { return share_.world().is_held({body}); });
}

std::vector<std::uint8_t> PartLog::packed(std::span<const std::uint32_t> bodies) const {
  assert(scene_ != nullptr && std::ranges::is_sorted(bodies));
  StatePacker packer(*scene_);
  for (const std::uint32_t body : bodies) packer.add(body, share_.state(body));
  return packer.take();
}

/// The window has been undone, so what is there now is what the next run begins with.
void PartLog::note_repeat() {
  if (scene_ == nullptr) return;
  for (const std::uint32_t body : share_.take_touched()) repeated_.push_back(body);
  make_sorted_set(repeated_);
  assert(std::ranges::all_of(
      repeated_, [this](std::uint32_t body) { return share_.subdomain().is_there(body); }));
  next_.repeated.states = packed(repeated_);
  next_.repeated.rest_contacts = share_.subdomain().rest_contacts();
  next_.repeated.sets_contacts =
      holds_any(repeated_) ||
      !are_same(sound_contacts(next_.repeated.rest_contacts, share_.subdomain()),
                sound_contacts(contacts_, share_.subdomain()));
  if (!next_.repeated.sets_contacts) next_.repeated.rest_contacts.clear();
}

void PartLog::note_window(std::uint64_t events) {
  if (scene_ == nullptr) return;
  const std::uint64_t work_of_event = share_.world().spec().puck_drag > 0.0 ? 2 : 1;
  next_.work = work_of_event * events + share_.subdomain().journal().motions.size();
  next_.own_keys = keys_.log();
  for (const Key& key : keys_.due())
    if (key.input == 0 || !share_.owns(key.bat)) next_.other_keys.push_back(key);
  contacts_ = share_.subdomain().rest_contacts();
}

PartRecord PartLog::record() {
  assert(scene_ != nullptr);
  PartRecord record = std::exchange(next_, {});
  repeated_.clear();
  std::vector<std::uint32_t> there = share_.take_touched();
  make_sorted_set(there);
  std::erase_if(there, [&](std::uint32_t body) {
    if (share_.subdomain().is_there(body)) return false;
    record.committed.dropped.push_back(body);
    return true;
  });
  record.committed.states = packed(there);
  std::vector<RestContact> kept = sound_contacts(std::move(contacts_), share_.subdomain());
  contacts_ = share_.subdomain().rest_contacts();
  if (holds_any(there) || !are_same(sound_contacts(contacts_, share_.subdomain()), kept)) {
    record.committed.sets_contacts = true;
    record.committed.rest_contacts = contacts_;
  }
  record.pending = pending();
  return record;
}

PartSnapshot PartLog::snapshot() const {
  PartSnapshot all;
  std::vector<std::uint32_t> bodies = share_.roles().owned();
  bodies.insert(bodies.end(), share_.roles().ghosts().begin(), share_.roles().ghosts().end());
  std::ranges::sort(bodies);
  all.states = packed(bodies);
  all.rest_contacts = share_.subdomain().rest_contacts();
  all.pending = pending();
  return all;
}

std::vector<Key> PartLog::pending() const {
  std::vector<Key> all;
  for (const std::vector<Key>* list : {&keys_.due(), &keys_.later()})
    for (const Key& key : *list)
      if (key.input != 0 && share_.owns(key.bat)) all.push_back(key);
  return all;
}

}  // namespace rink::peer
