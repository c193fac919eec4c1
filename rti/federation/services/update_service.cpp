// Applies blocks of updates to the objects' states and puts them into the next flush.
#include "rti/federation/services/update_service.h"

#include <cassert>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

void UpdateService::joined(std::uint32_t slot) {
  if (slot >= stamps_.size()) stamps_.resize(slot + 1);
  stamps_[slot].reset();
}

Status UpdateService::handle_stamp(std::uint32_t slot, Reader& reader) {
  StampMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  stamps_[slot] = message.stamp;
  return std::nullopt;
}

Status UpdateService::handle_updates(std::uint32_t slot, Reader& reader) {
  UpdatesMessage message;
  if (!exchange(reader, message) || !stamps_[slot]) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{message.object_class};
  const AttributeSet attributes{message.attributes};
  if (!basis_.fom.attributes(object_class).includes(attributes) || attributes.is_empty())
    return Violation::unknown_name;
  if (!uses_.publications.of_class(slot, message.object_class).includes(attributes))
    return Violation::undeclared;
  Status status;
  const bool is_read = read_records(reader, basis_.fom.at(object_class), attributes,
                                    [&](std::uint32_t handle, Bytes values) {
                                      status = take(slot, message, {handle}, values);
                                      return !status;
                                    });
  return is_read || status ? status : Violation::malformed;
}

Status UpdateService::take(std::uint32_t slot, const UpdatesMessage& message, ObjectHandle handle,
                           Bytes values) {
  const ObjectSlot object = basis_.objects.find(handle);
  if (object == no_object && uses_.known.is_late(handle)) return std::nullopt;
  if (object == no_object || basis_.objects[object].object_class != message.object_class)
    return Violation::unknown_name;
  const AttributeSet attributes{message.attributes};
  if (basis_.objects[object].owner != slot &&
      !uses_.ownership.owned_by(slot, object).includes(attributes))
    return Violation::not_owned;
  const Stamp& stamp = *stamps_[slot];
  uses_.newest.note(slot, stamp);
  uses_.arrivals.accept_frame(slot, handle, message.object_class, attributes);
  store(slot, object, attributes, stamp, values);
  return std::nullopt;
}

void UpdateService::store(std::uint32_t slot, ObjectSlot object, AttributeSet attributes,
                          const Stamp& stamp, Bytes values) {
  assert(basis_.objects[object].is_alive && !attributes.is_empty());
  basis_.objects.store(object, attributes, values);
  const Object& updated = basis_.objects[object];
  uses_.sender.append(
      {.owner = slot,
       .slot = object,
       .object = updated,
       .attributes = attributes,
       .stamp = stamp,
       .values = values,
       .residual = uses_.residuals.take(updated, object, attributes, stamp.time, values)});
  uses_.distribution.object_updated(object);
  ++basis_.counters.updates_received;
  ++basis_.federates[slot].counts.updates_sent;
}

Status UpdateService::handle_spare(std::uint32_t slot, Reader& reader) {
  SpareUpdateMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  ObjectSlot object = no_object;
  if (const Status status = uses_.known.find({message.object}, object);
      status || object == no_object)
    return status;
  const AttributeSet attributes{message.attributes};
  if (!uses_.ownership.owned_by(slot, object).includes(attributes)) return Violation::not_owned;
  Object& spared = basis_.objects[object];
  spared.valued = spared.valued.without(attributes);
  spared.changed_static = spared.changed_static | attributes;
  // Who discovers the object now lacks these values.
  uses_.residuals.forget(spared, object, attributes);
  uses_.arrivals.accept_frame(slot, spared.handle, spared.object_class, attributes);
  return std::nullopt;
}

}  // namespace rink::rti
