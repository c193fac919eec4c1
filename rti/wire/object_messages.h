// The messages of object management beyond updates: names, local deletion, transportation, requests
// for updates.
#pragma once

#include "rti/wire/message.h"

namespace rink::rti {

inline constexpr std::size_t names_size_max =
    32 * 1024;  ///< of a set of names as it travels [bytes]
inline constexpr std::size_t request_tag_max =
    1024;  ///< longest user-supplied tag of a request for updates [bytes]

/// Names as they travel: texts one after the other. Calls `visit(name)` for each; false if they are
/// cut short, if one is empty, or if there is none.
template <class Visit>
bool for_each_name(Bytes names, Visit visit) {
  Reader reader(names);
  if (reader.is_at_end()) return false;
  while (!reader.is_at_end()) {
    std::string_view name;
    if (!reader.text(name, text_max) || name.empty()) return false;
    visit(name);
  }
  return true;
}

/// A request about names; a set is granted or refused as a whole.
enum class NameRequest : std::uint8_t { reserve, reserve_set, release };
/// The answer. The last one answers a registration by a name that was not free: the object has its
/// default name.
enum class NameAnswer : std::uint8_t {
  granted,
  set_granted,
  refused,
  set_refused,
  registration_refused
};

template <MessageKind k, std::uint8_t word_max>
struct NamesMessage {
  static constexpr MessageKind kind = k;
  std::uint8_t word = 0;  ///< a NameRequest upwards, a NameAnswer downwards
  Bytes names;
};
template <class Stream, MessageKind k, std::uint8_t word_max>
bool exchange(Stream& stream, NamesMessage<k, word_max>& message) {
  return stream.range(message.word, word_max) &&
         stream.template bytes<std::uint16_t>(message.names, names_size_max);
}
using InstanceNamesMessage = NamesMessage<MessageKind::instance_names, 2>;
using InstanceNamesAnswerMessage = NamesMessage<MessageKind::instance_names_answer, 4>;

using LocalDeleteMessage = ObjectHandleMessage<MessageKind::local_delete>;

/// Asks the owners of a class's objects, or of one object, for values.
struct RequestUpdateMessage {
  static constexpr MessageKind kind = MessageKind::request_update;
  std::uint8_t is_class = 0;
  std::uint32_t number = 0;  ///< the class, or the object's handle
  AttributeBits attributes = 0;
  Bytes tag;
};
template <class Stream>
bool exchange(Stream& stream, RequestUpdateMessage& message) {
  return stream.range(message.is_class, 1) && stream.varint(message.number) &&
         attribute_bits(stream, message.attributes) &&
         stream.template bytes<std::uint16_t>(message.tag, request_tag_max);
}

/// Asks to change the transportation of attributes of an own object, or of the interactions that
/// its sender sends of a class.
struct ChangeTransportationMessage {
  static constexpr MessageKind kind = MessageKind::change_transportation;
  std::uint8_t is_interaction = 0;
  std::uint32_t number = 0;      ///< the object's handle, or the class
  AttributeBits attributes = 0;  ///< 0 for interactions
  std::uint8_t transportation = 0;
};
template <class Stream>
bool exchange(Stream& stream, ChangeTransportationMessage& message) {
  return stream.range(message.is_interaction, 1) && stream.varint(message.number) &&
         attribute_bits(stream, message.attributes) && stream.range(message.transportation, 1);
}

/// Asks for the transportation type of an attribute, or of the interactions that a federate sends
/// of a class.
struct QueryTransportationMessage {
  static constexpr MessageKind kind = MessageKind::query_transportation;
  std::uint8_t is_interaction = 0;
  std::uint32_t number = 0;  ///< the object's handle, or the class
  std::uint32_t which = 0;   ///< the attribute, or the federate
};
template <class Stream>
bool exchange(Stream& stream, QueryTransportationMessage& message) {
  return stream.range(message.is_interaction, 1) && stream.varint(message.number) &&
         stream.varint(message.which);
}

/// Confirms a change, or answers a query.
struct TransportationMessage {
  static constexpr MessageKind kind = MessageKind::transportation;
  std::uint8_t is_interaction = 0, is_confirmation = 0;
  std::uint32_t number = 0;
  AttributeBits which =
      0;  ///< of a confirmation the attributes, of an answer the attribute or the federate
  std::uint8_t transportation = 0;
};
template <class Stream>
bool exchange(Stream& stream, TransportationMessage& message) {
  return stream.range(message.is_interaction, 1) && stream.range(message.is_confirmation, 1) &&
         stream.varint(message.number) && attribute_bits(stream, message.which) &&
         stream.range(message.transportation, 1);
}

}  // namespace rink::rti
