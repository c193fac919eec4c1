// Chooses datagrams or the stream for each update, and repairs lost datagrams.
#include "rti/federate/delivery/update_sender.h"

#include <cassert>

#include "rti/buffering/best_effort_outbox.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

UpdateSender::UpdateSender(const AmbassadorBasis& basis, const Uses& uses)
    : basis_(basis), uses_(uses) {}
UpdateSender::~UpdateSender() = default;

void UpdateSender::expect_datagrams(std::size_t size_max) {
  const ArrivalOrder& order = uses_.arrivals.order();
  if (!outbox_ && size_max >= BestEffortOutbox::size_min && order.has_best_effort()) {
    // A federate that publishes no best-effort attribute, such as most of a crowd, needs no outbox.
    for (std::uint32_t i = 0; i < uses_.classes.object_class_count() && !outbox_; ++i)
      if (!(uses_.classes.published({i}) & order.best_effort(static_cast<std::uint16_t>(i)))
               .is_empty())
        outbox_ = std::make_unique<BestEffortOutbox>(basis_.fom);
  }
  if (outbox_) outbox_->set_size(size_max);
}

/// The attributes that travel by datagram: none if the federate uses time management or its objects
/// outlive it.
AttributeSet UpdateSender::by_datagram(ObjectHandle object, ObjectClassHandle object_class) const {
  if (!outbox_ || !outbox_->is_usable() || keeps_time_ || !uses_.ownership.is_deleting()) return {};
  const AttributeSet* reliable = made_reliable_.find(object);
  return outbox_->best_effort(object_class)
      .without(reliable != nullptr ? *reliable : AttributeSet());
}

void UpdateSender::send(const UpdateHeader& header, ObjectHandle object, Bytes values) {
  assert(!header.attributes.is_empty());
  if (!outbox_) return send_by_stream(header, object, values);
  const AttributeSet rest = send_by_datagram(header, object, values);
  if (!rest.is_empty()) send_by_stream({header.object_class, rest, header.stamp}, object, values);
}

void UpdateSender::send_by_stream(const UpdateHeader& header, ObjectHandle object, Bytes values) {
  if (outbox_) before_stream(object, header.object_class, header.attributes);
  if (basis_.frames.enqueue_update(header, object, values)) uses_.sent.note(header);
  ++basis_.counters.updates_sent;
}

/// Sends the part of an update that travels by datagram. Returns the other attributes and leaves
/// their values in `values`.
AttributeSet UpdateSender::send_by_datagram(const UpdateHeader& header, ObjectHandle object,
                                            Bytes& values) {
  assert(outbox_);
  const AttributeSet best_effort = header.attributes & by_datagram(object, header.object_class);
  if (best_effort.is_empty()) return header.attributes;
  const AttributeSet rest = header.attributes.without(best_effort);
  Bytes sent = values;
  if (!rest.is_empty()) {
    best_effort_values_.clear(), other_values_.clear();
    header.attributes.for_each([&](AttributeHandle each) {
      const Bytes value =
          coded_value(basis_.fom.at(header.object_class), header.attributes, each, values);
      std::vector<std::byte>& part =
          best_effort.contains(each) ? best_effort_values_ : other_values_;
      part.insert(part.end(), value.begin(), value.end());
    });
    sent = best_effort_values_;
  }
  if (!outbox_->enqueue(object, header.object_class, best_effort, header.stamp, sent))
    return header.attributes;
  uses_.sent.note({header.object_class, best_effort, header.stamp});
  ++basis_.counters.updates_sent;
  values = other_values_;
  return rest;
}

void UpdateSender::before_stream(ObjectHandle object, ObjectClassHandle object_class,
                                 AttributeSet attributes) {
  if (!outbox_ || (attributes & outbox_->best_effort(object_class)).is_empty()) return;
  if (outbox_->is_pending()) {
    outbox_->seal(basis_.frames.frames_since_join(), uses_.watch.now());
    basis_.frames.close_frame();
  }
  outbox_->forget(object, attributes);
}

