// The values that entries brought last, of which both ends of a connection keep the same.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// The longest value that is kept, coded [bytes].
inline constexpr std::size_t repeated_value_max = 256;

/// Many objects of a class have equal values: of a thousand equal pucks one brings its shape.
class EntryValues {
 public:
  /// True if the last entry of the class with the attribute had this coded value.
  bool repeats(std::uint16_t object_class, AttributeHandle attribute, Bytes value) const {
    const Value* last = find(object_class, attribute);
    return last != nullptr && std::ranges::equal(last->bytes, value);
  }
  void note(std::uint16_t object_class, AttributeHandle attribute, Bytes value) {
    if (object_class >= by_class_.size()) by_class_.resize(object_class + std::size_t{1});
    std::vector<Value>& values = by_class_[object_class];
    if (attribute.value >= values.size()) values.resize(attribute.value + std::size_t{1});
    Value& noted = values[attribute.value];
    noted.is_there = value.size() <= repeated_value_max;
    if (noted.is_there) noted.bytes.assign(value.begin(), value.end());
  }
  bool has(std::uint16_t object_class, AttributeHandle attribute) const {
    return find(object_class, attribute) != nullptr;
  }
  /// It must be there.
  Bytes last(std::uint16_t object_class, AttributeHandle attribute) const {
    const Value* value = find(object_class, attribute);
    assert(value != nullptr);
    return value->bytes;
  }
  std::size_t memory_bytes() const {
    std::size_t size = by_class_.capacity() * sizeof(std::vector<Value>);
    for (const std::vector<Value>& values : by_class_) {
      size += values.capacity() * sizeof(Value);
      for (const Value& each : values) size += each.bytes.capacity();
    }
    return size;
  }

 private:
  struct Value {
    bool is_there = false;
    std::vector<std::byte> bytes;
  };
  const Value* find(std::uint16_t object_class, AttributeHandle attribute) const {
    if (object_class >= by_class_.size()) return nullptr;
    const std::vector<Value>& values = by_class_[object_class];
    if (attribute.value >= values.size() || !values[attribute.value].is_there) return nullptr;
    return &values[attribute.value];
  }
  std::vector<std::vector<Value>> by_class_;
};

}  // namespace rink::rti
