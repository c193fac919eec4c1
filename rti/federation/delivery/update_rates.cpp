// Turns by counting in whole numbers, so that no rate drifts.
#include "rti/federation/delivery/update_rates.h"

#include <algorithm>
#include <numeric>

namespace rink::rti {

void UpdateRates::joined(std::uint32_t federate) {
  if (federate >= federates_.size()) federates_.resize(federate + std::size_t{1});
  federates_[federate] = {};
}

void UpdateRates::left(std::uint32_t federate) {
  set_rate(federate, {});
  const ObjectSlot object = federates_[federate].object;
  if (object != no_object && watchers_[object].federate == federate) watchers_[object] = {};
  federates_[federate] = {};
}

void UpdateRates::set_rate(std::uint32_t federate, UpdateRate rate) {
  assert(rate.is_valid() && federate < federates_.size());
  Federate& changed = federates_[federate];
  if (changed.group != every_match) {
    --limited_;
    if (--groups_[changed.group].federates == 0) forget_received();
  }
  changed.group = every_match;
  changed.sent.clear();
  if (rate.is_every_match()) return;
  const std::uint32_t divisor = std::gcd(rate.turns, rate.matches);
  rate = {rate.turns / divisor, rate.matches / divisor};
  if (std::ranges::find(groups_, rate, &Group::rate) == groups_.end()) add_groups(rate);
  for (std::uint32_t k = 0; k < groups_.size(); ++k)
    if (groups_[k].rate == rate &&
        (changed.group == every_match || groups_[k].federates < groups_[changed.group].federates))
      changed.group = k;
  Group& joined = groups_[changed.group];
  if (joined.federates++ == 0) joined.position = pending_.flush_number();
  ++limited_;
}

void UpdateRates::list_missed(std::uint32_t federate, Bitmap& objects) const {
  if (const std::uint32_t group = group_of(federate); group != every_match)
    pending_.list_objects(groups_[group].position, objects);
}

/// Groups of rates that no federate has any more are used again.
void UpdateRates::add_groups(UpdateRate rate) {
  const auto is_unused = [this](UpdateRate of) {
    return std::ranges::none_of(
        groups_, [of](const Group& each) { return each.rate == of && each.federates > 0; });
  };
  std::vector<Group*> free;
  for (Group& each : groups_)
    if (each.federates == 0 && is_unused(each.rate)) free.push_back(&each);
  const std::uint32_t phases = std::min(rate.matches, phase_max);
  for (std::uint32_t phase = 0; phase < phases; ++phase) {
    Group& group = phase < free.size() ? *free[phase] : groups_.emplace_back();
    group.rate = rate;
    group.progress = static_cast<std::uint32_t>(std::uint64_t{rate.matches} * phase / phases);
    group.turns = group.keyframes = 0;
    group.is_due = false;
  }
}

void UpdateRates::send_at_once(std::uint32_t federate, ObjectSlot slot, ObjectHandle object,
                               AttributeSet attributes) {
  assert(federate < federates_.size() && slot != no_object);
  Federate& watcher = federates_[federate];
  if (watcher.object != no_object && watchers_[watcher.object].federate == federate)
    watchers_[watcher.object] = {};
  watcher.object = slot;
  watcher.attributes = attributes;
  watcher.sent.clear();
  if (slot >= watchers_.size()) watchers_.resize(slot + std::size_t{1});
  watchers_[slot] = {federate, object};
  watched_ = watched_ | attributes;
}

void UpdateRates::begin_match() {
  for (Group& each : groups_) {
    each.progress += each.rate.turns;
    if (each.progress < each.rate.matches) continue;
    each.progress -= each.rate.matches;
    each.is_due = true;
    ++each.turns;
  }
}

void UpdateRates::add(std::span<const UpdateRun> runs) {
  if (limited_ > 0) pending_.add(runs);
  list_prompts(runs);
}

/// Those whose turn it is are sent them with all else.
void UpdateRates::list_prompts(std::span<const UpdateRun> runs) {
  prompts_.clear();
  if (limited_ == 0) return;
  for (std::size_t index = 0; index < runs.size(); ++index) {
    const UpdateRun& run = runs[index];
    if ((run.attributes & watched_).is_empty()) continue;
    for (std::size_t record = 0; record < run.slots.size(); ++record) {
      const ObjectSlot object = run.slots[record];
      if (object >= watchers_.size() || watchers_[object].federate == no_federate ||
          watchers_[object].object != ObjectHandle{run.records[record].handle})
        continue;
      const std::uint32_t federate = watchers_[object].federate;
      const Federate& watcher = federates_[federate];
      if (watcher.group == every_match || groups_[watcher.group].is_due) continue;
      if (!(run.attributes & watcher.attributes).is_empty())
        prompts_.push_back({federate, index, record});
    }
  }
  std::ranges::sort(prompts_);
}

void UpdateRates::note_prompt(std::uint32_t federate, AttributeSet attributes, const Stamp& stamp) {
  assert(federate < federates_.size());
  federates_[federate].sent.push_back({attributes, stamp.time});
}

ObjectSlot UpdateRates::sent_before(std::uint32_t federate, const UpdateRun& run) const {
  assert(federate < federates_.size());
  const Federate& watcher = federates_[federate];
  if (watcher.sent.empty() || !run.members.contains(watcher.object)) return no_object;
  AttributeSet sent;
  for (const Sent& each : watcher.sent)
    if (each.time >= run.stamp.time) sent = sent | each.attributes;
  return sent.includes(run.attributes) ? watcher.object : no_object;
}

std::span<const UpdateRun> UpdateRates::due_runs(std::uint32_t group, const ObjectTable& objects) {
  assert(group < groups_.size() && groups_[group].federates > 0);
  return pending_.seal(objects, groups_[group].position);
}

void UpdateRates::end_turns() {
  bool is_any = false;
  for (Group& each : groups_) {
    if (!each.is_due) continue;
    is_any = true;
    each.is_due = false;
    each.position = pending_.flush_number();
  }
  if (is_any) forget_received();
}

/// What the group that is furthest back has received, all have.
void UpdateRates::forget_received() {
  std::uint64_t received = pending_.flush_number();
  for (const Group& each : groups_)
    if (each.federates > 0) received = std::min(received, each.position);
  pending_.forget(received);
}

}  // namespace rink::rti
