// What goes out: one gathered write per destination, shared blocks without a copy.
#include <algorithm>
#include <bit>
#include <cstring>

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
  settle_update_requests();
  runs_ = buffering_->seal();
  baselines_.begin(runs_, federates_.size());
  batch_.begin_tick();
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    look_ahead(slot);
    if (federates_[slot].is_joined) flush_federate(slot, outlet);
  }
  baselines_.end();
  runs_ = {};
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

void FederationParts::flush_federate(std::uint32_t slot, Outlet& outlet) {
  Federate& federate = federates_[slot];
  scratch_.resize(frame_header_size);
  scratch_taken_ = 0;
  frame_stamp_.reset();
  is_keyframe_begun_ = false;
  pieces_.clear();
  told_whole_.clear();
  is_all_told_ = false;
  const std::uint64_t before = counters_.updates_sent;
  std::ranges::sort(interest_.of(slot).pressing);
  for (const ObjectSlot each : interest_.of(slot).pressing)
    interest_.of(slot).fresh.insert(
        each);  // what this flush's runs say of them is part of what was told
  begin_datagrams(federate, outlet);
  if (federate.upward) acknowledge_datagrams(federate, outlet);
  scratch_.insert(scratch_.end(), federate.outbox.head().begin(), federate.outbox.head().end());
  const std::size_t entry_end = scratch_.size() + entry_room(slot, outlet);
  write_scope_events(slot, entry_end);
  const bool is_held = holds_back(slot, outlet);
  if (is_held) {
    hold_back(slot);
  } else {
    if (interest_.of(slot).turns) take_turns(slot);
    write_fresh_states(slot, entry_end);
    if (interest_.of(slot).turns) catch_up(slot);
    if (federate.way && !federate.way->due.empty()) write_due_states(slot);
    gather_runs(slot);
    send_datagrams(federate, outlet);
  }
  federate.counts.reflections_received += counters_.updates_sent - before;
  scratch_.insert(scratch_.end(), federate.outbox.tail().begin(), federate.outbox.tail().end());
  federate.outbox.clear();
  federate.looked_at = federate.said = 0;
  FederateInterest& interest = interest_.of(slot);
  interest.events.clear();
  if (is_all_told_) interest.has_fresh = false;
  for (const ObjectSlot told : interest.pressing) interest.fresh.erase(told);
  interest.pressing.clear();
  for (const ObjectSlot told : told_whole_) {
    interest.fresh.erase(
        told);  // not before: their updates in this flush are part of what was told
    if (interest.turns) interest.turns->late.told(told);
  }
  if (pieces_.empty() && scratch_.size() == frame_header_size) {
    if (now_ - federate.last_said < settings_.patience.heartbeat_s) return;
    say(scratch_, HeartbeatMessage{});
  }
  send_pieces(federate, outlet);
}

void FederationParts::write_stamp(const Stamp& stamp) {
  if (frame_stamp_ == stamp) return;
  frame_stamp_ = stamp;
  say(scratch_, StampMessage{stamp});
}

/// Who comes into a large world would be closed for a queue that no reader empties in one tick:
/// what does not fit is told by the next flushes.
std::size_t FederationParts::entry_room(std::uint32_t slot, const Outlet& outlet) const {
  const FederateInterest& interest = interest_.of(slot);
  if (interest.events.empty() && !interest.has_fresh && !interest.has_unannounced) return 0;
  return settings_.entry_bytes_per_flush_max -
         std::min(settings_.entry_bytes_per_flush_max,
                  outlet.waiting_bytes(federates_[slot].connection));
}

/// Up to `end` bytes in `scratch_`.
void FederationParts::write_scope_events(std::uint32_t slot, std::size_t end) {
  FederateInterest& interest = interest_.of(slot);
  const std::size_t before = scratch_.size();
  const auto is_too_late = [&](ObjectSlot object) {
    return objects_[object].is_leaving && !interest.known.contains(object);
  };  // nobody discovers it any more
  if (interest.has_unannounced) {
    interest.announced_to =
        interest.unannounced.visit_from(interest.announced_to, [&](ObjectSlot object) {
          if (scratch_.size() >= end) return false;
          if (is_too_late(object)) interest.unannounced.erase(object);
          else announce(slot, object, scratch_);
          return true;
        });
    interest.has_unannounced = scratch_.size() >= end;
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
        say(scratch_, OutOfScopeMessage{object.handle.value});
    } else if (scratch_.size() < end) {
      announce(slot, event.slot, scratch_);
    } else {
      interest.unannounced.insert(event.slot);
      interest.has_unannounced = true;
      ++counters_.entries_postponed;
    }
  }
  counters_.scope_bytes_sent += scratch_.size() - before;
}

