// The flush, federate by federate.
#include "rti/federation/delivery/sender.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "rti/buffering/run_scope.h"
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

void Sender::flush(Outlet& outlet) {
  const std::span<const UpdateRun> runs = uses_.buffering.seal();
  uses_.rates.add(runs);
  const std::uint32_t limited = uses_.rates.limited_count();
  if (limited < basis_.federates.joined_count())
    flush_group(UpdateRates::every_match, runs, keyframes_, outlet);
  std::deque<UpdateRates::Group>& groups = uses_.rates.groups();
  for (std::uint32_t k = 0; limited > 0 && k < groups.size(); ++k)
    if (groups[k].is_due && groups[k].federates > 0)
      flush_group(k, uses_.rates.due_runs(k, basis_.objects), groups[k].keyframes, outlet);
  if (limited > 0) flush_between_turns(runs, outlet);
  uses_.rates.end_turns();
  uses_.buffering.clear();
}

void Sender::flush_group(std::uint32_t group, std::span<const UpdateRun> runs,
                         std::uint64_t& keyframes, Outlet& outlet) {
  uses_.periodic.begin_flush(runs, keyframes);
  if (group == UpdateRates::every_match) uses_.residuals.begin_flush(runs);
  uses_.datagrams.begin_flush();
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot) {
    look_ahead(slot);
    if (!basis_.federates[slot].is_joined || uses_.rates.group_of(slot) != group) continue;
    full_state_sent_.clear();
    FlushContext context{slot,   basis_.federates[slot], uses_.distribution.of(slot), runs,
                         frame_, full_state_sent_};
    if (group != UpdateRates::every_match) {
      context.has_turns = true;
      if (context.interest.turns)
        context.interest.turns->number = uses_.rates.groups()[group].turns;
    }
    flush_federate(context, outlet);
    if (!context.has_turns) continue;
    context.interest.holds_former.clear();  // it is not sent every update
    uses_.rates.note_turn(slot);
  }
  uses_.periodic.end_flush();
}

/// All but changes of scope and values is sent at once, and so are the values that `UpdateRates`
/// lists; a federate for which there is neither costs a look.
void Sender::flush_between_turns(std::span<const UpdateRun> runs, Outlet& outlet) {
  std::span<const UpdateRates::Prompt> prompts = uses_.rates.prompts();
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot) {
    std::size_t own = 0;
    while (own < prompts.size() && prompts[own].federate == slot) ++own;
    const std::span<const UpdateRates::Prompt> due = prompts.first(own);
    prompts = prompts.subspan(own);
    JoinedFederate& federate = basis_.federates[slot];
    if (!federate.is_joined || uses_.rates.group_of(slot) == UpdateRates::every_match ||
        uses_.rates.groups()[uses_.rates.group_of(slot)].is_due)
      continue;
    FlushContext context{slot, federate, uses_.distribution.of(slot), {}, frame_, full_state_sent_};
    if (!context.interest.sent_now.empty()) {  // announced already, and so are those before it
      full_state_sent_.clear();
      // The updates are not in this flush, so what became due waits for those of the turn.
      const Bitmap prompt = context.interest.turns ? context.interest.turns->prompt : Bitmap{};
      flush_federate(context, outlet);
      if (context.interest.turns) context.interest.turns->prompt.insert_all(prompt);
      context.interest.holds_former.clear();
      continue;
    }
    uses_.announcements.postpone(context.interest);
    uses_.received.acknowledge(slot, outlet);
    const bool is_silent = basis_.now - federate.last_sent >= basis_.settings.timeouts.heartbeat_s;
    if (due.empty() && !is_silent && federate.outbox.is_empty()) continue;
    frame_.begin(federate.stamp_steps);
    frame_.append(federate.outbox.head());
    context.runs = runs;
    write_prompts(context, due);
    frame_.append(federate.outbox.tail());
    federate.outbox.clear();
    if (frame_.is_empty() && is_silent) frame_.enqueue(HeartbeatMessage{});
    if (!frame_.is_empty()) send_frame(context, outlet);
  }
}

