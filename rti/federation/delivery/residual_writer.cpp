// Joins runs into groups, and cuts each group to a federate's scope.
#include "rti/federation/delivery/residual_writer.h"

#include <algorithm>
#include <cassert>

#include "rti/wire/update_block.h"

namespace rink::rti {

void ResidualWriter::begin_flush(std::span<const UpdateRun> runs) {
  runs_ = runs;
  group_count_ = 0;
  group_of_.assign(runs.size(), std::nullopt);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].has_residuals) continue;
    if (group_count_ == 0 || groups_[group_count_ - 1].end != i ||
        !joins(groups_[group_count_ - 1], runs[i])) {
      if (group_count_ == groups_.size()) groups_.emplace_back();
      Group& begun = groups_[group_count_++];
      begun.first = i;
      begun.is_all_residual = true;
      begun.places.clear();
      begun.message.clear();
    }
    add(groups_[group_count_ - 1], i);
    group_of_[i] = static_cast<std::uint32_t>(group_count_ - 1);
  }
  for (std::size_t i = 0; i < group_count_; ++i)
    if (!std::ranges::is_sorted(groups_[i].places, {}, &Place::handle))
      std::ranges::sort(groups_[i].places, {}, &Place::handle);
}

bool ResidualWriter::joins(const Group& group, const UpdateRun& run) const {
  const UpdateRun& first = runs_[group.first];
  if (run.owner != first.owner || run.object_class != first.object_class ||
      run.stamp != first.stamp)
    return false;
  for (std::size_t k = group.first; k < group.end; ++k)
    for (std::size_t i = run.first_word; i <= run.last_word; ++i)
      if ((run.members.word(i) & runs_[k].members.word(i)) != 0) return false;
  return true;
}

void ResidualWriter::add(Group& group, std::size_t index) {
  const UpdateRun& run = runs_[index];
  group.end = index + 1;
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    group.places.push_back(
        {run.records[i].handle, static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(i)});
    group.is_all_residual = group.is_all_residual && run.records[i].residual_size != 0;
  }
}

/// A federate that gets some attributes only, or some updates late, receives values in full.
bool ResidualWriter::is_eligible(const UpdateRun& run, const FederateInterest& interest) const {
  return interest.is_uniform && !interest.turns &&
         interest.by_class[run.object_class].includes(model_.kept(run.object_class));
}

bool ResidualWriter::is_whole(const Group& group, const FederateInterest& interest) const {
  if (!group.is_all_residual) return false;
  for (std::size_t k = group.first; k < group.end; ++k)
    for (std::size_t i = runs_[k].first_word; i <= runs_[k].last_word; ++i)
      if ((runs_[k].members.word(i) &
           ~(interest.in_scope.word(i) & ~interest.needs_full_state.word(i) &
             interest.holds_former.word(i))) != 0)
        return false;
  return true;
}

void ResidualWriter::choose(const Group& group, const FederateInterest& interest) {
  chosen_.clear();
  rest_.clear();
  for (const Place& place : group.places) {
    const ObjectSlot slot = runs_[place.run].slots[place.record];
    if (!interest.in_scope.contains(slot) || interest.needs_full_state.contains(slot)) continue;
    const bool is_residual = runs_[place.run].records[place.record].residual_size != 0 &&
                             interest.holds_former.contains(slot);
    (is_residual ? chosen_ : rest_).push_back(place);
  }
}

bool ResidualWriter::gather(std::size_t index, FlushContext& context) {
  assert(index < group_of_.size());
  if (!group_of_[index]) return false;
  Group& group = groups_[*group_of_[index]];
  const UpdateRun& run = runs_[index];
  if (!is_eligible(run, context.interest)) return sent_otherwise(run, context.interest), false;
  if (index != group.first) return true;  // it was sent with the first
  GatheredFrame& frame = context.frame;
  if (is_whole(group, context.interest)) {
    if (group.message.empty()) group.companions = write(group.places, group.message);
    frame.write_stamp(run.stamp);
    frame.add_shared(group.message);
    basis_.counters.updates_sent += group.places.size();
    basis_.counters.residuals_sent += group.places.size();
    basis_.counters.companions_sent += group.companions;
    return true;
  }
  choose(group, context.interest);
  if (!chosen_.empty()) {
    frame.write_stamp(run.stamp);
    basis_.counters.companions_sent += write(chosen_, frame.bytes());
  }
  basis_.counters.updates_sent += chosen_.size() + rest_.size();
  basis_.counters.residuals_sent += chosen_.size();
  if (!rest_.empty()) write_rest(context);
  return true;
}

