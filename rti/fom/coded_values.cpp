// Walks through sets of attributes.
#include "rti/fom/coded_values.h"

#include <cassert>

#include "rti/fom/attribute_codec.h"

namespace rink::rti {

namespace {

/// Calls `visit(attribute, index)` in ascending order until it returns false; true if it never did.
template <class Visit>
bool for_each(const ObjectClass& object_class, AttributeSet set, Visit visit) {
  return set.all_of([&](AttributeHandle attribute) {
    assert(attribute.value < object_class.attributes.size());
    return visit(object_class.attributes[attribute.value], attribute.value);
  });
}

std::optional<std::size_t> one_coded_size(const Attribute& attribute, Bytes coded) {
  if (!attribute.codec) return plain_size(attribute, coded);
  const std::optional<std::size_t> size = attribute.codec->size(coded);
  return size && *size <= coded.size() ? size : std::nullopt;
}

}  // namespace

bool is_coded(const ObjectClass& object_class, AttributeSet set) {
  return !for_each(object_class, set, [](const Attribute& attribute, std::uint32_t) {
    return attribute.codec == nullptr;
  });
}

std::optional<std::uint32_t> coded_size(const ObjectClass& object_class, AttributeSet set) {
  std::uint32_t size = 0;
  const bool is_fixed = for_each(object_class, set, [&](const Attribute& attribute, std::uint32_t) {
    size += attribute.size.value_or(0);
    return attribute.size && !attribute.codec;
  });
  return is_fixed ? std::optional(size) : std::nullopt;
}

std::optional<std::size_t> coded_size(const ObjectClass& object_class, AttributeSet set,
                                      Bytes coded) {
  std::size_t sum = 0;
  const bool is_whole = for_each(object_class, set, [&](const Attribute& attribute, std::uint32_t) {
    const std::optional<std::size_t> size = one_coded_size(attribute, coded.subspan(sum));
    sum += size.value_or(0);
    return size.has_value();
  });
  return is_whole ? std::optional(sum) : std::nullopt;
}

Bytes coded_value(const ObjectClass& object_class, AttributeSet set, AttributeHandle wanted,
                  Bytes coded) {
  assert(set.contains(wanted));
  Bytes found;
  for_each(object_class, set, [&](const Attribute& attribute, std::uint32_t index) {
    found = coded.first(one_coded_size(attribute, coded).value_or(0));
    coded = coded.subspan(found.size());
    return index != wanted.value;
  });
  return found;
}

void encode(const ObjectClass& object_class, AttributeSet set, Bytes values, double time,
            std::vector<std::byte>& coded) {
  for_each(object_class, set, [&](const Attribute& attribute, std::uint32_t) {
    const Bytes value = values.first(plain_size(attribute, values).value_or(0));
    if (attribute.codec) attribute.codec->encode(value, time, coded);
    else coded.insert(coded.end(), value.begin(), value.end());
    values = values.subspan(value.size());
    return true;
  });
}

bool decode(const ObjectClass& object_class, AttributeSet set, Bytes coded, double time,
            std::vector<std::byte>& values) {
  return for_each(object_class, set, [&](const Attribute& attribute, std::uint32_t) {
    const std::optional<std::size_t> size = one_coded_size(attribute, coded);
    if (!size) return false;
    const Bytes value = coded.first(*size);
    coded = coded.subspan(*size);
    if (!attribute.codec) return values.insert(values.end(), value.begin(), value.end()), true;
    const std::size_t before = values.size();
    if (!attribute.codec->decode(value, time, values)) return false;
    return plain_size(attribute, Bytes(values).subspan(before)) == values.size() - before;
  });
}

}  // namespace rink::rti
