// What goes out: one gathered write per destination, shared blocks without a copy.
#include <algorithm>
#include <bit>

#include "rti/buffering/run_scope.h"
#include "rti/federation/federation_parts.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/update_block.h"
#include "rti/wire/updates_block.h"

namespace rink::rti {

namespace {

/// Every cache line of it.
template <class Value>
void fetch(const Value& value) {
  for (std::size_t at = 0; at < sizeof value; at += 64)
    __builtin_prefetch(reinterpret_cast<const char*>(&value) + at);
}

}  // namespace

void FederationParts::flush(Outlet& outlet) {
  send_answers(outlet);
  update_requests_.settle();
  const std::span<const UpdateRun> runs = buffering_->seal();
  baselines_.begin(runs, federates_.size());
  best_effort_sender_.begin_flush();
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    look_ahead(slot);
    if (!federates_[slot].is_joined) continue;
    told_whole_.clear();
    FlushContext context{slot, federates_[slot], interest_.of(slot), runs, frame_, told_whole_};
    flush_federate(context, outlet);
  }
  baselines_.end();
  update_requests_.flushed();
  interactions_.flushed();
  buffering_->clear();
  objects_.recycle();
  for (const Farewell& each : farewells_) {
    const Bytes bytes = each.bytes;
    if (!bytes.empty()) outlet.send(each.connection, std::span(&bytes, 1));
    outlet.drop(each.connection, each.why);
  }
  farewells_.clear();
}

/// What a flush needs of a federate has left the cache since the last one if there are many: what
/// the next ones need is fetched meanwhile, in the order in which one leads to the other.
void FederationParts::look_ahead(std::uint32_t slot) {
  if (slot + 3 < federates_.size()) fetch(federates_[slot + 3]);
  if (slot + 2 < federates_.size() && federates_[slot + 2].is_joined) {
    fetch(interest_.of(slot + 2));
    if (federates_[slot + 2].way) fetch(*federates_[slot + 2].way);
  }
  if (slot + 1 < federates_.size() && federates_[slot + 1].is_joined) {
    const FederateInterest& interest = interest_.of(slot + 1);
    __builtin_prefetch(interest.by_class.data());
    interest.in_scope.prefetch();
  }
}

void FederationParts::flush_federate(FlushContext& context, Outlet& outlet) {
  JoinedFederate& federate = context.federate;
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  const std::uint64_t before = counters_.updates_sent;
  frame.begin();
  std::ranges::sort(interest.pressing);
  for (const ObjectSlot each : interest.pressing)
    interest.fresh.insert(each);  // what this flush's runs say of them is part of what was told
  context.channel = best_effort_sender_.begin(federate, outlet);
  best_effort_receiver_.acknowledge(context.slot, outlet);
  frame.append(federate.outbox.head());
  tell(context, outlet);
  federate.counts.reflections_received += counters_.updates_sent - before;
  frame.append(federate.outbox.tail());
  federate.outbox.clear();
  settle_interest(context);
  if (frame.is_empty()) {
    if (now_ - federate.last_said < settings_.patience.heartbeat_s) return;
    frame.say(HeartbeatMessage{});
  }
  send_frame(federate, outlet);
}

/// Who is in scope, and what is new of them.
void FederationParts::tell(FlushContext& context, Outlet& outlet) {
  FederateInterest& interest = context.interest;
  const std::size_t entry_end = context.frame.size() + entry_room(context, outlet);
  write_scope_events(context, entry_end);
  if (holds_back(context, outlet)) return hold_back(context);
  if (interest.turns) take_turns(context);
  write_fresh_states(context, entry_end);
  if (interest.turns) catch_up(context);
  if (context.federate.way && !context.federate.way->due.empty()) write_due_states(context);
  gather_runs(context);
  best_effort_sender_.send(context, outlet);
}

/// What was told whole is fresh no longer; not before, for its updates in this flush are part of
/// what was told.
void FederationParts::settle_interest(FlushContext& context) {
  FederateInterest& interest = context.interest;
  interest.events.clear();
  if (context.is_all_told) interest.has_fresh = false;
  for (const ObjectSlot told : interest.pressing) interest.fresh.erase(told);
  interest.pressing.clear();
  for (const ObjectSlot told : context.told_whole) {
    interest.fresh.erase(told);
    if (interest.turns) interest.turns->late.told(told);
  }
}

/// Who comes into a large world would be closed for a queue that no reader empties in one tick:
/// what does not fit is told by the next flushes.
std::size_t FederationParts::entry_room(const FlushContext& context, const Outlet& outlet) const {
  const FederateInterest& interest = context.interest;
  if (interest.events.empty() && !interest.has_fresh && !interest.has_unannounced) return 0;
  return settings_.entry_bytes_per_flush_max -
         std::min(settings_.entry_bytes_per_flush_max,
                  outlet.waiting_bytes(context.federate.connection));
}