void FederationParts::announce(std::uint32_t slot, ObjectSlot at, std::vector<std::byte>& bytes) {
  FederateInterest& interest = interest_.of(slot);
  const Object& object = objects_[at];
  if (!interest.known.contains(at)) {
    say(bytes, DiscoverObjectMessage{object.handle.value, object.object_class, object.name});
    ++federates_[slot].objects_discovered;
    if (is_auto_providing_) ask_owners(slot, at, interest.told(at, object.object_class), {});
  }
  if (object.negotiation != Object::no_negotiation && !interest.known.contains(at))
    offer_to(slot, at, ownership_.all(at));
  interest.known.insert(at);
  interest.unannounced.erase(at);
  say(bytes, InScopeMessage{object.handle.value});
}

/// A message in time-stamp order is about to speak of it: it is announced, and its state told,
/// before all else that this flush says.
void FederationParts::press(std::uint32_t slot, ObjectSlot object) {
  FederateInterest& interest = interest_.of(slot);
  announce(slot, object, federates_[slot].outbox.head());
  say_last_state(slot, object, newest_of(object));
  interest.fresh.erase(object);
  interest.has_fresh = true;
  interest.pressing.push_back(object);
}

/// Up to `end` bytes in `scratch_`. Their stamp is their owner's newest, not that of the update
/// which said it: what they are was not changed until then.
void FederationParts::write_fresh_states(std::uint32_t slot, std::size_t end) {
  FederateInterest& interest = interest_.of(slot);
  if (!interest.has_fresh) return;
  bool is_whole = !interest.has_unannounced;
  const std::size_t before = scratch_.size();
  std::optional<UpdatesBlock> block;
  interest.told_to = interest.fresh.visit_from(interest.told_to, [&](ObjectSlot fresh) {
    if (interest.unannounced.contains(fresh) ||
        std::ranges::binary_search(interest.pressing, fresh))
      return true;
    if (scratch_.size() >= end) {
      is_whole = false;
      return false;
    }
    if (interest.turns && interest.turns->waiting.contains(fresh)) {
      is_whole = false;
      return true;
    }
    told_whole_.push_back(fresh);
    const Object& object = objects_[fresh];
    if (!object.is_alive) return true;
    const AttributeSet set = interest.told(fresh, object.object_class) & object.valued;
    if (set.is_empty()) return true;
    const Stamp stamp = newest_of(fresh);
    if (!block || frame_stamp_ != stamp) {
      block.reset();
      write_stamp(stamp);
      block.emplace(scratch_);
    }
    block->append(object.object_class, set, object.handle,
                  [&] { objects_.append(fresh, set, scratch_); });
    ++counters_.updates_sent;
    return true;
  });
  block.reset();
  is_all_told_ = is_whole;
  counters_.entry_bytes_sent += scratch_.size() - before;
}

bool FederationParts::holds_back(std::uint32_t slot, const Outlet& outlet) {
  if (runs_.empty() && !interest_.of(slot).has_fresh) return false;
  return buffering_->holds_back(slot, outlet.waiting_bytes(federates_[slot].connection));
}

