// Reads blocks of updates, object by object.
#include "rti/federate/delivery/update_receiver.h"

#include <cassert>

#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

bool UpdateReceiver::handle_stamp(Reader& reader, ReadContext& context) {
  StampMessage message;
  if (!exchange(reader, message)) return false;
  context.stamp = message.stamp;
  return true;
}

bool UpdateReceiver::handle_stamp_step(Reader& reader, ReadContext& context) {
  StampStepMessage message;
  Stamp stamp;
  if (!exchange(reader, message) || !follow(stamp_steps_, message, stamp)) return false;
  context.stamp = stamp;
  return true;
}

bool UpdateReceiver::handle_updates(Reader& reader, const ReadContext& context) {
  UpdatesMessage message;
  if (!exchange(reader, message) || !context.stamp ||
      message.object_class >= basis_.fom.object_classes().size())
    return false;
  const AttributeSet attributes{message.attributes};
  if (!basis_.fom.attributes(ObjectClassHandle{message.object_class}).includes(attributes))
    return false;
  const FrameBlock block = frame_block(message.object_class, attributes, context);
  const bool is_read = read_records(
      reader, block.of.object_class, attributes,
      [&](std::uint32_t object, Bytes values) { return reflect(block, {object}, values); });
  return is_read || !basis_.phase.is_joined();
}

bool UpdateReceiver::reflect_entry(const EntriesMessage& block, ObjectHandle object, Bytes coded,
                                   const ReadContext& context) {
  return reflect(frame_block(block.object_class, AttributeSet{block.attributes}, context), object,
                 coded);
}

bool UpdateReceiver::reflect_held(const EntriesMessage& block, ObjectHandle object, Bytes values,
                                  const ReadContext& context) {
  return deliver(frame_block(block.object_class, AttributeSet{block.attributes}, context), object,
                 values);
}

UpdateReceiver::FrameBlock UpdateReceiver::frame_block(std::uint16_t number,
                                                       AttributeSet attributes,
                                                       const ReadContext& context) const {
  const ObjectClass& object_class = basis_.fom.at(ObjectClassHandle{number});
  return {{object_class, attributes, *context.stamp},
          number,
          is_coded(object_class, attributes),
          residuals_.is_concerned(number, attributes),
          context.timed};
}

bool UpdateReceiver::reflect(const FrameBlock& block, ObjectHandle object, Bytes values) {
  const KnownObject* known = objects_.find(object);
  if (known == nullptr) return objects_.is_gone(object);
  if (known->object_class != block.number) return false;
  const auto& [object_class, attributes, stamp] = block.of;
  if (block.has_codec) {
    decoded_.clear();
    if (!decode(object_class, attributes, values, stamp.time, decoded_)) return false;
    values = decoded_;
  }
  if (block.has_residuals) residuals_.keep(object, block.number, attributes, values);
  return deliver(block, object, values);
}

/// Of a known object of the block's class.
bool UpdateReceiver::deliver(const FrameBlock& block, ObjectHandle object, Bytes values) {
  const auto& [object_class, attributes, stamp] = block.of;
  ++basis_.counters.updates_reflected;
  arrivals_.note_from_frame(object, block.number, attributes);
  if (block.timed != nullptr)
    basis_.callbacks.reflect_attribute_values_with_time(object, attributes, values, *block.timed);
  else basis_.callbacks.reflect_attribute_values(object, attributes, values, stamp);
  return basis_.phase.is_joined();
}

bool UpdateReceiver::handle_datagram_updates(Reader& reader, const DatagramHead& head,
                                             const ReadContext& context) {
  UpdatesMessage message;
  if (!exchange(reader, message) || !context.stamp ||
      message.object_class >= basis_.fom.object_classes().size())
    return false;
  const Block block{basis_.fom.at(ObjectClassHandle{message.object_class}),
                    AttributeSet{message.attributes}, *context.stamp};
  if (!arrivals_.order().best_effort(message.object_class).includes(block.attributes)) return false;
  const bool is_read = read_records(
      reader, block.object_class, block.attributes, [&](std::uint32_t object, Bytes values) {
        const KnownObject* known = objects_.find({object});
        // An object that is unknown or out of scope by now has been or will be sent with its full
        // state.
        const bool is_known = known != nullptr && known->object_class == message.object_class;
        const AttributeSet accepted =
            is_known ? arrivals_.accept({object}, message.object_class, block.attributes, head)
                     : AttributeSet();
        if (accepted.is_empty()) return ++basis_.counters.updates_outdated, true;
        return reflect_datagram(block, {object}, accepted, values);
      });
  return is_read || !basis_.phase.is_joined();
}

bool UpdateReceiver::reflect_datagram(const Block& block, ObjectHandle object,
                                      AttributeSet accepted, Bytes values) {
  assert(!accepted.is_empty() && block.attributes.includes(accepted));
  if (accepted != block.attributes) values = choose(block, accepted, values);
  if (is_coded(block.object_class, accepted)) {
    decoded_.clear();
    if (!decode(block.object_class, accepted, values, block.stamp.time, decoded_)) return false;
    values = decoded_;
  }
  ++basis_.counters.updates_reflected;
  basis_.callbacks.reflect_attribute_values(object, accepted, values, block.stamp);
  return basis_.phase.is_joined();
}

/// Returns the values of `accepted` alone.
Bytes UpdateReceiver::choose(const Block& block, AttributeSet accepted, Bytes values) {
  chosen_.clear();
  for (const AttributeHandle attribute : accepted) {
    const Bytes value = coded_value(block.object_class, block.attributes, attribute, values);
    chosen_.insert(chosen_.end(), value.begin(), value.end());
  }
  return chosen_;
}

bool UpdateReceiver::handle_interaction(Reader& reader, const ReadContext& context) {
  InteractionMessage message;
  if (!exchange(reader, message) ||
      message.interaction_class >= basis_.fom.interaction_classes().size())
    return false;
  ++basis_.counters.interactions_received;
  if (context.timed != nullptr)
    basis_.callbacks.receive_interaction_with_time({message.interaction_class}, message.parameters,
                                                   {message.federate}, *context.timed);
  else
    basis_.callbacks.receive_interaction({message.interaction_class}, message.parameters,
                                         {message.federate}, message.stamp);
  return true;
}

}  // namespace rink::rti
