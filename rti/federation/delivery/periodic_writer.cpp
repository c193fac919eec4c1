// Writes differences to the keyframes that each federate has acknowledged.
#include "rti/federation/delivery/periodic_writer.h"

#include <bit>
#include <cassert>

#include "rti/wire/baseline_messages.h"

namespace rink::rti {

namespace {

/// Which of a run's records go to a federate, 64 slots at a time.
class Wanted {
 public:
  Wanted(const UpdateRun& run, const FederateInterest& interest)
      : run_(run), interest_(interest), reflected_(interest.reflected()) {}

  std::uint64_t word(std::size_t i) const {
    std::uint64_t bits =
        run_.members.word(i) & reflected_.word(i) & ~interest_.needs_full_state.word(i);
    if (interest_.is_uniform)
      return (interest_.by_class[run_.object_class] & run_.attributes).is_empty() ? 0 : bits;
    for (std::uint64_t left = bits; left != 0; left &= left - 1) {
      const auto bit = static_cast<unsigned>(std::countr_zero(left));
      const auto slot = static_cast<ObjectSlot>(i * 64 + bit);
      if ((interest_.attributes_in_scope(slot, run_.object_class) & run_.attributes).is_empty())
        bits &= ~(std::uint64_t{1} << bit);
    }
    return bits;
  }
  bool is_all() const {
    for (std::size_t i = run_.first_word; i <= run_.last_word; ++i)
      if (word(i) != run_.members.word(i)) return false;
    return true;
  }
  /// Calls `visit(index of the record)` for each.
  template <class Visit>
  void for_each(Visit visit) const {
    if (run_.slots.size() <= UpdateRun::short_run) {
      for (std::size_t k = 0; k < run_.slots.size(); ++k)
        if ((word(run_.slots[k] / 64) >> run_.slots[k] % 64 & 1u) != 0) visit(k);
      return;
    }
    for (std::size_t i = run_.first_word; i <= run_.last_word; ++i)
      for (std::uint64_t bits = word(i); bits != 0; bits &= bits - 1)
        visit(run_.record_of[i * 64 + static_cast<std::size_t>(std::countr_zero(bits))]);
  }

 private:
  const UpdateRun& run_;
  const FederateInterest& interest_;
  const Bitmap& reflected_;
};

}  // namespace

void PeriodicWriter::gather(std::size_t index, FlushContext& context) {
  assert(index < context.runs.size());
  const UpdateRun& run = context.runs[index];
  const std::uint32_t slot = context.slot;
  const Wanted wanted(run, context.interest);
  const DeltaBlock& block = baselines_.block(run, index, slot);
  bool is_any = false, knows_all = true;
  for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
    const std::uint64_t bits = wanted.word(i);
    if (bits == 0) continue;
    if (!is_any && baselines_.keyframe()) begin_keyframe(run.stamp, context.frame);
    is_any = true;
    knows_all = knows_all && (block.differences.word(i) & bits & ~baselines_.known(slot, i)) == 0;
    if (baselines_.keyframe()) baselines_.note_sent(slot, i, bits);
  }
  if (!is_any) return;
  context.frame.write_whole_stamp(run.stamp);
  if (!knows_all || !wanted.is_all()) return cut(run, block, context);
  ++baselines_.counters().blocks_shared;
  count(block.records.size(), block.difference_count);
  context.frame.add_shared(block.message);
}

/// The records in the federate's interest, bit by bit; those whose baseline it lacks are absolute.
void PeriodicWriter::cut(const UpdateRun& run, const DeltaBlock& block, FlushContext& context) {
  assert(block.records.size() == run.records.size());
  const std::uint32_t slot = context.slot;
  context.frame.enqueue(DeltasMessage{run.object_class});
  BitWriter bits(context.frame.bytes());
  DeltaHeader header = block.header;
  exchange(bits, header, baselines_.codec(block.run).fields().size());
  std::uint32_t previous = 0;
  std::size_t records = 0, differences = 0;
  Wanted(run, context.interest).for_each([&](std::size_t index) {
    write_handle(bits, previous, run.records[index].handle);
    previous = run.records[index].handle;
    const DeltaBlock::Record& record = block.records[index];
    const bool is_known =
        (baselines_.known(slot, run.slots[index] / 64) >> run.slots[index] % 64 & 1u) != 0;
    if (record.is_difference && !is_known) baselines_.append_absolute(bits, run, block.run, index);
    else append_bits(bits, block.message, record.at, record.size);
    ++records;
    differences += record.is_difference && is_known ? 1 : 0;
  });
  write_end(bits);
  count(records, differences);
}

void PeriodicWriter::count(std::size_t records, std::size_t differences) {
  assert(differences <= records);
  basis_.counters.updates_sent += records;
  baselines_.counters().differences_sent += differences;
  baselines_.counters().absolutes_sent += records - differences;
}

void PeriodicWriter::begin_keyframe(const Stamp& stamp, GatheredFrame& frame) {
  if (!frame.begins_keyframe()) return;
  frame.write_whole_stamp(stamp);
  frame.enqueue(BeginKeyframeMessage{*baselines_.keyframe()});
}

Status PeriodicWriter::handle_acknowledgement(std::uint32_t slot, Reader& reader) {
  AcknowledgeKeyframeMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  baselines_.acknowledge(slot, message.number);
  return std::nullopt;
}

Status PeriodicWriter::handle_refusal(std::uint32_t slot, Reader& reader) {
  RefuseKeyframeMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  baselines_.refuse(slot);
  return std::nullopt;
}

}  // namespace rink::rti
