// Applies turns to 64 objects at a time.
#include "rti/federation/delivery/turn_writer.h"

#include <bit>
#include <cassert>
#include <optional>

#include "rti/wire/updates_block.h"

namespace rink::rti {

void TurnWriter::apply_turns(FlushContext& context) {
  const std::uint32_t slot = context.slot;
  FederateInterest& interest = context.interest;
  assert(interest.turns);
  Turns& turns = *interest.turns;
  distribution_.plan_turns(slot);
  note_late(context, turns);
  if (distribution_.has_budget())
    distribution_.share_out(slot,
                            [this, slot](ObjectSlot object) { return bytes_due(slot, object); });
  turns.caught_up.clear();
  turns.reflected.clear();
  const auto is_due = [&](std::size_t i) {
    return turns.late.any(i) & interest.in_scope.word(i) & ~turns.waiting.word(i) &
           ~interest.needs_full_state.word(i);
  };
  for (std::size_t i = 0; i < turns.late.word_count(); ++i)
    turns.caught_up.insert_word(i, is_due(i));
  for (const UpdateRun& run : context.runs) {
    if (run.owner == slot) continue;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t members = run.members.word(i);
      turns.caught_up.erase_word(i, members & ~turns.late.beyond(i, run.attributes));
      basis_.counters.updates_put_off += static_cast<std::uint64_t>(
          std::popcount(members & interest.in_scope.word(i) & turns.waiting.word(i) &
                        ~interest.needs_full_state.word(i)));
    }
  }
  for (std::size_t i = 0; i < interest.in_scope.word_count(); ++i) {
    turns.reflected.insert_word(
        i, interest.in_scope.word(i) & ~turns.waiting.word(i) & ~turns.caught_up.word(i));
    turns.late.sent(i, is_due(i) & ~turns.caught_up.word(i));
  }
}

/// Marks this flush's updates of objects that wait or waited as late; under a budget those of all
/// objects, since it is not known yet which wait. Late attributes of objects out of scope are
/// forgotten: an object that comes back changed is sent in full.
void TurnWriter::note_late(const FlushContext& context, Turns& turns) {
  const FederateInterest& interest = context.interest;
  for (std::size_t i = 0; i < turns.late.word_count(); ++i)
    if (const std::uint64_t gone = turns.late.any(i) & ~interest.in_scope.word(i); gone != 0)
      turns.late.sent(i, gone);
  const bool has_budget = distribution_.has_budget();
  for (const UpdateRun& run : context.runs) {
    if (run.owner == context.slot ||
        (interest.is_uniform && (interest.by_class[run.object_class] & run.attributes).is_empty()))
      continue;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t due_of_run =
          run.members.word(i) & interest.in_scope.word(i) & ~interest.needs_full_state.word(i);
      turns.late.put_off(
          i, has_budget ? due_of_run : due_of_run & (turns.waiting.word(i) | turns.late.any(i)),
          run.attributes);
    }
  }
}

/// The bytes that sending `object` takes now; its full state if that is due.
std::size_t TurnWriter::bytes_due(std::uint32_t slot, ObjectSlot object) const {
  constexpr std::size_t handle_bytes = 2;  // a step to the next handle, mostly
  const FederateInterest& interest = distribution_.of(slot);
  const bool needs_full_state = interest.needs_full_state.contains(object);
  const AttributeSet in_scope_now =
      interest.attributes_in_scope(object, basis_.objects[object].object_class) &
      basis_.objects[object].valued;
  const AttributeSet set =
      needs_full_state ? in_scope_now : in_scope_now & interest.turns->late.of(object);
  return set.is_empty() ? (needs_full_state ? 1 : 0)
                        : handle_bytes + basis_.objects.size_of(object, set);
}

void TurnWriter::catch_up(FlushContext& context) {
  const FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  assert(interest.turns);
  Turns& turns = *interest.turns;
  const std::size_t before = frame.size();
  std::optional<UpdatesBlock> block;
  turns.caught_up.for_each([&](ObjectSlot late) {
    const Object& object = basis_.objects[late];
    const AttributeSet set = object.is_alive
                                 ? interest.attributes_in_scope(late, object.object_class) &
                                       object.valued & turns.late.of(late)
                                 : AttributeSet();
    turns.late.sent(late);
    if (set.is_empty()) return;
    const Stamp stamp = newest_.of(late);
    if (!block || !frame.is_stamped(stamp)) {
      block.reset();
      frame.write_stamp(stamp);
      block.emplace(frame.bytes());
    }
    block->append(object.object_class, set, object.handle,
                  [&] { basis_.objects.append(late, set, frame.bytes()); });
    ++basis_.counters.updates_sent;
    ++basis_.counters.updates_caught_up;
  });
  block.reset();
  basis_.counters.update_bytes_sent += frame.size() - before;
}

}  // namespace rink::rti
