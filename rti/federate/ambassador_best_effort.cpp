// Best-effort updates of a federate's own on their way to the RTI: by datagram where there is a
// way, and never out of order with what goes by the stream.
#include "rti/buffering/best_effort_outbox.h"
#include "rti/federate/ambassador_services.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

AmbassadorParts::~AmbassadorParts() = default;

void AmbassadorServices::expect_datagrams(std::size_t size_max) {
  if (size_max > 0) arrivals_.expect_datagrams();
  if (!outbox_ && size_max >= BestEffortOutbox::size_min && arrivals_.order().has_best_effort()) {
    // Who publishes no such attribute, as most of a crowd, needs none.
    for (std::uint16_t i = 0; i < declared_.objects.size() && !outbox_; ++i)
      if (!(declared_.objects[i].published & arrivals_.order().best_effort(i)).is_empty())
        outbox_ = std::make_unique<BestEffortOutbox>(fom_);
  }
  if (outbox_) outbox_->set_size(size_max);
}

/// Who keeps time, or leaves objects behind, says everything by the stream.
AttributeSet AmbassadorParts::by_datagram(ObjectHandle object,
                                          ObjectClassHandle object_class) const {
  if (!outbox_ || !outbox_->is_usable() || is_timed_ || !declared_.is_deleting) return {};
  const AttributeSet* reliable = made_reliable_.find(object);
  return outbox_->best_effort(object_class)
      .without(reliable != nullptr ? *reliable : AttributeSet());
}

/// Sends those of an update that go by datagram, and leaves the others, with their values in
/// `cut_values_`. `values` are coded.
AttributeSet AmbassadorParts::say_best_effort(ObjectHandle object, ObjectClassHandle object_class,
                                              AttributeSet attributes, Bytes& values,
                                              const Stamp& stamp) {
  const AttributeSet best_effort = attributes & by_datagram(object, object_class);
  if (best_effort.is_empty()) return attributes;
  const AttributeSet rest = attributes.without(best_effort);
  Bytes said = values;
  if (!rest.is_empty()) {
    best_effort_values_.clear(), cut_values_.clear();
    attributes.for_each([&](AttributeHandle each) {
      const Bytes value = coded_value(fom_.at(object_class), attributes, each, values);
      std::vector<std::byte>& part = best_effort.contains(each) ? best_effort_values_ : cut_values_;
      part.insert(part.end(), value.begin(), value.end());
    });
    said = best_effort_values_;
  }
  if (!outbox_->say(object, object_class, best_effort, stamp, said)) return attributes;
  declared_.note_sent(object_class, best_effort, stamp);
  ++counters_.updates_sent;
  values = cut_values_;
  return rest;
}

/// Something about these attributes goes by the stream. What was said of any by datagram was said
/// before: in a frame that is over.
void AmbassadorParts::before_stream(ObjectHandle object, ObjectClassHandle object_class,
                                    AttributeSet attributes) {
  if (!outbox_ || (attributes & outbox_->best_effort(object_class)).is_empty()) return;
  if (outbox_->is_pending()) {
    outbox_->seal(frames_.frames_since_join(), watch_.now());
    frames_.close_frame();
  }
  outbox_->forget(object, attributes);
}

/// Sends by the stream what went by datagram, for it may outlive its owner or go to another.
void AmbassadorParts::release_best_effort(ObjectHandle object, AttributeSet attributes) {
  const BestEffortOutbox::Kept* kept = outbox_ ? outbox_->find(object) : nullptr;
  if (kept == nullptr || !phase_.is_joined()) return;
  const BestEffortOutbox::Kept newest = *kept;
  (newest.attributes & attributes).for_each([&](AttributeHandle each) {
    const BestEffortOutbox::Value& value = newest.values[each.value];
    say_update(object, {newest.object_class}, AttributeSet{each}, value.coded, value.stamp);
  });
}

void AmbassadorParts::release_best_effort() {
  if (!outbox_) return;
  for (const ObjectHandle object : outbox_->list()) release_best_effort(object, AttributeSet(~0u));
}

void AmbassadorParts::release_best_effort(ObjectClassHandle object_class) {
  if (!outbox_) return;
  for (const ObjectHandle object : outbox_->list())
    if (outbox_->find(object)->object_class == object_class.value)
      release_best_effort(object, AttributeSet(~0u));
}

/// What was lost is said again as it is now: by datagram or, if there is no way any more, by the
/// stream.
void AmbassadorParts::repair_best_effort() {
  outbox_->advance_clock(watch_.now(), frames_.frames_since_join());
  std::vector<DatagramLedger::Lost> due;
  due.swap(outbox_->due());
  for (const DatagramLedger::Lost& each : due) {
    const ObjectHandle object{each.handle};
    const BestEffortOutbox::Kept* kept = outbox_->find(object);
    if (kept == nullptr || objects_.find(object) == nullptr) continue;
    const BestEffortOutbox::Kept newest = *kept;
    (newest.attributes & each.attributes).for_each([&](AttributeHandle one) {
      const BestEffortOutbox::Value& value = newest.values[one.value];
      ++counters_.updates_repaired;
      const bool goes_by_datagram = by_datagram(object, {newest.object_class}).contains(one);
      const bool is_said =
          goes_by_datagram &&
          outbox_->say(object, {newest.object_class}, AttributeSet{one}, value.stamp, value.coded);
      if (!is_said)
        say_update(object, {newest.object_class}, AttributeSet{one}, value.coded, value.stamp);
    });
  }
}

std::span<const Datagram> AmbassadorServices::outgoing_datagrams() {
  datagrams_.clear();
  if (!acknowledgement_.empty()) datagrams_.push_back({acknowledgement_, {}});
  if (!outbox_) return datagrams_;
  outbox_->seal(frames_.frames_since_join(), watch_.now());
  for (const Datagram& each : outbox_->datagrams()) datagrams_.push_back(each);
  return datagrams_;
}

void AmbassadorServices::clear_outgoing_datagrams() {
  for (const Datagram& each : datagrams_) counters_.bytes_sent += each.head.size();
  counters_.datagrams_sent += datagrams_.size();
  datagrams_.clear();
  acknowledgement_.clear();
  if (!outbox_) return;
  outbox_->clear();
  counters_.datagram_fallbacks = outbox_->fallbacks;
  counters_.datagram_recoveries = outbox_->recoveries;
}

}  // namespace rink::rti