/// Up to `end` bytes in the frame.
void FederationParts::write_scope_events(FlushContext& context, std::size_t end) {
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  const std::size_t before = frame.size();
  const auto is_too_late = [&](ObjectSlot object) {
    return objects_[object].is_leaving && !interest.known.contains(object);
  };  // nobody discovers it any more
  if (interest.has_unannounced) {
    interest.announced_to =
        interest.unannounced.visit_from(interest.announced_to, [&](ObjectSlot object) {
          if (frame.size() >= end) return false;
          if (is_too_late(object)) interest.unannounced.erase(object);
          else announce(context.slot, object, frame.bytes());
          return true;
        });
    interest.has_unannounced = frame.size() >= end;
  }
  for (const ScopeEvent& event : interest.events) {
    const Object& object = objects_[event.slot];
    if (!object.is_alive || std::ranges::binary_search(interest.pressing, event.slot))
      continue;  // it came and went between two flushes, or its removal is on its way
    if (is_too_late(event.slot)) {
      interest.unannounced.erase(event.slot);
      continue;
    }
    if (event.transition == im::Transition::left) {
      if (interest.unannounced.contains(event.slot)) interest.unannounced.erase(event.slot);
      else if (interest.known.contains(event.slot))
        frame.say(OutOfScopeMessage{object.handle.value});
    } else if (frame.size() < end) {
      announce(context.slot, event.slot, frame.bytes());
    } else {
      interest.unannounced.insert(event.slot);
      interest.has_unannounced = true;
      ++counters_.entries_postponed;
    }
  }
  counters_.scope_bytes_sent += frame.size() - before;
}

void FederationParts::announce(std::uint32_t slot, ObjectSlot at, std::vector<std::byte>& bytes) {
  FederateInterest& interest = interest_.of(slot);
  const Object& object = objects_[at];
  if (!interest.known.contains(at)) {
    say(bytes, DiscoverObjectMessage{object.handle.value, object.object_class, object.name});
    ++federates_[slot].objects_discovered;
    update_requests_.discovered(slot, at, interest.told(at, object.object_class));
    owners_.discovered(slot, at);
  }
  interest.known.insert(at);
  interest.unannounced.erase(at);
  say(bytes, InScopeMessage{object.handle.value});
}

/// A message in time-stamp order is about to speak of it: it is announced, and its state told,
/// before all else that this flush says.
void FederationParts::press(std::uint32_t slot, ObjectSlot object) {
  FederateInterest& interest = interest_.of(slot);
  announce(slot, object, federates_[slot].outbox.head());
  owners_.say_state(slot, object, newest_.of(object));
  interest.fresh.erase(object);
  interest.has_fresh = true;
  interest.pressing.push_back(object);
}

/// Up to `end` bytes in the frame. Their stamp is their owner's newest, not that of the update
/// which said it: what they are was not changed until then.
void FederationParts::write_fresh_states(FlushContext& context, std::size_t end) {
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  if (!interest.has_fresh) return;
  bool is_whole = !interest.has_unannounced;
  const std::size_t before = frame.size();
  std::optional<UpdatesBlock> block;
  interest.told_to = interest.fresh.visit_from(interest.told_to, [&](ObjectSlot fresh) {
    if (interest.unannounced.contains(fresh) ||
        std::ranges::binary_search(interest.pressing, fresh))
      return true;
    if (frame.size() >= end) {
      is_whole = false;
      return false;
    }
    if (interest.turns && interest.turns->waiting.contains(fresh)) {
      is_whole = false;
      return true;
    }
    context.told_whole.push_back(fresh);
    const Object& object = objects_[fresh];
    if (!object.is_alive) return true;
    const AttributeSet set = interest.told(fresh, object.object_class) & object.valued;
    if (set.is_empty()) return true;
    const Stamp stamp = newest_.of(fresh);
    if (!block || !frame.is_stamped(stamp)) {
      block.reset();
      frame.write_stamp(stamp);
      block.emplace(frame.bytes());
    }
    block->append(object.object_class, set, object.handle,
                  [&] { objects_.append(fresh, set, frame.bytes()); });
    ++counters_.updates_sent;
    return true;
  });
  block.reset();
  context.is_all_told = is_whole;
  counters_.entry_bytes_sent += frame.size() - before;
}

bool FederationParts::holds_back(const FlushContext& context, const Outlet& outlet) {
  if (context.runs.empty() && !context.interest.has_fresh) return false;
  return buffering_->holds_back(context.slot, outlet.waiting_bytes(context.federate.connection));
}