/// What the federate is not sent whole waits for its turn.
void Sender::write_prompts(FlushContext& context, std::span<const UpdateRates::Prompt> prompts) {
  const FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  const std::size_t before = frame.size();
  for (const UpdateRates::Prompt& each : prompts) {
    const UpdateRun& run = context.runs[each.run];
    const ObjectSlot object = run.slots[each.record];
    if (run.owner == context.slot || run.object_class == interest.host_served ||
        interest.needs_full_state.contains(object) ||
        !interest.attributes_in_scope(object, run.object_class).includes(run.attributes))
      continue;
    frame.write_stamp(run.stamp);
    frame.enqueue(UpdatesMessage{run.object_class, run.attributes.bits});
    RecordWriter(frame.bytes()).add(run.records[each.record].handle, run.values(each.record));
    uses_.rates.note_prompt(context.slot, run.attributes, run.stamp);
    ++basis_.counters.updates_sent;
    ++context.federate.counts.reflections_received;
  }
  basis_.counters.update_bytes_sent += frame.size() - before;
}

/// With many federates a federate's data leaves the cache between two flushes: the data of the next
/// ones are fetched meanwhile, each piece when the one that points to it is there.
void Sender::look_ahead(std::uint32_t slot) const {
  if (slot + 3 < basis_.federates.size()) fetch(basis_.federates[slot + 3]);
  if (slot + 2 < basis_.federates.size() && basis_.federates[slot + 2].is_joined) {
    fetch(uses_.distribution.of(slot + 2));
    if (basis_.federates[slot + 2].channel) fetch(*basis_.federates[slot + 2].channel);
  }
  if (slot + 1 < basis_.federates.size() && basis_.federates[slot + 1].is_joined) {
    const FederateInterest& interest = uses_.distribution.of(slot + 1);
    __builtin_prefetch(interest.by_class.data());
    interest.in_scope.prefetch();
  }
}

void Sender::flush_federate(FlushContext& context, Outlet& outlet) {
  JoinedFederate& federate = context.federate;
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  const std::uint64_t before = basis_.counters.updates_sent;
  frame.begin(federate.stamp_steps);
  std::ranges::sort(interest.sent_now);
  for (const ObjectSlot each : interest.sent_now)
    interest.needs_full_state.insert(each);  // the full state includes this flush's runs
  context.path = uses_.datagrams.begin(federate, outlet);
  uses_.received.acknowledge(context.slot, outlet);
  frame.append(federate.outbox.head());
  write_content(context, outlet);
  const std::uint64_t sent = basis_.counters.updates_sent - before;
  federate.counts.reflections_received += sent;
  if (sent > 0) ++federate.times_updated;
  frame.append(federate.outbox.tail());
  federate.outbox.clear();
  settle_interest(context);
  if (frame.is_empty()) {
    if (basis_.now - federate.last_sent < basis_.settings.timeouts.heartbeat_s) return;
    frame.enqueue(HeartbeatMessage{});
  }
  send_frame(context, outlet);
}

/// Writes the changes of scope and the new values of objects in scope.
void Sender::write_content(FlushContext& context, Outlet& outlet) {
  FederateInterest& interest = context.interest;
  for (const UpdateRun& run : context.runs) uses_.residuals.passed_by(run, interest);
  const std::size_t entry_end = context.frame.size() + entry_room(context, outlet);
  uses_.announcements.write(context, entry_end);
  if (holds_back(context, outlet)) {
    uses_.announcements.write_gathered(context);
    return hold_back(context);
  }
  const bool has_turns = interest.turns && interest.host_served == FederateInterest::no_class;
  if (has_turns) uses_.turns.apply_turns(context);
  // Stamps ascend within a frame, and that of full states is the newest.
  if (context.has_turns) gather_runs(context);
  uses_.entries.write(context, entry_end);
  uses_.announcements.write_gathered(context);
  if (has_turns) uses_.turns.catch_up(context);
  if (context.federate.channel && !context.federate.channel->due.empty()) write_due_states(context);
  if (!context.has_turns) gather_runs(context);
  uses_.datagrams.send(context, outlet);
}