/// Among places by handle, those whose residual refers to the update of another that is among them,
/// too.
void ResidualWriter::find_companions(std::span<const Place> places) {
  companion_of_.assign(places.size(), nobody);
  is_companion_.assign(places.size(), false);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const UpdateRun::Record& later = record(places[i]);
    if (later.companion_size == 0) continue;
    const auto found = std::ranges::lower_bound(places, later.companion_handle, {}, &Place::handle);
    if (found == places.end() || record(*found).number != later.companion) continue;
    companion_of_[static_cast<std::size_t>(found - places.begin())] = static_cast<std::uint32_t>(i);
    is_companion_[i] = true;
  }
}

std::size_t ResidualWriter::write(std::span<const Place> places, std::vector<std::byte>& bytes) {
  assert(!places.empty());
  find_companions(places);
  const UpdateRun& first = runs_[places.front().run];
  std::size_t companions = 0;
  std::uint64_t ways = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (companion_of_[i] == nobody) continue;
    ++companions;
    const std::uint32_t other = places[companion_of_[i]].handle;
    ways +=
        2 * std::uint64_t{std::max(other, places[i].handle) - std::min(other, places[i].handle)};
  }
  ResidualCursor cursor{
      model_.residual(first.object_class),
      gap_order(places.back().handle - places.front().handle, places.size() - companions),
      gap_order(ways, companions + 1)};
  bits_.clear();
  {
    BitWriter bits(bits_);
    bits.bits(cursor.order, gap_order_bits);
    bits.bits(cursor.companion_order, gap_order_bits);
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!is_companion_[i]) write_record(places, i, cursor, bits);
  }
  ResidualsMessage header{first.object_class, static_cast<std::uint32_t>(bits_.size())};
  rti::write(bytes, header);
  bytes.insert(bytes.end(), bits_.begin(), bits_.end());
  return companions;
}

void ResidualWriter::write_record(std::span<const Place> places, std::size_t index,
                                  ResidualCursor& cursor, BitWriter& bits) const {
  const auto write_one = [&](const Place& place, std::uint32_t at, std::uint32_t size) {
    AttributeSet attributes = runs_[place.run].attributes;
    exchange_attributes(bits, cursor, attributes);
    append_bits(bits, runs_[place.run].residuals, 8 * std::size_t{at}, size);
  };
  const std::uint32_t companion = companion_of_[index];
  std::uint32_t handle = places[index].handle;
  exchange_handle(bits, cursor, handle);
  bits.flag(companion != nobody);
  write_one(places[index], record(places[index]).residual_at, record(places[index]).residual_size);
  if (companion == nobody) return;
  handle = places[companion].handle;
  exchange_companion(bits, cursor, handle);
  const UpdateRun::Record& other = record(places[companion]);
  write_one(places[companion], other.companion_at, other.companion_size);
}

/// Records that have no residual, or whose basis the federate lacks: a block for each run.
void ResidualWriter::write_rest(FlushContext& context) {
  GatheredFrame& frame = context.frame;
  std::ranges::stable_sort(rest_, {}, &Place::run);
  std::optional<RecordWriter> writer;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const UpdateRun& run = runs_[rest_[i].run];
    if (i == 0 || rest_[i - 1].run != rest_[i].run) {
      writer.reset();
      frame.write_stamp(run.stamp);
      frame.enqueue(UpdatesMessage{run.object_class, run.attributes.bits});
      writer.emplace(frame.bytes());
    }
    writer->add(rest_[i].handle, run.values(rest_[i].record));
  }
}

void ResidualWriter::sent_whole(const UpdateRun& run, FederateInterest& interest) const {
  if (interest.turns) return sent_otherwise(run, interest);  // some objects may wait
  const AttributeSet kept = model_.kept(run.object_class);
  if (kept.is_empty() || !run.attributes.includes(kept)) return;
  for (std::size_t i = run.first_word; i <= run.last_word; ++i)
    interest.holds_former.insert_word(
        i, run.members.word(i) & interest.in_scope.word(i) & ~interest.needs_full_state.word(i));
}

void ResidualWriter::sent_otherwise(const UpdateRun& run, FederateInterest& interest) const {
  if ((model_.kept(run.object_class) & run.attributes).is_empty()) return;
  for (std::size_t i = run.first_word; i <= run.last_word; ++i)
    interest.holds_former.erase_word(i, run.members.word(i));
}

void ResidualWriter::passed_by(const UpdateRun& run, FederateInterest& interest) const {
  if ((model_.kept(run.object_class) & run.attributes).is_empty()) return;
  for (std::size_t i = run.first_word; i <= run.last_word; ++i)
    interest.holds_former.erase_word(
        i, run.members.word(i) & (~interest.in_scope.word(i) | interest.needs_full_state.word(i)));
}

void ResidualWriter::sent_full_state(ObjectSlot slot, AttributeSet set,
                                     FederateInterest& interest) const {
  const Object& object = basis_.objects[slot];
  const AttributeSet kept = model_.kept(object.object_class);
  if (kept.is_empty()) return;
  if (set.includes(kept & object.valued)) interest.holds_former.insert(slot);
  else interest.holds_former.erase(slot);
}

}  // namespace rink::rti
