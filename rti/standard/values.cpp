// Values of updates and interactions.
#include "rti/standard/values.h"

#include <bit>
#include <cassert>
#include <cstring>
#include <string>

#include "rti/standard/handles.h"
#include "rti/standard/management_forms.h"
#include "rti/standard/tags.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

using rti::Bytes;

void put_word(std::vector<std::byte>& bytes, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(word >> 8 * i & 0xff));
}
/// The word that begins `bytes`, which it takes off; false if there is none.
bool get_word(Bytes& bytes, std::uint32_t& word) {
  if (bytes.size() < 4) return false;
  word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint32_t>(bytes[i]) << 8 * i;
  bytes = bytes.subspan(4);
  return true;
}
bool get_bytes(Bytes& bytes, std::size_t size, Bytes& found) {
  if (bytes.size() < size) return false;
  found = bytes.first(size);
  bytes = bytes.subspan(size);
  return true;
}

/// Appends a value, after its length if its size varies.
template <class Member>
void put_value(std::vector<std::byte>& bytes, const Member& member, Bytes value) {
  if (!member.size) {
    put_word(bytes, static_cast<std::uint32_t>(value.size()));
  } else if (value.size() != *member.size) {
    throw rti1516e::RTIinternalError(to_wide(member.name + " has " + std::to_string(value.size()) +
                                             " bytes, but its data type " + member.data_type +
                                             " has " + std::to_string(*member.size)));
  }
  bytes.insert(bytes.end(), value.begin(), value.end());
}
template <class Member>
bool get_value(Bytes& bytes, const Member& member, Bytes& value) {
  std::uint32_t size = member.size.value_or(0);
  if (!member.size && !get_word(bytes, size)) return false;
  return get_bytes(bytes, size, value);
}

const rti::Parameter& parameter_at(const rti::InteractionClass& interaction_class,
                                   const rti1516e::ParameterHandle& handle) {
  const rti::ParameterHandle parameter = to_core(handle);
  if (parameter.value >= interaction_class.parameters.size())
    throw rti1516e::InteractionParameterNotDefined(to_wide(interaction_class.name) +
                                                   L" has no parameter " + handle.toString());
  return interaction_class.parameters[parameter.value];
}

/// Parameters by handle and size, behind the tag.
std::vector<std::byte> put_apart(const rti1516e::ParameterHandleValueMap& values, Bytes tag) {
  std::vector<std::byte> bytes;
  put_word(bytes, static_cast<std::uint32_t>(tag.size()));
  bytes.insert(bytes.end(), tag.begin(), tag.end());
  for (const auto& [handle, value] : values) {
    put_word(bytes, to_core(handle).value);
    put_word(bytes, static_cast<std::uint32_t>(value.size()));
    const Bytes content = bytes_of(value);
    bytes.insert(bytes.end(), content.begin(), content.end());
  }
  return bytes;
}

void get_apart(ReceivedMessage& message, Bytes bytes, std::size_t parameter_count) {
  std::uint32_t size = 0, handle = 0;
  Bytes found;
  if (!get_word(bytes, size) || !get_bytes(bytes, size, found)) return;
  message.tag = data_of(found);
  while (get_word(bytes, handle) && get_word(bytes, size) && get_bytes(bytes, size, found))
    if (handle < parameter_count)
      message.values[to_standard(rti::ParameterHandle{handle})] = data_of(found);
}

void get_in_order(ReceivedMessage& message, Bytes bytes, const rti::InteractionClass& sent,
                  std::size_t known_count, bool is_management) {
  rti1516e::ParameterHandleValueMap values;
  for (std::uint32_t i = 0; i < sent.parameters.size(); ++i) {
    Bytes value;
    if (!get_value(bytes, sent.parameters[i], value)) return;
    if (i >= known_count) continue;
    values[to_standard(rti::ParameterHandle{i})] =
        is_management ? management_to_standard(sent.parameters[i].data_type, value)
                      : data_of(value);
  }
  if (bytes.empty()) message.values = std::move(values);
}

}  // namespace

