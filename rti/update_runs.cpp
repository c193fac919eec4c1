// Runs of updates that share all but object and values.
#include "rti/update_runs.h"

#include <algorithm>

#include "rti/message.h"

namespace rink::rti {

UpdateRun& UpdateRuns::begin(std::uint32_t owner, const Object& object, AttributeSet attributes, const Stamp& stamp, std::uint32_t value_size) {
  if (size_ == runs_.size()) runs_.emplace_back();
  UpdateRun& run = runs_[size_++];
  run.owner = owner;
  run.object_class = object.object_class;
  run.attributes = attributes;
  run.stamp = stamp;
  run.value_size = value_size;
  run.message.resize(UpdatesMessage::header_size);
  run.first_word = static_cast<std::size_t>(-1);
  run.last_word = 0;
  return run;
}

UpdateRun& UpdateRuns::run_for(std::uint32_t owner, ObjectSlot slot, const Object& object, AttributeSet attributes, const Stamp& stamp,
                               std::uint32_t value_size) {
  // Only a run behind the object's last one may take its next record, or updates of one object would overtake each other. Looking at the last
  // eight runs suffices: a tick has few kinds of updates.
  const std::size_t earliest = std::max<std::size_t>(last_run_[slot], size_ > 8 ? size_ - 8 : 0);
  for (std::size_t i = size_; i > earliest; --i) {
    UpdateRun& run = runs_[i - 1];
    if (run.owner == owner && run.object_class == object.object_class && run.attributes == attributes && run.stamp == stamp) return run;
  }
  return begin(owner, object, attributes, stamp, value_size);
}

void UpdateRuns::append(std::uint32_t owner, ObjectSlot slot, const Object& object, AttributeSet attributes, const Stamp& stamp, std::uint32_t value_size,
                        Bytes record) {
  if (slot >= last_run_.size()) last_run_.resize(slot + 1);
  UpdateRun& run = run_for(owner, slot, object, attributes, stamp, value_size);
  last_run_[slot] = static_cast<std::uint32_t>(&run - runs_.data()) + 1;
  run.slots.push_back(slot);
  run.offsets.push_back(static_cast<std::uint32_t>(run.message.size()));
  run.message.insert(run.message.end(), record.begin(), record.end());
  run.members.insert(slot);
  run.first_word = std::min<std::size_t>(run.first_word, slot / 64);
  run.last_word = std::max<std::size_t>(run.last_word, slot / 64);
}

void UpdateRuns::seal() {
  for (std::size_t i = 0; i < size_; ++i) {
    UpdateRun& run = runs_[i];
    write_updates_header(run.message.data(), run.object_class, run.attributes, run.stamp, run.value_size, static_cast<std::uint32_t>(run.slots.size()),
                         static_cast<std::uint32_t>(run.message.size() - UpdatesMessage::header_size));
    if (run.slots.size() <= UpdateRun::short_run) continue;
    run.record_of.resize(std::max(run.record_of.size(), last_run_.size()));
    for (std::uint32_t k = 0; k < run.slots.size(); ++k) run.record_of[run.slots[k]] = k;
  }
}

void UpdateRuns::clear() {
  for (std::size_t i = 0; i < size_; ++i) {
    UpdateRun& run = runs_[i];
    for (const ObjectSlot slot : run.slots) {
      run.members.erase(slot);
      last_run_[slot] = 0;
    }
    run.slots.clear();
    run.offsets.clear();
    run.message.clear();
  }
  size_ = 0;
}

}  // namespace rink::rti
