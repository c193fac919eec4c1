// Who is in scope and not told of yet, for his tier's turn has not come or his subscriber's budget
// is spent: what becomes late of him, and when it is told.
#include <bit>

#include "rti/federation/federation_parts.h"
#include "rti/wire/updates_block.h"

namespace rink::rti {

/// Decides for the flush at hand. Of whom it is the turn, that goes out by this flush's updates if
/// they say all that is late of him, so that it is shared, goes by datagram or as a difference like
/// anybody's; else by `catch_up`.
void FederationParts::take_turns(FlushContext& context) {
  const std::uint32_t slot = context.slot;
  FederateInterest& interest = context.interest;
  Turns& turns = *interest.turns;
  interest_.take_turns(slot);
  note_late(context, turns);
  if (interest_.has_budget())
    interest_.share_out(slot, [this, slot](ObjectSlot object) { return bytes_due(slot, object); });
  turns.caught_up.clear();
  turns.heard.clear();
  const auto is_due = [&](std::size_t i) {
    return turns.late.any(i) & interest.in_scope.word(i) & ~turns.waiting.word(i) &
           ~interest.fresh.word(i);
  };
  for (std::size_t i = 0; i < turns.late.word_count(); ++i)
    turns.caught_up.insert_word(i, is_due(i));
  for (const UpdateRun& run : context.runs) {
    if (run.owner == slot) continue;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t members = run.members.word(i);
      turns.caught_up.erase_word(i, members & ~turns.late.beyond(i, run.attributes));
      counters_.updates_put_off += static_cast<std::uint64_t>(std::popcount(
          members & interest.in_scope.word(i) & turns.waiting.word(i) & ~interest.fresh.word(i)));
    }
  }
  for (std::size_t i = 0; i < interest.in_scope.word_count(); ++i) {
    turns.heard.insert_word(
        i, interest.in_scope.word(i) & ~turns.waiting.word(i) & ~turns.caught_up.word(i));
    turns.late.told(i, is_due(i) & ~turns.caught_up.word(i));
  }
}

/// Of those who wait, or did so: what this flush's updates say becomes late; under a budget of all,
/// for who waits is not known yet. What was late of whom is out of scope is forgotten: if he comes
/// back he is told of whole.
void FederationParts::note_late(const FlushContext& context, Turns& turns) {
  const FederateInterest& interest = context.interest;
  for (std::size_t i = 0; i < turns.late.word_count(); ++i)
    if (const std::uint64_t gone = turns.late.any(i) & ~interest.in_scope.word(i); gone != 0)
      turns.late.told(i, gone);
  const bool has_budget = interest_.has_budget();
  for (const UpdateRun& run : context.runs) {
    if (run.owner == context.slot ||
        (interest.is_uniform && (interest.by_class[run.object_class] & run.attributes).is_empty()))
      continue;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t heard =
          run.members.word(i) & interest.in_scope.word(i) & ~interest.fresh.word(i);
      turns.late.put_off(i,
                         has_budget ? heard : heard & (turns.waiting.word(i) | turns.late.any(i)),
                         run.attributes);
    }
  }
}

/// What telling of `object` takes now; its state on entry whole.
std::size_t FederationParts::bytes_due(std::uint32_t slot, ObjectSlot object) const {
  constexpr std::size_t handle_bytes = 2;  // a step to the next handle, mostly
  const FederateInterest& interest = interest_.of(slot);
  const bool is_fresh = interest.fresh.contains(object);
  const AttributeSet told =
      interest.told(object, objects_[object].object_class) & objects_[object].valued;
  const AttributeSet set = is_fresh ? told : told & interest.turns->late.of(object);
  return set.is_empty() ? (is_fresh ? 1 : 0) : handle_bytes + objects_.size_of(object, set);
}

/// The newest state of whom has waited, as far as it is late.
void FederationParts::catch_up(FlushContext& context) {
  const FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  Turns& turns = *interest.turns;
  const std::size_t before = frame.size();
  std::optional<UpdatesBlock> block;
  turns.caught_up.for_each([&](ObjectSlot late) {
    const Object& object = objects_[late];
    const AttributeSet set = object.is_alive ? interest.told(late, object.object_class) &
                                                   object.valued & turns.late.of(late)
                                             : AttributeSet();
    turns.late.told(late);
    if (set.is_empty()) return;
    const Stamp stamp = newest_.of(late);
    if (!block || !frame.is_stamped(stamp)) {
      block.reset();
      frame.write_stamp(stamp);
      block.emplace(frame.bytes());
    }
    block->append(object.object_class, set, object.handle,
                  [&] { objects_.append(late, set, frame.bytes()); });
    ++counters_.updates_sent;
    ++counters_.updates_caught_up;
  });
  block.reset();
  counters_.update_bytes_sent += frame.size() - before;
}

}  // namespace rink::rti