void encode_update(const rti::Fom& fom, rti::ObjectClassHandle object_class,
                   const rti1516e::AttributeHandleValueMap& values, Update& update) {
  const std::vector<rti::Attribute>& attributes = fom.at(object_class).attributes;
  update.attributes = {};
  update.values.clear();
  for (const auto& [handle, value] : values) {
    const rti::AttributeHandle attribute = to_core(handle);
    if (attribute.value >= attributes.size())
      throw rti1516e::AttributeNotDefined(to_wide(fom.at(object_class).name) +
                                          L" has no attribute " + handle.toString());
    update.attributes.insert(attribute);
    put_value(update.values, attributes[attribute.value], bytes_of(value));
  }
}

rti1516e::AttributeHandleValueMap decode_update(const rti::Fom& fom,
                                                rti::ObjectClassHandle object_class,
                                                rti::AttributeSet attributes, Bytes values,
                                                rti::AttributeSet wanted) {
  const std::vector<rti::Attribute>& all = fom.at(object_class).attributes;
  const bool is_management = fom.is_management(object_class);
  rti1516e::AttributeHandleValueMap map;
  attributes.for_each([&](rti::AttributeHandle each) {
    Bytes value;
    [[maybe_unused]] const bool is_whole = get_value(values, all[each.value], value);
    assert(is_whole);  // the core delivers whole values only
    if (!wanted.contains(each)) return;
    rti1516e::VariableLengthData& data = map[to_standard(each)];
    if (is_management) data = management_to_standard(all[each.value].data_type, value);
    else data.setData(value.data(), value.size());
  });
  return map;
}

Message encode_message(const rti::Fom& fom, rti::InteractionClassHandle interaction_class,
                       const rti1516e::ParameterHandleValueMap& values,
                       rti1516e::VariableLengthData const& tag, std::optional<double> time) {
  const rti::InteractionClass& model = fom.at(interaction_class);
  const Bytes tag_bytes = bytes_of(tag);
  const bool is_for_rti = fom.is_for_rti(interaction_class);
  const unsigned flags = time ? tag_has_time : 0;
  for (const auto& [handle, value] : values) parameter_at(model, handle);
  Message message;
  message.stamp.time = time.value_or(0.0);
  if (values.size() == model.parameters.size() && tag_bytes.size() <= tag_size_bits) {
    for (const auto& [handle, value] : values) {
      const rti::Parameter& parameter = parameter_at(model, handle);
      if (is_for_rti)
        put_value(message.parameters, parameter,
                  bytes_of(management_from_standard(parameter.data_type, value)));
      else put_value(message.parameters, parameter, bytes_of(value));
    }
    if (!tag_bytes.empty() || time) message.stamp.tag = tag_word(tag_bytes, flags);
    return message;
  }
  if (is_for_rti)
    throw rti1516e::RTIinternalError(to_wide(model.name) +
                                     L" needs all its parameters and a tag of at most 7 bytes");
  message.parameters = put_apart(values, tag_bytes);
  message.stamp.tag = tag_word({}, flags | tag_is_apart);
  return message;
}

ReceivedMessage decode_message(const rti::Fom& fom, rti::InteractionClassHandle sent,
                               rti::InteractionClassHandle known, Bytes parameters,
                               const rti::Stamp& stamp) {
  const std::size_t known_count = fom.at(known).parameters.size();
  const auto head = static_cast<unsigned>(stamp.tag >> 56);
  ReceivedMessage message;
  if ((head & tag_mark) != 0 && (head & tag_is_apart) != 0) {
    message.has_time = (head & tag_has_time) != 0;
    get_apart(message, parameters, known_count);
    return message;
  }
  ReceivedTag tag = read_tag(stamp);
  message.tag = tag.tag;
  message.has_time = tag.has_time;
  get_in_order(message, parameters, fom.at(sent), known_count, fom.is_management(sent));
  return message;
}

}  // namespace rink::standard