/// What it would have heard of becomes due whole, as if it had come into scope: the newest state,
/// once, however many updates there were.
void FederationParts::hold_back(std::uint32_t slot) {
  FederateInterest& interest = interest_.of(slot);
  for (const UpdateRun& run : runs_) {
    if (run.owner == slot ||
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

void FederationParts::gather_runs(std::uint32_t slot) {
  const FederateInterest& interest = interest_.of(slot);
  const std::size_t before = scratch_.size();
  for (const UpdateRun& run : runs_) {
    if (run.owner == slot) continue;
    const auto index = static_cast<std::size_t>(&run - runs_.data());
    if (way_ != nullptr && gather_datagrams(index, interest)) continue;
    if (baselines_.covers(index)) {
      gather_periodic(index, slot);
      continue;
    }
    if (!interest.is_uniform) {
      gather_cut_run(run, interest);
      continue;
    }
    const AttributeSet wanted = interest.by_class[run.object_class] & run.attributes;
    if (wanted.is_empty()) continue;
    if (wanted != run.attributes) gather_cut_run(run, interest);
    else if (!interest.has_fresh && is_all_in_scope(run, interest.heard())) {
      write_stamp(run.stamp);
      add_shared(run.message);
      counters_.updates_sent += run.slots.size();
    } else {
      gather_run(run, interest);
    }
  }
  counters_.update_bytes_sent += scratch_.size() - before;
}

void FederationParts::gather_run(const UpdateRun& run, const FederateInterest& interest) {
  std::optional<RecordWriter> writer;
  for_each_record(run, interest, [&](std::size_t index) {
    if (!writer) {
      write_stamp(run.stamp);
      say(scratch_, UpdatesMessage{run.object_class, run.attributes.bits});
      writer.emplace(scratch_);
    }
    writer->add(run.records[index].handle, run.values(index));
    ++counters_.updates_sent;
  });
}

void FederationParts::gather_cut_run(const UpdateRun& run, const FederateInterest& interest) {
  const ObjectClass& object_class = fom_.at(ObjectClassHandle{run.object_class});
  std::optional<UpdatesBlock> block;
  for_each_record(run, interest, [&](std::size_t index) {
    const AttributeSet wanted = interest.told(run.slots[index], run.object_class) & run.attributes;
    if (wanted.is_empty()) return;
    if (!block) {
      write_stamp(run.stamp);
      block.emplace(scratch_);
    }
    block->append(run.object_class, wanted, {run.records[index].handle}, [&] {
      for (std::uint32_t bits = wanted.bits; bits != 0; bits &= bits - 1) {
        const AttributeHandle attribute{static_cast<std::uint32_t>(std::countr_zero(bits))};
        const Bytes value = coded_value(object_class, run.attributes, attribute, run.values(index));
        scratch_.insert(scratch_.end(), value.begin(), value.end());
      }
    });
    ++counters_.updates_sent;
  });
}

void FederationParts::take_scratch() {
  if (scratch_.size() > scratch_taken_) pieces_.push_back({{}, scratch_taken_, scratch_.size()});
  scratch_taken_ = scratch_.size();
}

void FederationParts::add_shared(Bytes bytes) {
  // A short block is cheaper copied than gathered, and a write takes only so many parts.
  constexpr std::size_t copied_max = 512, piece_max = 64;
  if (bytes.size() <= copied_max || pieces_.size() >= piece_max) {
    scratch_.insert(scratch_.end(), bytes.begin(), bytes.end());
    return;
  }
  take_scratch();
  pieces_.push_back({bytes, 0, 0});
  counters_.update_bytes_sent += bytes.size();
}

void FederationParts::send_pieces(Federate& federate, Outlet& outlet) {
  take_scratch();
  gathered_.clear();
  std::size_t size = 0;
  for (const Piece& piece : pieces_) {
    gathered_.push_back(
        piece.shared.empty()
            ? Bytes(scratch_).subspan(piece.scratch_from, piece.scratch_to - piece.scratch_from)
            : piece.shared);
    size += gathered_.back().size();
  }
  if (size - frame_header_size > frame_max_to_federate)
    return expel(federate.connection, Violation::over_limit, ResignReason::lost,
                 "more to tell in one tick than a frame holds");
  const auto length = static_cast<std::uint32_t>(size - frame_header_size);
  std::memcpy(scratch_.data(), &length, sizeof length);
  federate.last_said = now_;
  counters_.bytes_sent += size;
  federate.counts.bytes_received += size;
  ++counters_.frames_sent;
  ++federate.frames;
  outlet.send(federate.connection, gathered_);
}

}  // namespace rink::rti
