// The values that entries brought last, of which both ends of a connection keep the same.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// The longest value that is kept, coded [bytes].
inline constexpr std::size_t repeated_value_max = 256;

/// Many objects of a class have equal values: of a thousand equal pucks one brings its shape, and
/// of bats among them one of each team. Of each attribute the last four values are kept, the newest
/// first: that is 0.
class EntryValues {
 public:
  static constexpr std::uint8_t kept_max = 4;

  /// True if the last entry of the class with the attribute had this coded value.
  bool repeats(std::uint16_t object_class, AttributeHandle attribute, Bytes value) const {
    const Values* values = find(object_class, attribute);
    return values != nullptr && std::ranges::equal(values->at(0), value);
  }
  /// The number of a value that came before the last one; nothing if it is not kept.
  std::optional<std::uint8_t> former(std::uint16_t object_class, AttributeHandle attribute,
                                     Bytes value) const {
    const Values* values = find(object_class, attribute);
    for (std::uint8_t k = 1; values != nullptr && k < values->count; ++k)
      if (std::ranges::equal(values->at(k), value)) return k;
    return std::nullopt;
  }
  /// Makes a former value the last one, and gives it; nothing if none has that number.
  std::optional<Bytes> recall(std::uint16_t object_class, AttributeHandle attribute,
                              std::uint8_t number) {
    auto* values = const_cast<Values*>(find(object_class, attribute));
    if (values == nullptr || number == 0 || number >= values->count) return std::nullopt;
    return values->put_first(number);
  }
  /// Longer values are not kept.
  void note(std::uint16_t object_class, AttributeHandle attribute, Bytes value) {
    if (value.size() > repeated_value_max) return;
    if (object_class >= by_class_.size()) by_class_.resize(object_class + std::size_t{1});
    std::vector<Values>& of_class = by_class_[object_class];
    if (attribute.value >= of_class.size()) of_class.resize(attribute.value + std::size_t{1});
    Values& values = of_class[attribute.value];
    values.count = std::min<std::uint8_t>(values.count + 1, kept_max);
    values.put_first(static_cast<std::uint8_t>(values.count - 1))
        .assign(value.begin(), value.end());
  }
  bool has(std::uint16_t object_class, AttributeHandle attribute) const {
    return find(object_class, attribute) != nullptr;
  }
  /// It must be there.
  Bytes last(std::uint16_t object_class, AttributeHandle attribute) const {
    const Values* values = find(object_class, attribute);
    assert(values != nullptr);
    return values->at(0);
  }
  std::size_t memory_bytes() const {
    std::size_t size = by_class_.capacity() * sizeof(std::vector<Values>);
    for (const std::vector<Values>& of_class : by_class_) {
      size += of_class.capacity() * sizeof(Values);
      for (const Values& values : of_class)
        for (const std::vector<std::byte>& each : values.kept) size += each.capacity();
    }
    return size;
  }

 private:
  struct Values {
    std::uint8_t count = 0;
    std::array<std::uint8_t, kept_max> order{0, 1, 2, 3};  ///< places in `kept`, the newest first
    std::array<std::vector<std::byte>, kept_max> kept;
    const std::vector<std::byte>& at(std::uint8_t number) const { return kept[order[number]]; }
    std::vector<std::byte>& put_first(std::uint8_t number) {
      const std::uint8_t place = order[number];
      for (; number > 0; --number) order[number] = order[number - 1u];
      return kept[order[0] = place];
    }
  };
  const Values* find(std::uint16_t object_class, AttributeHandle attribute) const {
    if (object_class >= by_class_.size()) return nullptr;
    const std::vector<Values>& of_class = by_class_[object_class];
    if (attribute.value >= of_class.size() || of_class[attribute.value].count == 0) return nullptr;
    return &of_class[attribute.value];
  }
  std::vector<std::vector<Values>> by_class_;
};

}  // namespace rink::rti