/// Objects sent in full need their full state no longer; this comes last because that state
/// includes their updates in this flush.
void Sender::settle_interest(FlushContext& context) {
  FederateInterest& interest = context.interest;
  interest.events.clear();
  if (context.is_all_sent) interest.needs_any_full_state = false;
  for (const ObjectSlot each : interest.sent_now) interest.needs_full_state.erase(each);
  interest.sent_now.clear();
  for (const ObjectSlot each : context.full_state_sent) {
    interest.needs_full_state.erase(each);
    if (interest.turns) interest.turns->late.sent(each);
  }
}

/// Without a limit, a federate that enters a large world would be closed for a queue that no reader
/// empties in one tick: what does not fit is sent by the next flushes.
std::size_t Sender::entry_room(const FlushContext& context, const Outlet& outlet) const {
  const FederateInterest& interest = context.interest;
  if (interest.events.empty() && !interest.needs_any_full_state && !interest.has_unannounced)
    return 0;
  return basis_.settings.entry_bytes_per_flush_max -
         std::min(basis_.settings.entry_bytes_per_flush_max,
                  outlet.waiting_bytes(context.federate.connection));
}

bool Sender::holds_back(const FlushContext& context, const Outlet& outlet) {
  if (context.runs.empty() && !context.interest.needs_any_full_state) return false;
  return uses_.buffering.holds_back(context.slot,
                                    outlet.waiting_bytes(context.federate.connection));
}

/// Objects that the federate would have received become due in full, as if they had come into
/// scope: the newest state, once, however many updates there were.
void Sender::hold_back(FlushContext& context) {
  FederateInterest& interest = context.interest;
  for (const UpdateRun& run : context.runs) {
    uses_.residuals.sent_otherwise(run, interest);
    if (run.owner == context.slot || run.object_class == interest.host_served ||
        (interest.is_uniform && (interest.by_class[run.object_class] & run.attributes).is_empty()))
      continue;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t due_of_run = run.members.word(i) & interest.in_scope.word(i);
      interest.needs_full_state.insert_word(i, due_of_run);
      interest.needs_any_full_state |= due_of_run != 0;
      basis_.counters.updates_held_back += static_cast<std::uint64_t>(std::popcount(due_of_run));
    }
  }
}

void Sender::gather_runs(FlushContext& context) {
  FederateInterest& interest = context.interest;
  const std::size_t before = context.frame.size();
  for (std::size_t index = 0; index < context.runs.size(); ++index) {
    const UpdateRun& run = context.runs[index];
    if (run.object_class == interest.host_served) continue;
    if (run.owner == context.slot) {
      uses_.residuals.sent_otherwise(run, interest);
      continue;
    }
    if (!context.has_turns) {
      gather_whole(index, context);
      continue;
    }
    const LeftOut left_out(interest, uses_.rates.sent_before(context.slot, run));
    gather_whole(index, context);
  }
  basis_.counters.update_bytes_sent += context.frame.size() - before;
}

void Sender::gather_whole(std::size_t index, FlushContext& context) {
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  const UpdateRun& run = context.runs[index];
  if (context.path.channel != nullptr && uses_.datagrams.gather(index, context))
    return uses_.residuals.sent_otherwise(run, interest);
  if (uses_.periodic.covers(index)) return uses_.periodic.gather(index, context);
  if (!context.has_turns && uses_.residuals.gather(index, context)) return;
  if (!interest.is_uniform) {
    uses_.residuals.sent_otherwise(run, interest);
    return gather_cut_run(run, context);
  }
  const AttributeSet wanted = interest.by_class[run.object_class] & run.attributes;
  if (wanted == run.attributes) uses_.residuals.sent_whole(run, interest);
  else uses_.residuals.sent_otherwise(run, interest);
  if (wanted.is_empty()) return;
  if (wanted != run.attributes) return gather_cut_run(run, context);
  if (interest.needs_any_full_state || !is_all_in_scope(run, interest.reflected()))
    return gather_run(run, context);
  frame.write_stamp(run.stamp);
  frame.add_shared(run.message);
  basis_.counters.updates_sent += run.slots.size();
}

