// Runs cut into datagrams, and the ways that carry them.
#include "rti/federation/delivery/best_effort_sender.h"

#include <bit>

#include "rti/buffering/run_scope.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Appends the values of `wanted`, a part of `set`, from those of `set`.
void cut_values(const ObjectClass& object_class, AttributeSet set, AttributeSet wanted,
                Bytes values, std::vector<std::byte>& bytes) {
  for (std::uint32_t bits = wanted.bits; bits != 0; bits &= bits - 1) {
    const Bytes value = coded_value(object_class, set,
                                    {static_cast<std::uint32_t>(std::countr_zero(bits))}, values);
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
}

}  // namespace

void BestEffortSender::append(std::uint32_t slot, ObjectSlot object, AttributeSet attributes,
                              const Stamp& stamp, Bytes values) {
  const ObjectUpdate update{.owner = slot,
                            .slot = object,
                            .object = basis_.objects[object],
                            .attributes = attributes,
                            .stamp = stamp,
                            .values = values};
  if (has_ways_) append_apart(update);
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
    buffering_.append(part);
  }
}

/// Where nothing is best-effort this is one comparison per federate and flush.
DatagramChannel BestEffortSender::begin(JoinedFederate& federate, Outlet& outlet) {
  if (!types_.has_best_effort()) return {};
  const std::size_t size_max =
      federate.has_stream_only ? 0 : outlet.datagram_max(federate.connection);
  const bool is_open = size_max >= 256;  // less is no use
  if (!federate.way && !is_open) return {};
  if (!is_usable(federate, is_open, outlet)) return {};
  const DatagramChannel channel{federate.way.get(), size_max - DatagramHead::size};
  batch_.begin(channel.size_max);
  return channel;
}

/// Falls back to the stream where nobody answers, and asks now and then if somebody does again.
bool BestEffortSender::is_usable(JoinedFederate& federate, bool is_open, Outlet& outlet) {
  if (!federate.way) {
    federate.way = std::make_unique<DatagramWay>(batch_.lists());
    has_ways_ = true;
  }
  DatagramWay& way = *federate.way;
  way.ledger.expire(basis_.now, way.due);
  const std::optional<double> silent_since = way.ledger.unanswered_since();
  const bool is_silent = silent_since && basis_.now - *silent_since > DatagramWay::fallback_after_s;
  if (!way.has_fallen_back && (!is_open || is_silent)) {
    way.has_fallen_back = true;
    way.probed_s = basis_.now;
    way.ledger.abandon(way.due);
    ++basis_.counters.datagram_fallbacks;
  }
  if (way.has_fallen_back && is_open && basis_.now - way.probed_s >= DatagramWay::probe_period_s)
    probe(federate, outlet);
  return !way.has_fallen_back;
}

void BestEffortSender::probe(JoinedFederate& federate, Outlet& outlet) {
  std::vector<std::byte> bytes;
  DatagramHead head{federate.way->ledger.note(basis_.now), federate.frames};
  Writer writer(bytes);
  exchange(writer, head);
  const Datagram empty{bytes, {}};
  federate.way->probed_s = basis_.now;
  ++basis_.counters.datagrams_sent;
  basis_.counters.bytes_sent += bytes.size();
  outlet.send_datagrams(federate.connection, std::span(&empty, 1));
}

bool BestEffortSender::add(const FlushContext& context, ObjectSlot object, AttributeSet set,
                           const Stamp& stamp, Bytes values) {
  const Object& told = basis_.objects[object];
  return context.channel.way != nullptr &&
         batch_.add(told.object_class, set, stamp, told.handle.value, values);
}

bool BestEffortSender::gather(std::size_t index, FlushContext& context) {
  const UpdateRun& run = context.runs[index];
  const FederateInterest& interest = context.interest;
  if (!types_.best_effort(run.object_class).includes(run.attributes)) return false;
  const CutRun& cut = batch_.cut(index, run, context.channel.size_max);
  if (!cut.fits) return false;
  const bool has_changed = types_.has_changed();
  const bool is_whole = !has_changed && interest.is_uniform && !interest.has_fresh &&
                        interest.by_class[run.object_class].includes(run.attributes);
  if (is_whole && is_all_in_scope(run, interest.heard())) {
    batch_.add(cut);
    basis_.counters.updates_sent += run.slots.size();
    return true;
  }
  for_each_record(run, interest, [&](std::size_t record) {
    const AttributeSet wanted = interest.told(run.slots[record], run.object_class) & run.attributes;
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
    context.frame.say(UpdatesMessage{run.object_class, wanted.bits});
    RecordWriter(context.frame.bytes()).add(run.records[record].handle, values);
  });
  return true;
}

void BestEffortSender::send(FlushContext& context, Outlet& outlet) {
  JoinedFederate& federate = context.federate;
  DatagramWay* way = context.channel.way;
  if (way == nullptr || batch_.is_empty()) return;
  const std::span<const Datagram> datagrams =
      batch_.finish(federate.frames, way->ledger, basis_.now);
  std::size_t size = 0;
  for (const Datagram& each : datagrams) size += each.head.size() + each.body.size();
  basis_.counters.bytes_sent += size;
  basis_.counters.update_bytes_sent += size;
  basis_.counters.datagrams_sent += datagrams.size();
  federate.counts.bytes_received += size;
  // Who hears of us by datagrams, as its answers tell, needs no heartbeat beside them.
  if (const auto since = way->ledger.unanswered_since();
      !since || basis_.now - *since < basis_.settings.patience.heartbeat_s)
    federate.last_said = basis_.now;
  outlet.send_datagrams(federate.connection, datagrams);
}

bool BestEffortSender::acknowledge(std::uint32_t slot, Reader& reader) {
  DatagramWay* way = basis_.federates[slot].way.get();
  AcknowledgeDatagramsMessage message;
  if (way == nullptr || !exchange(reader, message) ||
      !way->ledger.acknowledge(message, basis_.now, way->due))
    return false;
  basis_.counters.datagram_recoveries += way->has_fallen_back ? 1u : 0u;
  way->has_fallen_back = false;
  return true;
}

}  // namespace rink::rti
