// Runs of updates that share all but object and values.
#include "rti/buffering/update_runs.h"

#include <algorithm>

#include "im/basics/checked.h"
#include "rti/wire/message.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

UpdateRun& UpdateRuns::begin(const ObjectUpdate& update) {
  if (size_ == runs_.size()) runs_.emplace_back();
  UpdateRun& run = runs_[size_++];
  run.owner = update.owner;
  run.object_class = update.object.object_class;
  run.attributes = update.attributes;
  run.stamp = update.stamp;
  run.has_residuals = false;
  UpdatesMessage header{run.object_class, run.attributes.bits};
  write(run.message, header);
  run.first_word = static_cast<std::size_t>(-1);
  run.last_word = 0;
  return run;
}

UpdateRun& UpdateRuns::run_for(const ObjectUpdate& update) {
  // Only a run after the object's last one may take its next record, or updates of one object would
  // overtake each other. Looking at the last eight runs suffices: a tick has few kinds of updates.
  const std::size_t earliest =
      std::max<std::size_t>(last_run_[update.slot], size_ > 8 ? size_ - 8 : 0);
  for (std::size_t i = size_; i > earliest; --i) {
    UpdateRun& run = runs_[i - 1];
    if (run.owner == update.owner && run.object_class == update.object.object_class &&
        run.attributes == update.attributes && run.stamp == update.stamp)
      return run;
  }
  return begin(update);
}

void UpdateRuns::append_residual(const Residual& residual, UpdateRun& run,
                                 UpdateRun::Record& record) {
  const auto append = [&run](Bytes bits) {
    const auto at = static_cast<std::uint32_t>(run.residuals.size());
    run.residuals.insert(run.residuals.end(), bits.begin(), bits.end());
    return at;
  };
  run.has_residuals = true;
  record.residual_at = append(residual.bits);
  record.residual_size = residual.size;
  record.number = residual.number;
  if (residual.companion_size == 0) return;
  record.companion_at = append(residual.companion_bits);
  record.companion_size = residual.companion_size;
  record.companion = residual.companion;
  record.companion_handle = residual.companion_object.value;
}

void UpdateRuns::append(const ObjectUpdate& update) {
  const ObjectSlot slot = update.slot;
  const std::uint32_t handle = update.object.handle.value;
  const Bytes values = update.values;
  assert(slot != no_object && update.object.handle);
  if (slot >= last_run_.size()) last_run_.resize(slot + 1);
  UpdateRun& run = run_for(update);
  assert(!run.members.contains(slot));  // at most one of each object
  last_run_[slot] = static_cast<std::uint32_t>(&run - runs_.data()) + 1;
  run.slots.push_back(slot);
  write_handle(run.message, run.records.empty() ? 0 : run.records.back().handle, handle);
  UpdateRun::Record& record = run.records.emplace_back();
  record.handle = handle;
  record.at = static_cast<std::uint32_t>(run.message.size());
  record.size = static_cast<std::uint32_t>(values.size());
  if (update.residual.size != 0) append_residual(update.residual, run, record);
  run.message.insert(run.message.end(), values.begin(), values.end());
  run.members.insert(slot);
  run.first_word = std::min<std::size_t>(run.first_word, slot / 64);
  run.last_word = std::max<std::size_t>(run.last_word, slot / 64);
}

void UpdateRuns::seal() {
  for (std::size_t i = 0; i < size_; ++i) {
    UpdateRun& run = runs_[i];
    run.message.push_back(std::byte{0});
    if (run.slots.size() <= UpdateRun::short_run) continue;
    run.record_of.resize(std::max(run.record_of.size(), last_run_.size()));
    for (std::uint32_t k = 0; k < run.slots.size(); ++k) run.record_of[run.slots[k]] = k;
  }
  if constexpr (checks_whole_structures)
    for (const UpdateRun& run : runs()) run.check();
}

void UpdateRun::check() const {
  assert(!slots.empty() && slots.size() == records.size());
  [[maybe_unused]] std::size_t member_count = 0;
  members.for_each([&](std::uint32_t) { ++member_count; });
  assert(member_count == slots.size());
  assert(first_word <= last_word && last_word < members.word_count());
  for (std::size_t i = 0; i < slots.size(); ++i) {
    assert(members.contains(slots[i]));
    assert(first_word <= slots[i] / 64 && slots[i] / 64 <= last_word);
    assert(slots.size() <= short_run || record_of[slots[i]] == i);
    // Between two records there is at least a byte of the step to the next handle.
    assert(i == 0 || records[i].at > records[i - 1].at + records[i - 1].size);
  }
  assert(std::size_t{records.back().at} + records.back().size < message.size());
}

void UpdateRuns::clear() {
  for (std::size_t i = 0; i < size_; ++i) {
    UpdateRun& run = runs_[i];
    for (const ObjectSlot slot : run.slots) {
      run.members.erase(slot);
      last_run_[slot] = 0;
    }
    run.slots.clear();
    run.records.clear();
    run.message.clear();
    run.residuals.clear();
  }
  size_ = 0;
  if constexpr (checks_whole_structures)
    assert(std::ranges::all_of(last_run_, [](std::uint32_t run) { return run == 0; }));
}

}  // namespace rink::rti
