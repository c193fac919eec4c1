// The messages of declaration management: publications, subscriptions, advice about others'
// subscriptions, and notices of values kept back.
#pragma once

#include <cstdint>

#include "rti/handles.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// An empty set withdraws.
struct PublishObjectClassMessage {
  static constexpr MessageKind kind = MessageKind::publish_object_class;
  std::uint16_t object_class = 0;
  AttributeBits attributes = 0;
};
template <class Stream>
bool exchange(Stream& stream, PublishObjectClassMessage& message) {
  return stream.number(message.object_class) && attribute_word(stream, message.attributes);
}

/// An empty set withdraws; `region` is all ones for the default region.
struct SubscribeObjectClassMessage {
  static constexpr MessageKind kind = MessageKind::subscribe_object_class;
  std::uint16_t object_class = 0;
  AttributeBits attributes = 0;
  std::uint32_t region = RegionHandle::none;
  std::uint8_t is_passive = 0;
};
template <class Stream>
bool exchange(Stream& stream, SubscribeObjectClassMessage& message) {
  return stream.number(message.object_class) && attribute_word(stream, message.attributes) &&
         stream.number(message.region) && stream.range(message.is_passive, 1);
}

template <MessageKind k>
struct InteractionClassMessage {
  static constexpr MessageKind kind = k;
  std::uint16_t interaction_class = 0;
  std::uint8_t is_declared = 1;  ///< 0 withdraws; 2 subscribes passively
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, InteractionClassMessage<k>& message) {
  return stream.number(message.interaction_class) &&
         stream.range(message.is_declared, k == MessageKind::subscribe_interaction_class ? 2 : 1);
}
using PublishInteractionClassMessage =
    InteractionClassMessage<MessageKind::publish_interaction_class>;
using SubscribeInteractionClassMessage =
    InteractionClassMessage<MessageKind::subscribe_interaction_class>;

/// Advises a publisher of a class what others subscribe to (docs/rti.md, "Nobody listens").
struct ClassRelevanceMessage {
  static constexpr MessageKind kind = MessageKind::class_relevance;
  std::uint8_t is_interaction = 0;
  std::uint16_t number = 0;  ///< of the object or interaction class
  AttributeBits subscribed = 0,
                active = 0;  ///< attributes; 0 or 1 for an interaction class. `active`:
                             ///< of those by subscriptions that are not passive
};
template <class Stream>
bool exchange(Stream& stream, ClassRelevanceMessage& message) {
  return stream.range(message.is_interaction, 1) && stream.varint(message.number) &&
         attribute_bits(stream, message.subscribed) && attribute_bits(stream, message.active);
}

/// An object and some of its attributes. Downwards: attributes of an own object that are in some
/// federate's scope now. Upwards: attributes whose values are out of date since newer ones are kept
/// back.
template <MessageKind k>
struct ObjectAttributesMessage {
  static constexpr MessageKind kind = k;
  std::uint32_t object = 0;
  AttributeBits attributes = 0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, ObjectAttributesMessage<k>& message) {
  return stream.varint(message.object) && attribute_bits(stream, message.attributes);
}
using ObjectRelevanceMessage = ObjectAttributesMessage<MessageKind::object_relevance>;
using SpareUpdateMessage = ObjectAttributesMessage<MessageKind::spare_update>;

/// Whether the sender gets advice about the relevance of each of its objects.
struct AdvisorySwitchMessage {
  static constexpr MessageKind kind = MessageKind::advisory_switch;
  std::uint8_t is_on = 0;
};
template <class Stream>
bool exchange(Stream& stream, AdvisorySwitchMessage& message) {
  return stream.range(message.is_on, 1);
}

}  // namespace rink::rti
