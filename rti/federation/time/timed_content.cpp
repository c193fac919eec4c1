// Reads and checks messages in time-stamp order.
#include "rti/federation/time/timed_content.h"

#include "rti/wire/time_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

Status TimedContentReader::read(std::uint32_t slot, Bytes bytes, StampedMessage& message) {
  Reader content(bytes);
  std::uint8_t kind = 0;
  content.number(kind);
  message.kind = static_cast<MessageKind>(kind);
  Status status = Violation::malformed;
  if (message.kind == MessageKind::updates) status = read_update(slot, content, message);
  if (message.kind == MessageKind::interaction) status = read_interaction(slot, content, message);
  if (message.kind == MessageKind::delete_object) status = read_deletion(slot, content, message);
  if (!status && !content.is_at_end()) status = Violation::malformed;
  return status;
}

Status TimedContentReader::read_update(std::uint32_t slot, Reader& content,
                                       StampedMessage& message) {
  UpdatesMessage header;
  if (!exchange(content, header)) return Violation::malformed;
  if (header.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const ObjectClassHandle object_class{header.object_class};
  const AttributeSet attributes{header.attributes};
  if (!basis_.fom.attributes(object_class).includes(attributes) || attributes.is_empty())
    return Violation::unknown_name;
  if (!publications_.of_class(slot, header.object_class).includes(attributes))
    return Violation::undeclared;
  std::size_t records = 0;
  const bool is_read = read_records(content, basis_.fom.at(object_class), attributes,
                                    [&](std::uint32_t handle, Bytes values) {
                                      message.object = handle;
                                      message.body.assign(values.begin(), values.end());
                                      return ++records == 1;
                                    });
  if (!is_read || records != 1) return Violation::malformed;
  const ObjectSlot object = basis_.objects.find({message.object});
  const bool is_late =
      object == no_object && known_.is_late({message.object});  // then the message has no receivers
  if (!is_late &&
      (object == no_object || basis_.objects[object].object_class != header.object_class))
    return Violation::unknown_name;
  if (!is_late && !ownership_.owned_by(slot, object).includes(attributes))
    return Violation::not_owned;
  message.class_number = header.object_class;
  message.attributes = attributes;
  return std::nullopt;
}

Status TimedContentReader::read_interaction(std::uint32_t slot, Reader& content,
                                            StampedMessage& message) {
  InteractionMessage wire;
  if (!exchange(content, wire)) return Violation::malformed;
  if (wire.interaction_class >= basis_.fom.interaction_classes().size())
    return Violation::unknown_name;
  if (!publications_.has_interaction(slot, wire.interaction_class)) return Violation::undeclared;
  message.class_number = wire.interaction_class;
  message.only = {wire.federate};
  message.body.assign(wire.parameters.begin(), wire.parameters.end());
  return std::nullopt;
}

Status TimedContentReader::read_deletion(std::uint32_t slot, Reader& content,
                                         StampedMessage& message) {
  DeleteObjectMessage wire;
  if (!exchange(content, wire)) return Violation::malformed;
  const ObjectSlot object = basis_.objects.find({wire.object});
  const bool is_late = object == no_object
                           ? known_.is_late({wire.object})
                           : basis_.objects[object].is_leaving && known_.is_late({wire.object});
  if (is_late) {  // a second deletion has no effect, whether or not the first is retracted
    message.object = ObjectHandle::none;
    return std::nullopt;
  }
  if (object == no_object) return Violation::unknown_name;
  if (!ownership_.owned_by(slot, object).contains(privilege_to_delete_object))
    return Violation::not_owned;
  basis_.objects[object].is_leaving = true;
  message.object = wire.object;
  return std::nullopt;
}

}  // namespace rink::rti
