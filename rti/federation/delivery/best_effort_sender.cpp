// Cuts runs into datagrams, and falls back to the stream where they get no answer.
#include "rti/federation/delivery/best_effort_sender.h"

#include <cassert>

#include "rti/buffering/run_scope.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Appends the values of `wanted`, a part of `set`, from those of `set`.
void cut_values(const ObjectClass& object_class, AttributeSet set, AttributeSet wanted,
                Bytes values, std::vector<std::byte>& bytes) {
  for (const AttributeHandle attribute : wanted) {
    const Bytes value = coded_value(object_class, set, attribute, values);
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
}

}  // namespace

void BestEffortSender::append(const ObjectUpdate& update) {
  assert(update.object.is_alive && !update.attributes.is_empty());
  if (has_channels_) append_apart(update);
  else buffering_.append(update);
}

void BestEffortSender::append_apart(const ObjectUpdate& update) {
  const AttributeSet best_effort = update.attributes & types_.by_datagram(update.slot),
                     reliable(update.attributes.bits & ~best_effort.bits);
  if (best_effort.is_empty() || reliable.is_empty()) return buffering_.append(update);
  for (const AttributeSet attributes : {reliable, best_effort}) {
    values_.clear();
    cut_values(basis_.fom.object_classes()[update.object.object_class], update.attributes,
               attributes, update.values, values_);
    ObjectUpdate part = update;
    part.attributes = attributes;
    part.values = values_;
    part.residual = {};
    buffering_.append(part);
  }
}

/// Where nothing is best-effort this is one comparison per federate and flush.
DatagramPath BestEffortSender::begin(JoinedFederate& federate, Outlet& outlet) {
  if (!types_.has_best_effort()) return {};
  const std::size_t size_max =
      federate.has_stream_only ? 0 : outlet.datagram_max(federate.connection);
  const bool is_open = size_max >= 256;  // less is no use
  if (!federate.channel && !is_open) return {};
  if (!is_usable(federate, is_open, outlet)) return {};
  const DatagramPath path{federate.channel.get(), size_max - DatagramHead::size};
  batch_.begin(path.size_max);
  return path;
}

/// Falls back to the stream where datagrams get no answer, and probes the channel now and then.
bool BestEffortSender::is_usable(JoinedFederate& federate, bool is_open, Outlet& outlet) {
  if (!federate.channel) {
    federate.channel = std::make_unique<DatagramChannel>(batch_.lists());
    has_channels_ = true;
  }
  DatagramChannel& channel = *federate.channel;
  channel.ledger.expire(basis_.now, channel.due);
  const std::optional<double> silent_since = channel.ledger.unanswered_since();
  const bool is_silent =
      silent_since && basis_.now - *silent_since > DatagramChannel::fallback_after_s;
  if (!channel.has_fallen_back && (!is_open || is_silent)) {
    channel.has_fallen_back = true;
    channel.probed_s = basis_.now;
    channel.ledger.abandon(channel.due);
    ++basis_.counters.datagram_fallbacks;
  }
  if (channel.has_fallen_back && is_open &&
      basis_.now - channel.probed_s >= DatagramChannel::probe_period_s)
    probe(federate, outlet);
  return !channel.has_fallen_back;
}

void BestEffortSender::probe(JoinedFederate& federate, Outlet& outlet) {
  std::vector<std::byte> bytes;
  DatagramHead head{federate.channel->ledger.note(basis_.now), federate.frames};
  Writer writer(bytes);
  exchange(writer, head);
  const Datagram empty{bytes, {}};
  federate.channel->probed_s = basis_.now;
  ++basis_.counters.datagrams_sent;
  basis_.counters.bytes_sent += bytes.size();
  outlet.send_datagrams(federate.connection, std::span(&empty, 1));
}

bool BestEffortSender::add(const FlushContext& context, ObjectSlot object, AttributeSet set,
                           const Stamp& stamp, Bytes values) {
  const Object& source = basis_.objects[object];
  return context.path.channel != nullptr &&
         batch_.add(source.object_class, set, stamp, source.handle.value, values);
}

bool BestEffortSender::gather(std::size_t index, FlushContext& context) {
  assert(index < context.runs.size());
  const UpdateRun& run = context.runs[index];
  const FederateInterest& interest = context.interest;
  if (!types_.best_effort(run.object_class).includes(run.attributes)) return false;
  const CutRun& cut = batch_.cut(index, run, context.path.size_max);
  if (!cut.fits) return false;
  const bool has_changed = types_.has_changed();
  const bool is_whole = !has_changed && interest.is_uniform && !interest.needs_any_full_state &&
                        interest.by_class[run.object_class].includes(run.attributes);
  if (is_whole && is_all_in_scope(run, interest.reflected())) {
    batch_.add(cut);
    basis_.counters.updates_sent += run.slots.size();
    return true;
  }
  for_each_record(run, interest, [&](std::size_t record) {
    const AttributeSet wanted =
        interest.attributes_in_scope(run.slots[record], run.object_class) & run.attributes;
    if (wanted.is_empty()) return;
    Bytes values = run.values(record);
    if (wanted != run.attributes) {
      values_.clear();
      cut_values(basis_.fom.object_classes()[run.object_class], run.attributes, wanted, values,
                 values_);
      values = values_;
    }
    ++basis_.counters.updates_sent;
    if (!has_changed || types_.by_datagram(run.slots[record]).includes(wanted))
      return void(
          batch_.add(run.object_class, wanted, run.stamp, run.records[record].handle, values));
    context.frame.write_stamp(run.stamp);
    context.frame.enqueue(UpdatesMessage{run.object_class, wanted.bits});
    RecordWriter(context.frame.bytes()).add(run.records[record].handle, values);
  });
  return true;
}

void BestEffortSender::send(FlushContext& context, Outlet& outlet) {
  JoinedFederate& federate = context.federate;
  DatagramChannel* channel = context.path.channel;
  if (channel == nullptr || batch_.is_empty()) return;
  const std::span<const Datagram> datagrams =
      batch_.finish(federate.frames, channel->ledger, basis_.now);
  std::size_t size = 0;
  for (const Datagram& each : datagrams) size += each.head.size() + each.body.size();
  basis_.counters.bytes_sent += size;
  basis_.counters.update_bytes_sent += size;
  basis_.counters.datagrams_sent += datagrams.size();
  federate.counts.bytes_received += size;
  // A federate that acknowledges datagrams needs no heartbeat beside them.
  if (const auto since = channel->ledger.unanswered_since();
      !since || basis_.now - *since < basis_.settings.timeouts.heartbeat_s)
    federate.last_sent = basis_.now;
  outlet.send_datagrams(federate.connection, datagrams);
}

bool BestEffortSender::acknowledge(std::uint32_t slot, Reader& reader) {
  DatagramChannel* channel = basis_.federates[slot].channel.get();
  AcknowledgeDatagramsMessage message;
  if (channel == nullptr || !exchange(reader, message) ||
      !channel->ledger.acknowledge(message, basis_.now, channel->due))
    return false;
  basis_.counters.datagram_recoveries += channel->has_fallen_back ? 1u : 0u;
  channel->has_fallen_back = false;
  return true;
}

}  // namespace rink::rti