/// What it would have heard of becomes due whole, as if it had come into scope: the newest state,
/// once, however many updates there were.
void FederationParts::hold_back(FlushContext& context) {
  FederateInterest& interest = context.interest;
  for (const UpdateRun& run : context.runs) {
    if (run.owner == context.slot ||
        (interest.is_uniform && (interest.by_class[run.object_class] & run.attributes).is_empty()))
      continue;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t heard = run.members.word(i) & interest.in_scope.word(i);
      interest.fresh.insert_word(i, heard);
      interest.has_fresh |= heard != 0;
      counters_.updates_held_back += static_cast<std::uint64_t>(std::popcount(heard));
    }
  }
}

void FederationParts::gather_runs(FlushContext& context) {
  const FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  const std::size_t before = frame.size();
  for (const UpdateRun& run : context.runs) {
    if (run.owner == context.slot) continue;
    const auto index = static_cast<std::size_t>(&run - context.runs.data());
    if (context.channel.way != nullptr && best_effort_sender_.gather(index, context)) continue;
    if (baselines_.covers(index)) {
      gather_periodic(index, context);
      continue;
    }
    if (!interest.is_uniform) {
      gather_cut_run(run, context);
      continue;
    }
    const AttributeSet wanted = interest.by_class[run.object_class] & run.attributes;
    if (wanted.is_empty()) continue;
    if (wanted != run.attributes) gather_cut_run(run, context);
    else if (!interest.has_fresh && is_all_in_scope(run, interest.heard())) {
      frame.write_stamp(run.stamp);
      frame.add_shared(run.message);
      counters_.updates_sent += run.slots.size();
    } else {
      gather_run(run, context);
    }
  }
  counters_.update_bytes_sent += frame.size() - before;
}

void FederationParts::gather_run(const UpdateRun& run, FlushContext& context) {
  GatheredFrame& frame = context.frame;
  std::optional<RecordWriter> writer;
  for_each_record(run, context.interest, [&](std::size_t index) {
    if (!writer) {
      frame.write_stamp(run.stamp);
      frame.say(UpdatesMessage{run.object_class, run.attributes.bits});
      writer.emplace(frame.bytes());
    }
    writer->add(run.records[index].handle, run.values(index));
    ++counters_.updates_sent;
  });
}

void FederationParts::gather_cut_run(const UpdateRun& run, FlushContext& context) {
  const FederateInterest& interest = context.interest;
  std::vector<std::byte>& bytes = context.frame.bytes();
  const ObjectClass& object_class = fom_.at(ObjectClassHandle{run.object_class});
  std::optional<UpdatesBlock> block;
  for_each_record(run, interest, [&](std::size_t index) {
    const AttributeSet wanted = interest.told(run.slots[index], run.object_class) & run.attributes;
    if (wanted.is_empty()) return;
    if (!block) {
      context.frame.write_stamp(run.stamp);
      block.emplace(bytes);
    }
    block->append(run.object_class, wanted, {run.records[index].handle}, [&] {
      for (std::uint32_t bits = wanted.bits; bits != 0; bits &= bits - 1) {
        const AttributeHandle attribute{static_cast<std::uint32_t>(std::countr_zero(bits))};
        const Bytes value = coded_value(object_class, run.attributes, attribute, run.values(index));
        bytes.insert(bytes.end(), value.begin(), value.end());
      }
    });
    ++counters_.updates_sent;
  });
}

/// What was lost goes out as it is now, by datagram again or, after a fallback, by the stream.
void FederationParts::write_due_states(FlushContext& context) {
  DatagramWay& way = *context.federate.way;
  const FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  for (const DatagramLedger::Lost& each : way.due) {
    const ObjectSlot object = objects_.find({each.handle});
    if (object == no_object || interest.fresh.contains(object))
      continue;  // gone, or told as a whole anyway
    const AttributeSet set = interest.told(object, objects_[object].object_class) &
                             objects_[object].valued & each.attributes;
    if (set.is_empty()) continue;
    values_.clear();
    objects_.append(object, set, values_);
    const Stamp stamp = newest_.of(object);
    ++counters_.updates_sent;
    ++counters_.updates_repaired;
    if (best_effort_sender_.add(context, object, set, stamp, values_)) continue;
    frame.write_stamp(stamp);
    frame.say(UpdatesMessage{objects_[object].object_class, set.bits});
    RecordWriter(frame.bytes()).add(each.handle, values_);
  }
  way.due.clear();
}

void FederationParts::send_frame(JoinedFederate& federate, Outlet& outlet) {
  const std::size_t size = frame_.size();
  if (size - frame_header_size > frame_max_to_federate)
    return expel(federate.connection, Violation::over_limit, ResignReason::lost,
                 "more to tell in one tick than a frame holds");
  federate.last_said = now_;
  counters_.bytes_sent += size;
  federate.counts.bytes_received += size;
  ++counters_.frames_sent;
  ++federate.frames;
  outlet.send(federate.connection, frame_.finish());
}

}  // namespace rink::rti
