// Discoveries and changes of scope, in the order in which the matches found them.
#include "rti/federation/delivery/announcements.h"

#include <algorithm>
#include <cassert>
#include <functional>

namespace rink::rti {

namespace {

template <class Message>
void enqueue(std::vector<std::byte>& bytes, Message message) {
  write(bytes, message);
}

}  // namespace

void Announcements::write(FlushContext& context, std::size_t end) {
  assert(std::ranges::is_sorted(context.interest.sent_now));  // they are looked up
  assert(gathered_ == 0);
  const std::size_t before = context.frame.size();
  const std::vector<ScopeEvent>& events = context.interest.events;
  block_.close();
  if (context.interest.has_unannounced_exits) write_postponed_exits(context);
  if (context.interest.has_unannounced) write_postponed(context, end);
  // Of one match each object has at most one change: exits first make two blocks of many.
  const bool is_one_match = std::ranges::adjacent_find(events, std::ranges::greater_equal{},
                                                       &ScopeEvent::slot) == events.end();
  const auto write_all = [&](auto is_wanted) {
    for (const ScopeEvent& event : events)
      if (is_wanted(event)) write_event(context, event, end);
  };
  const auto is_exit = [](const ScopeEvent& each) {
    return each.transition == im::Transition::left;
  };
  if (is_one_match) {
    write_all(is_exit);
    write_all(std::not_fn(is_exit));
  } else {
    write_all([](const ScopeEvent&) { return true; });
  }
  basis_.counters.scope_bytes_sent += context.frame.size() - before;
}

void Announcements::postpone(FederateInterest& interest) {
  for (const ScopeEvent& event : interest.events) {
    const Object& object = basis_.objects[event.slot];
    if (!object.is_alive || object.object_class == interest.host_served) continue;
    const bool is_exit = event.transition == im::Transition::left;
    Bitmap& opposite = is_exit ? interest.unannounced : interest.unannounced_exits;
    if (opposite.contains(event.slot)) {
      opposite.erase(event.slot);
    } else if (!is_exit) {
      interest.unannounced.insert(event.slot);
      interest.has_unannounced = true;
    } else if (interest.known.contains(event.slot)) {
      interest.unannounced_exits.insert(event.slot);
      interest.has_unannounced_exits = true;
    }
  }
  interest.events.clear();
}

void Announcements::write_postponed_exits(FlushContext& context) {
  FederateInterest& interest = context.interest;
  interest.unannounced_exits.for_each([&](ObjectSlot object) {
    if (basis_.objects[object].object_class != interest.host_served)
      block_.append(context.frame.bytes(), OutOfScopeMessage{},
                    basis_.objects[object].handle.value);
  });
  interest.unannounced_exits.clear();
  interest.has_unannounced_exits = false;
}

void Announcements::write_postponed(FlushContext& context, std::size_t end) {
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  interest.announced_to =
      interest.unannounced.visit_from(interest.announced_to, [&](ObjectSlot object) {
        if (frame.size() + gathered_bytes_max() >= end) return false;
        if (is_too_late(interest, object)) interest.unannounced.erase(object);
        else gather(context, object);
        return true;
      });
  interest.has_unannounced = frame.size() + gathered_bytes_max() >= end;
}

void Announcements::write_event(FlushContext& context, const ScopeEvent& event, std::size_t end) {
  FederateInterest& interest = context.interest;
  const Object& object = basis_.objects[event.slot];
  if (!object.is_alive || std::ranges::binary_search(interest.sent_now, event.slot))
    return;  // it entered and left between two flushes, or its removal is under way
  if (object.object_class == interest.host_served) return;
  if (is_too_late(interest, event.slot)) return interest.unannounced.erase(event.slot);
  if (event.transition == im::Transition::left) {
    if (is_gathered(event.slot)) put_gathered(context.frame);
    if (interest.unannounced.contains(event.slot)) interest.unannounced.erase(event.slot);
    else if (interest.known.contains(event.slot))
      block_.append(context.frame.bytes(), OutOfScopeMessage{}, object.handle.value);
  } else if (context.frame.size() + gathered_bytes_max() < end) {
    gather(context, event.slot);
  } else {
    interest.unannounced.insert(event.slot);
    interest.has_unannounced = true;
    ++basis_.counters.entries_postponed;
  }
}

bool Announcements::introduce(std::uint32_t slot, ObjectSlot at, std::vector<std::byte>& bytes) {
  FederateInterest& interest = uses_.distribution.of(slot);
  const Object& object = basis_.objects[at];
  assert(object.is_alive);
  const bool is_known = interest.known.contains(at);
  if (!is_known) {
    if (!object.name.empty())
      enqueue(bytes, DiscoverObjectMessage{object.handle.value, object.object_class, object.name});
    ++basis_.federates[slot].objects_discovered;
    uses_.requests.discovered(slot, at, interest.attributes_in_scope(at, object.object_class));
    uses_.owners.discovered(slot, at);
    interest.holds_static.erase(at);
    interest.holds_former.erase(at);
  }
  interest.known.insert(at);
  interest.unannounced.erase(at);
  interest.unannounced_exits.erase(at);
  return !is_known && object.name.empty();
}

void Announcements::gather(FlushContext& context, ObjectSlot object) {
  if (introduce(context.slot, object, context.frame.bytes())) undiscovered_.insert(object);
  entering_.insert(object);
  ++gathered_;
}

bool Announcements::take(ObjectSlot object) {
  assert(is_gathered(object));
  const bool is_discovered = undiscovered_.contains(object);
  entering_.erase(object);
  undiscovered_.erase(object);
  --gathered_;
  return is_discovered;
}

void Announcements::write_gathered(FlushContext& context) {
  const std::size_t before = context.frame.size();
  put_gathered(context.frame);
  basis_.counters.scope_bytes_sent += context.frame.size() - before;
}

void Announcements::put_gathered(GatheredFrame& frame) {
  if (gathered_ == 0) return;
  entering_.for_each([&](ObjectSlot each) {
    const Object& object = basis_.objects[each];
    if (take(each))
      enqueue(frame.bytes(), DiscoverObjectMessage{object.handle.value, object.object_class, {}});
    block_.append(frame.bytes(), InScopeMessage{}, object.handle.value);
  });
}

void Announcements::send_state_now(std::uint32_t slot, ObjectSlot object) {
  FederateInterest& interest = uses_.distribution.of(slot);
  const Object& of = basis_.objects[object];
  std::vector<std::byte>& bytes = basis_.federates[slot].outbox.head();
  if (introduce(slot, object, bytes))
    enqueue(bytes, DiscoverObjectMessage{of.handle.value, of.object_class, {}});
  ObjectBlockWriter().append(bytes, InScopeMessage{}, of.handle.value);
  uses_.owners.send_state(slot, object, uses_.newest.of(object));
  interest.needs_full_state.erase(object);
  interest.holds_former.erase(object);
  interest.needs_any_full_state = true;
  interest.sent_now.push_back(object);
}

}  // namespace rink::rti
