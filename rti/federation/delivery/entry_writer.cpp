// Object by object, in the order of their slots.
#include "rti/federation/delivery/entry_writer.h"

#include <algorithm>

namespace rink::rti {

void EntryWriter::write(FlushContext& context, std::size_t end) {
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  if (!interest.needs_any_full_state) return;
  bool is_whole = !interest.has_unannounced;
  const std::size_t before = frame.size();
  {
    Blocks blocks{std::nullopt, {frame.bytes(), context.federate.entry_header}};
    interest.sent_to = interest.needs_full_state.visit_from(interest.sent_to, [&](ObjectSlot due) {
      if (interest.unannounced.contains(due) || std::ranges::binary_search(interest.sent_now, due))
        return true;
      if (frame.size() + uses_.announcements.gathered_bytes_max() >= end) {
        is_whole = false;
        return false;
      }
      if (interest.turns && interest.turns->waiting.contains(due)) {
        is_whole = false;
        return true;
      }
      context.full_state_sent.push_back(due);
      const Due state = state_due(context.interest, due);
      if (state.attributes.is_empty()) return true;
      const Stamp stamp = uses_.newest.of(due);
      if (!frame.is_stamped(stamp)) {
        blocks.close();
        frame.write_stamp(stamp);
      }
      write_state(context, state, blocks);
      ++basis_.counters.updates_sent;
      return true;
    });
  }
  context.is_all_sent = is_whole;
  basis_.counters.entry_bytes_sent += frame.size() - before;
}

/// Notes that the federate is sent it. Static values that it has are not due again.
EntryWriter::Due EntryWriter::state_due(FederateInterest& interest, ObjectSlot slot) {
  const Object& object = basis_.objects[slot];
  if (!object.is_alive || object.object_class == interest.host_served) return {};
  const AttributeSet in_scope =
      interest.attributes_in_scope(slot, object.object_class) & object.valued;
  Due due{slot, in_scope, in_scope, false};
  due.is_held = interest.holds_former.contains(slot) && uses_.states.holds(object, slot, in_scope);
  uses_.residuals.sent_full_state(slot, in_scope, interest);
  const AttributeSet statics = basis_.objects.settled_static(slot);
  if (interest.holds_static.contains(slot)) due.attributes = in_scope.without(statics);
  else if (!statics.is_empty() && in_scope.includes(statics)) interest.holds_static.insert(slot);
  return due;
}

/// A record has limited room: what does not fit is an update, or several.
void EntryWriter::write_state(FlushContext& context, Due due, Blocks& blocks) {
  const AttributeSet all = due.attributes;
  for (AttributeSet left = all; !left.is_empty(); left = left.without(due.attributes)) {
    due.attributes = fitting(due.slot, left);
    if (due.attributes != all) due.in_scope = due.attributes, due.is_held = false;
    if (uses_.announcements.is_gathered(due.slot)) write_entry(context, due, blocks);
    else write_update(context, due, blocks);
  }
}

/// The first of `set` whose values one record has room for.
AttributeSet EntryWriter::fitting(ObjectSlot object, AttributeSet set) const {
  if (basis_.objects.size_of(object, set) <= values_max) return set;
  AttributeSet first;
  std::size_t size = 0;
  for (const AttributeHandle each : set) {
    size += basis_.objects.size_of(object, {each});
    if (!first.is_empty() && size > values_max) break;
    first.insert(each);
  }
  return first;
}

void EntryWriter::write_update(FlushContext& context, const Due& due, Blocks& blocks) {
  const Object& object = basis_.objects[due.slot];
  std::vector<std::byte>& bytes = context.frame.bytes();
  blocks.entries.close();
  if (!blocks.updates) blocks.updates.emplace(bytes);
  blocks.updates->append(object.object_class, due.attributes, object.handle,
                         [&] { basis_.objects.append(due.slot, due.attributes, bytes); });
}

/// Static values that the federate has and the last entry had are named again: blocks of entries of
/// one class then have one header.
void EntryWriter::write_entry(FlushContext& context, const Due& due, Blocks& blocks) {
  const Object& object = basis_.objects[due.slot];
  std::vector<std::byte>& bytes = context.frame.bytes();
  EntryValues& last = context.federate.entry_values;
  blocks.updates.reset();
  const bool is_discovered = uses_.announcements.take(due.slot);
  if (!is_discovered && due.is_held) {
    const EntryHeader& header = context.federate.entry_header;
    const bool is_like_last = header && header->object_class == object.object_class &&
                              header->attributes == due.in_scope.bits;
    blocks.entries.append(
        is_like_last ? *header : EntriesMessage{object.object_class, due.in_scope.bits, 0},
        object.handle.value, EntryForm::held, [] {});
    ++basis_.counters.entries_held;
    return;
  }
  AttributeSet again = repeated(last, due.slot, due.in_scope), set = due.in_scope;
  if (!again.includes(set.without(due.attributes)) ||
      basis_.objects.size_of(due.slot, set) > values_max)
    set = due.attributes, again = again & set;
  const AttributeSet former = recalled(last, due.slot, set.without(again));
  blocks.entries.append(
      {object.object_class, set.bits, again.bits, former.bits}, object.handle.value,
      is_discovered ? EntryForm::discovered : EntryForm::known, [&] {
        for (const AttributeHandle each : set.without(again)) {
          const Bytes value = basis_.objects.value(due.slot, each);
          if (former.contains(each)) {
            const std::uint8_t number = *last.former(object.object_class, each, value);
            last.recall(object.object_class, each, number);
            bytes.push_back(std::byte{number});
            continue;
          }
          last.note(object.object_class, each, value);
          bytes.insert(bytes.end(), value.begin(), value.end());
        }
      });
}

AttributeSet EntryWriter::recalled(const EntryValues& last, ObjectSlot object,
                                   AttributeSet set) const {
  const AttributeSet statics = set & basis_.objects.settled_static(object);
  const std::uint16_t object_class = basis_.objects[object].object_class;
  AttributeSet former;
  for (const AttributeHandle each : statics)
    if (last.former(object_class, each, basis_.objects.value(object, each))) former.insert(each);
  return former;
}

AttributeSet EntryWriter::repeated(const EntryValues& last, ObjectSlot object,
                                   AttributeSet set) const {
  const std::uint16_t object_class = basis_.objects[object].object_class;
  AttributeSet again;
  for (const AttributeHandle each : set)
    if (last.repeats(object_class, each, basis_.objects.value(object, each))) again.insert(each);
  return again;
}

}  // namespace rink::rti
