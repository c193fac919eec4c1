// Best-effort updates by datagram, where a federate has a way for them: what goes out, what was
// lost, and falling back to the stream.
#include <bit>

#include "rti/buffering/run_scope.h"
#include "rti/federation/federation_parts.h"
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

void FederationParts::list_best_effort() {
  for (const ObjectClass& each : fom_.object_classes()) {
    best_effort_.push_back(best_effort_attributes(each));
    has_best_effort_ |= !best_effort_.back().is_empty();
  }
}

void FederationParts::append_apart(std::uint32_t slot, ObjectSlot object, AttributeSet attributes,
                                   const Stamp& stamp, Bytes values) {
  const AttributeSet best_effort = attributes & by_datagram(object),
                     reliable(attributes.bits & ~best_effort.bits);
  if (best_effort.is_empty() || reliable.is_empty())
    return buffering_->append(slot, object, objects_[object], attributes, stamp, values);
  for (const AttributeSet part : {reliable, best_effort}) {
    values_.clear();
    cut_values(fom_.object_classes()[objects_[object].object_class], attributes, part, values,
               values_);
    buffering_->append(slot, object, objects_[object], part, stamp, values_);
  }
}

/// Where nothing is best-effort this is one comparison per federate and flush.
DatagramChannel FederationParts::begin_datagrams(Federate& federate, Outlet& outlet) {
  if (!has_best_effort_) return {};
  const std::size_t size_max =
      federate.has_stream_only ? 0 : outlet.datagram_max(federate.connection);
  const bool is_open = size_max >= 256;  // less is no use
  if (!federate.way && !is_open) return {};
  if (!federate.way) {
    federate.way = std::make_unique<DatagramWay>(batch_.lists());
    has_ways_ = true;
  }
  DatagramWay& way = *federate.way;
  way.ledger.expire(now_, way.due);
  const std::optional<double> silent_since = way.ledger.unanswered_since();
  const bool is_silent = silent_since && now_ - *silent_since > DatagramWay::fallback_after_s;
  if (!way.has_fallen_back && (!is_open || is_silent)) {
    way.has_fallen_back = true;
    way.probed_s = now_;
    way.ledger.abandon(way.due);
    ++counters_.datagram_fallbacks;
  }
  if (way.has_fallen_back && is_open && now_ - way.probed_s >= DatagramWay::probe_period_s)
    probe(federate, outlet);
  if (way.has_fallen_back) return {};
  const DatagramChannel channel{&way, size_max - DatagramHead::size};
  batch_.begin(channel.size_max);
  return channel;
}

void FederationParts::probe(Federate& federate, Outlet& outlet) {
  std::vector<std::byte> bytes;
  DatagramHead head{federate.way->ledger.note(now_), federate.frames};
  Writer writer(bytes);
  exchange(writer, head);
  const Datagram empty{bytes, {}};
  federate.way->probed_s = now_;
  ++counters_.datagrams_sent;
  counters_.bytes_sent += bytes.size();
  outlet.send_datagrams(federate.connection, std::span(&empty, 1));
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
    const Stamp stamp = newest_of(object);
    ++counters_.updates_sent;
    ++counters_.updates_repaired;
    if (context.channel.way != nullptr &&
        batch_.add(objects_[object].object_class, set, stamp, each.handle, values_))
      continue;
    frame.write_stamp(stamp);
    frame.say(UpdatesMessage{objects_[object].object_class, set.bits});
    RecordWriter(frame.bytes()).add(each.handle, values_);
  }
  way.due.clear();
}

bool FederationParts::gather_datagrams(std::size_t index, FlushContext& context) {
  const UpdateRun& run = context.runs[index];
  const FederateInterest& interest = context.interest;
  if (!best_effort_[run.object_class].includes(run.attributes)) return false;
  const CutRun& cut = batch_.cut(index, run, context.channel.size_max);
  if (!cut.fits) return false;
  const bool has_changed = changed_transportation_.size() > 0;
  const bool is_whole = !has_changed && interest.is_uniform && !interest.has_fresh &&
                        interest.by_class[run.object_class].includes(run.attributes);
  if (is_whole && is_all_in_scope(run, interest.heard())) {
    batch_.add(cut);
    counters_.updates_sent += run.slots.size();
    return true;
  }
  for_each_record(run, interest, [&](std::size_t record) {
    const AttributeSet wanted = interest.told(run.slots[record], run.object_class) & run.attributes;
    if (wanted.is_empty()) return;
    Bytes values = run.values(record);
    if (wanted != run.attributes) {
      values_.clear();
      cut_values(fom_.object_classes()[run.object_class], run.attributes, wanted, values, values_);
      values = values_;
    }
    ++counters_.updates_sent;
    if (!has_changed || by_datagram(run.slots[record]).includes(wanted))
      return void(
          batch_.add(run.object_class, wanted, run.stamp, run.records[record].handle, values));
    context.frame.write_stamp(run.stamp);
    context.frame.say(UpdatesMessage{run.object_class, wanted.bits});
    RecordWriter(context.frame.bytes()).add(run.records[record].handle, values);
  });
  return true;
}

void FederationParts::send_datagrams(FlushContext& context, Outlet& outlet) {
  JoinedFederate& federate = context.federate;
  DatagramWay* way = context.channel.way;
  if (way == nullptr || batch_.is_empty()) return;
  const std::span<const Datagram> datagrams = batch_.finish(federate.frames, way->ledger, now_);
  std::size_t size = 0;
  for (const Datagram& each : datagrams) size += each.head.size() + each.body.size();
  counters_.bytes_sent += size;
  counters_.update_bytes_sent += size;
  counters_.datagrams_sent += datagrams.size();
  federate.counts.bytes_received += size;
  // Who hears of us by datagrams, as its answers tell, needs no heartbeat beside them.
  if (const auto since = way->ledger.unanswered_since();
      !since || now_ - *since < settings_.patience.heartbeat_s)
    federate.last_said = now_;
  outlet.send_datagrams(federate.connection, datagrams);
}

}  // namespace rink::rti