void Sender::gather_run(const UpdateRun& run, FlushContext& context) {
  GatheredFrame& frame = context.frame;
  std::optional<RecordWriter> writer;
  for_each_record(run, context.interest, [&](std::size_t index) {
    if (!writer) {
      frame.write_stamp(run.stamp);
      frame.enqueue(UpdatesMessage{run.object_class, run.attributes.bits});
      writer.emplace(frame.bytes());
    }
    writer->add(run.records[index].handle, run.values(index));
    ++basis_.counters.updates_sent;
  });
}

void Sender::gather_cut_run(const UpdateRun& run, FlushContext& context) {
  const FederateInterest& interest = context.interest;
  std::vector<std::byte>& bytes = context.frame.bytes();
  const ObjectClass& object_class = basis_.fom.at(ObjectClassHandle{run.object_class});
  std::optional<UpdatesBlock> block;
  for_each_record(run, interest, [&](std::size_t index) {
    const AttributeSet wanted =
        interest.attributes_in_scope(run.slots[index], run.object_class) & run.attributes;
    if (wanted.is_empty()) return;
    if (!block) {
      context.frame.write_stamp(run.stamp);
      block.emplace(bytes);
    }
    block->append(run.object_class, wanted, {run.records[index].handle}, [&] {
      wanted.for_each([&](AttributeHandle attribute) {
        const Bytes value = coded_value(object_class, run.attributes, attribute, run.values(index));
        bytes.insert(bytes.end(), value.begin(), value.end());
      });
    });
    ++basis_.counters.updates_sent;
  });
}

/// Sends the present values of what was lost, by datagram again or, after a fallback, by the
/// stream.
void Sender::write_due_states(FlushContext& context) {
  DatagramChannel& channel = *context.federate.channel;
  FederateInterest& interest = context.interest;
  GatheredFrame& frame = context.frame;
  for (const DatagramLedger::Lost& each : channel.due) {
    const ObjectSlot object = basis_.objects.find({each.handle});
    if (object == no_object || interest.needs_full_state.contains(object) ||
        basis_.objects[object].object_class == interest.host_served)
      continue;  // gone, or sent in full anyway, or by the host
    const AttributeSet set =
        interest.attributes_in_scope(object, basis_.objects[object].object_class) &
        basis_.objects[object].valued & each.attributes;
    if (set.is_empty()) continue;
    interest.holds_former.erase(object);
    values_.clear();
    basis_.objects.append(object, set, values_);
    const Stamp stamp = uses_.newest.of(object);
    ++basis_.counters.updates_sent;
    ++basis_.counters.updates_repaired;
    if (uses_.datagrams.add(context, object, set, stamp, values_)) continue;
    frame.write_stamp(stamp);
    frame.enqueue(UpdatesMessage{basis_.objects[object].object_class, set.bits});
    RecordWriter(frame.bytes()).add(each.handle, values_);
  }
  channel.due.clear();
}

void Sender::send_frame(FlushContext& context, Outlet& outlet) {
  JoinedFederate& federate = context.federate;
  const std::size_t size = context.frame.sent_size();
  if (context.frame.payload_size() > frame_max_to_federate)
    return expel_(context.slot, Violation::over_limit, ResignReason::lost,
                  "more to send in one tick than a frame holds");
  federate.last_sent = basis_.now;
  basis_.counters.bytes_sent += size;
  federate.counts.bytes_received += size;
  ++basis_.counters.frames_sent;
  ++federate.frames;
  outlet.send(federate.connection, context.frame.finish());
}

}  // namespace rink::rti
