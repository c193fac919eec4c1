// Gathers updates into datagrams, seals them, and sends lost values again.
#include "rti/buffering/best_effort_outbox.h"

#include <cassert>

#include "rti/fom/coded_values.h"

namespace rink::rti {

BestEffortOutbox::BestEffortOutbox(const Fom& fom) : fom_(fom) {
  for (const ObjectClass& each : fom.object_classes())
    best_effort_.push_back(best_effort_attributes(each));
}

bool BestEffortOutbox::enqueue(ObjectHandle object, ObjectClassHandle object_class,
                               AttributeSet set, const Stamp& stamp, Bytes coded) {
  assert(is_usable() && best_effort(object_class).includes(set));
  if (batch_.is_empty()) begin();
  if (!batch_.add(static_cast<std::uint16_t>(object_class.value), set, stamp, object.value, coded))
    return false;
  Kept& kept = kept_[object];
  kept.object_class = static_cast<std::uint16_t>(object_class.value);
  kept.values.resize(fom_.at(object_class).attributes.size());
  set.for_each([&](AttributeHandle each) {
    const Bytes value = coded_value(fom_.at(object_class), set, each, coded);
    kept.values[each.value].stamp = stamp;
    kept.values[each.value].coded.assign(value.begin(), value.end());
  });
  kept.attributes = kept.attributes | set;
  return true;
}

void BestEffortOutbox::seal(std::uint32_t frames, double now) {
  if (batch_.is_empty()) return;
  for (const Datagram& each : batch_.finish(frames, channel_.ledger, now)) {
    bytes_.insert(bytes_.end(), each.head.begin(), each.head.end());
    bytes_.insert(bytes_.end(), each.body.begin(), each.body.end());
    ends_.push_back(bytes_.size());
  }
  begin();
}

std::vector<ObjectHandle> BestEffortOutbox::list() const {
  std::vector<ObjectHandle> all;
  kept_.for_each([&](ObjectHandle object, const Kept&) { all.push_back(object); });
  return all;
}

void BestEffortOutbox::forget(ObjectHandle object, AttributeSet attributes) {
  Kept* kept = kept_.find(object);
  if (kept == nullptr) return;
  kept->attributes = kept->attributes.without(attributes);
  if (kept->attributes.is_empty()) kept_.erase(object);
}

bool BestEffortOutbox::acknowledge(const AcknowledgeDatagramsMessage& message, double now) {
  if (!channel_.ledger.acknowledge(message, now, channel_.due)) return false;
  if (channel_.has_fallen_back) ++recoveries;
  channel_.has_fallen_back = false;
  return true;
}

void BestEffortOutbox::advance_clock(double now, std::uint32_t frames) {
  channel_.ledger.expire(now, channel_.due);
  const std::optional<double> since = channel_.ledger.unanswered_since();
  const bool is_open = size_max_ >= size_min,
             is_silent = since && now - *since > DatagramChannel::fallback_after_s;
  if (!channel_.has_fallen_back && (is_silent || (!is_open && channel_.ledger.unsettled() > 0))) {
    channel_.has_fallen_back = true;
    channel_.probed_s = now;
    channel_.ledger.abandon(channel_.due);
    ++fallbacks;
  }
  if (!channel_.has_fallen_back || !is_open ||
      now - channel_.probed_s < DatagramChannel::probe_period_s)
    return;
  channel_.probed_s = now;
  DatagramHead head{channel_.ledger.note(now), frames};
  Writer writer(bytes_);
  exchange(writer, head);
  ends_.push_back(bytes_.size());
}

std::span<const Datagram> BestEffortOutbox::datagrams() {
  sealed_.clear();
  std::size_t from = 0;
  for (const std::size_t end : ends_) {
    sealed_.push_back({Bytes(bytes_).subspan(from, end - from), {}});
    from = end;
  }
  assert(from == bytes_.size());  // each sealed byte is in one of them
  return sealed_;
}

void BestEffortOutbox::clear() {
  sent += ends_.size();
  bytes_.clear();
  ends_.clear();
}

}  // namespace rink::rti