void UpdateSender::release(ObjectHandle object, AttributeSet attributes) {
  const BestEffortOutbox::Kept* kept = outbox_ ? outbox_->find(object) : nullptr;
  if (kept == nullptr || !basis_.phase.is_joined()) return;
  const BestEffortOutbox::Kept newest = *kept;
  (newest.attributes & attributes).for_each([&](AttributeHandle each) {
    const BestEffortOutbox::Value& value = newest.values[each.value];
    send_by_stream({{newest.object_class}, AttributeSet{each}, value.stamp}, object, value.coded);
  });
}

void UpdateSender::release(ObjectClassHandle object_class) {
  if (!outbox_) return;
  for (const ObjectHandle object : outbox_->list())
    if (outbox_->find(object)->object_class == object_class.value)
      release(object, AttributeSet::all());
}

void UpdateSender::release_all() {
  if (!outbox_) return;
  for (const ObjectHandle object : outbox_->list()) release(object, AttributeSet::all());
}

void UpdateSender::keep_time() {
  release_all();
  keeps_time_ = true;
}

void UpdateSender::make_reliable(ObjectHandle object, AttributeSet attributes) {
  release(object, attributes);
  made_reliable_[object] = made_reliable_[object] | attributes;
}

void UpdateSender::make_best_effort(ObjectHandle object, AttributeSet attributes) {
  if (AttributeSet* reliable = made_reliable_.find(object); reliable != nullptr)
    *reliable = reliable->without(attributes);
}

void UpdateSender::forget(ObjectHandle object) {
  made_reliable_.erase(object);
  if (outbox_) outbox_->forget(object, AttributeSet::all());
}

void UpdateSender::repair() {
  if (!outbox_) return;
  outbox_->advance_clock(uses_.watch.now(), basis_.frames.frames_since_join());
  std::vector<DatagramLedger::Lost> due;
  due.swap(outbox_->due());
  for (const DatagramLedger::Lost& each : due) {
    const ObjectHandle object{each.handle};
    const BestEffortOutbox::Kept* kept = outbox_->find(object);
    if (kept == nullptr || uses_.objects.find(object) == nullptr) continue;
    const BestEffortOutbox::Kept newest = *kept;
    (newest.attributes & each.attributes).for_each([&](AttributeHandle one) {
      const BestEffortOutbox::Value& value = newest.values[one.value];
      const UpdateHeader header{{newest.object_class}, AttributeSet{one}, value.stamp};
      ++basis_.counters.updates_repaired;
      const bool is_sent = by_datagram(object, header.object_class).contains(one) &&
                           outbox_->enqueue(object, header.object_class, header.attributes,
                                            value.stamp, value.coded);
      if (!is_sent) send_by_stream(header, object, value.coded);
    });
  }
}

bool UpdateSender::acknowledge(const AcknowledgeDatagramsMessage& message) {
  return outbox_ && outbox_->acknowledge(message, uses_.watch.now());
}

std::span<const Datagram> UpdateSender::datagrams(Bytes acknowledgement) {
  datagrams_.clear();
  if (!acknowledgement.empty()) datagrams_.push_back({acknowledgement, {}});
  if (!outbox_) return datagrams_;
  outbox_->seal(basis_.frames.frames_since_join(), uses_.watch.now());
  for (const Datagram& each : outbox_->datagrams()) datagrams_.push_back(each);
  return datagrams_;
}

void UpdateSender::clear_datagrams() {
  for (const Datagram& each : datagrams_) basis_.counters.bytes_sent += each.head.size();
  basis_.counters.datagrams_sent += datagrams_.size();
  datagrams_.clear();
  if (!outbox_) return;
  outbox_->clear();
  basis_.counters.datagram_fallbacks = outbox_->fallbacks;
  basis_.counters.datagram_recoveries = outbox_->recoveries;
}

std::size_t UpdateSender::memory_bytes() const {
  return made_reliable_.memory_bytes() + (outbox_ ? outbox_->memory_bytes() : 0);
}

}  // namespace rink::rti
