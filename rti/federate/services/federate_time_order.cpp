// Sends and retracts messages in time-stamp order.
#include <algorithm>
#include <cassert>
#include <string>

#include "rti/federate/books/require.h"
#include "rti/federate/services/federate_time.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/time_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

const KnownObject& FederateTime::require_known(ObjectHandle object) const {
  const KnownObject* known = uses_.book.find(object);
  if (known == nullptr) throw RtiException(HlaError::object_instance_not_known, name_of(object));
  return *known;
}

void FederateTime::require_class(InteractionClassHandle interaction_class) const {
  if (interaction_class.value >= basis_.fom.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       std::to_string(interaction_class.value));
}

AttributeSet FederateTime::timestamped(ObjectHandle object, ObjectClassHandle object_class) const {
  const auto changed = order_changes_.find(object.value);
  if (changed != order_changes_.end()) return changed->second;
  AttributeSet set;
  const std::vector<Attribute>& attributes = basis_.fom.at(object_class).attributes;
  for (std::uint32_t i = 0; i < attributes.size(); ++i)
    if (attributes[i].order == Order::timestamp) set.insert({i});
  return set;
}

RetractionHandle FederateTime::send_content(const Moment& moment) {
  assert(!content_.empty());
  TimedSendMessage message;
  message.number = clock_.ask_send(moment.time.value);
  message.stamp = {moment.time.value, moment.tag};
  message.content = content_;
  basis_.frames.enqueue(message);
  ++basis_.counters.timed_sent;
  return {basis_.phase.federate(), message.number, moment.time.value};
}

void FederateTime::write_update(const UpdateHeader& header, ObjectHandle object, Bytes values) {
  content_.clear();
  UpdatesMessage message{static_cast<std::uint16_t>(header.object_class.value),
                         header.attributes.bits};
  write(content_, message);
  write_handle(content_, 0, object.value);
  const ObjectClass& object_class = basis_.fom.at(header.object_class);
  if (is_coded(object_class, header.attributes))
    encode(object_class, header.attributes, values, header.stamp.time, content_);
  else content_.insert(content_.end(), values.begin(), values.end());
  content_.push_back(std::byte{0});
}

RetractionHandle FederateTime::update(ObjectHandle object, AttributeSet attributes, Bytes values,
                                      const Moment& moment) {
  const KnownObject& known = require_known(object);
  const ObjectClassHandle object_class{known.object_class};
  const Stamp stamp{moment.time.value, moment.tag};
  const AttributeSet in_order =
      clock_.is_regulating() ? attributes & timestamped(object, object_class) : AttributeSet();
  if (in_order.is_empty()) {
    uses_.updates.update(object, attributes, values, stamp);
    return {};
  }
  clock_.check_send(moment.time.value);
  if (!known.is_own && !uses_.ownership.owned_of(object, known).includes(attributes))
    throw RtiException(HlaError::attribute_not_owned, name_of(object) + " is another federate's");
  uses_.updates.require_values(object_class, attributes, values);
  std::vector<std::byte> ordered, others;  // values of each order
  attributes.for_each([&](AttributeHandle each) {
    const Bytes value = basis_.fom.value(object_class, attributes, each, values);
    std::vector<std::byte>& part = in_order.contains(each) ? ordered : others;
    part.insert(part.end(), value.begin(), value.end());
  });
  const AttributeSet at_once = attributes.without(in_order);
  if (!at_once.is_empty()) uses_.updates.update(object, at_once, others, stamp);
  uses_.sparing.release(object);  // of receive order, and older
  uses_.sent.note({object_class, in_order, uses_.sent.newest()});
  write_update({object_class, in_order, stamp}, object, ordered);
  return send_content(moment);
}

RetractionHandle FederateTime::send(InteractionClassHandle interaction_class,
                                    FederateHandle receiver, Bytes parameters,
                                    const Moment& moment) {
  require_class(interaction_class);
  const Order order = interaction_orders_.empty() ? basis_.fom.at(interaction_class).order
                                                  : interaction_orders_[interaction_class.value];
  if (!clock_.is_regulating() || order == Order::receive ||
      basis_.fom.is_for_rti(interaction_class)) {
    uses_.updates.send(interaction_class, receiver, parameters, {moment.time.value, moment.tag});
    return {};
  }
  FederateUpdates::require_parameters(parameters);
  content_.clear();
  InteractionMessage message{
      static_cast<std::uint16_t>(interaction_class.value), receiver.value, {}, parameters};
  write(content_, message);
  const RetractionHandle handle = send_content(moment);
  ++basis_.counters.interactions_sent;
  return handle;
}

RetractionHandle FederateTime::delete_instance(ObjectHandle object, const Moment& moment) {
  if (!clock_.is_regulating()) {
    uses_.objects.delete_instance(object);
    return {};
  }
  const KnownObject& known = require_known(object);
  if (!uses_.ownership.owned_of(object, known).contains(privilege_to_delete_object))
    throw RtiException(HlaError::delete_privilege_not_held,
                       name_of(object) + " is another federate's");
  content_.clear();
  DeleteObjectMessage message{object.value};
  write(content_, message);
  const RetractionHandle handle = send_content(moment);
  std::erase_if(deletions_,
                [this](const TimedDeletion& each) { return each.time < clock_.earliest_ever(); });
  deletions_.push_back({handle.number, object.value, uses_.book.hide(object), moment.time.value});
  return handle;
}

void FederateTime::retract(const RetractionHandle& handle) {
  clock_.ask_retraction(handle, basis_.phase.federate());
  basis_.frames.enqueue(RetractMessage{handle.number});
  const auto deletion = std::ranges::find(deletions_, handle.number, &TimedDeletion::number);
  if (deletion == deletions_.end()) return;
  uses_.book.restore({deletion->object}, deletion->known);
  deletions_.erase(deletion);
}

void FederateTime::change_order(ObjectHandle object, AttributeSet attributes, Order order) {
  const KnownObject& known = require_known(object);
  const ObjectClassHandle object_class{known.object_class};
  if (!basis_.fom.attributes(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_defined,
                       "in class " + basis_.fom.at(object_class).name);
  if (!uses_.ownership.owned_of(object, known).includes(attributes))
    throw RtiException(HlaError::attribute_not_owned, name_of(object) + " is another federate's");
  const AttributeSet before = timestamped(object, object_class);
  order_changes_[object.value] =
      order == Order::timestamp ? before | attributes : before.without(attributes);
}

void FederateTime::change_order(InteractionClassHandle interaction_class, Order order) {
  require_class(interaction_class);
  if (interaction_orders_.empty())
    for (const InteractionClass& each : basis_.fom.interaction_classes())
      interaction_orders_.push_back(each.order);
  interaction_orders_[interaction_class.value] = order;
}

bool FederateTime::is_sound() const {
  const std::size_t orders = interaction_orders_.size();
  return (orders == 0 || orders == basis_.fom.interaction_classes().size()) &&
         std::ranges::all_of(interaction_orders_,
                             [](Order each) { return each <= Order::timestamp; }) &&
         std::ranges::all_of(deletions_, [&](const TimedDeletion& each) {
           return each.known.object_class < basis_.fom.object_classes().size();
         });
}

}  // namespace rink::rti
