// Encodes and decodes values as IEEE 1516.2-2010, 4.13.9, lays them out: basic representations,
// HLAfixedRecord, HLAvariantRecord, HLAfixedArray and HLAvariableArray, with their padding.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "rti/wire/bytes.h"

/// Types that mirror a model's data types, so that one declaration both encodes and decodes:
///
///     struct Place { double x, y; std::uint8_t deck; };
///     using PlaceElement = FixedRecord<Field<&Place::x, Float64BE>, Field<&Place::y, Float64BE>,
///                                      Field<&Place::deck, Octet>>;
///     const std::vector<std::byte> bytes = encode<PlaceElement>(place);
///     const std::optional<Place> read = decode<PlaceElement>(bytes);
///
/// Each has `Value`, the type in memory; `boundary`, its octet boundary value [bytes]; and
/// `exchange(stream, value)`, which a writer never fails and a reader fails on bytes that are no
/// such value. A value of varying size goes into an update after its length (docs/wire.md).
namespace rink::rti::data {

/// Appends a value; padding is zeros.
class DataWriter {
 public:
  static constexpr bool is_reading = false;
  explicit DataWriter(std::vector<std::byte>& bytes) : bytes_(bytes), begin_(bytes.size()) {}
  /// Padding up to a multiple of `boundary` from the value's beginning.
  bool align(std::size_t boundary) {
    const std::size_t size = bytes_.size() - begin_;
    bytes_.resize(begin_ + (size + boundary - 1) / boundary * boundary);
    return true;
  }
  bool octets(std::byte* from, std::size_t size) {
    bytes_.insert(bytes_.end(), from, from + size);
    return true;
  }

 private:
  std::vector<std::byte>& bytes_;
  std::size_t begin_;
};

/// Takes a value apart; whatever stands in padding is skipped.
class DataReader {
 public:
  static constexpr bool is_reading = true;
  explicit DataReader(Bytes bytes) : bytes_(bytes) {}
  std::size_t left() const { return bytes_.size() - at_; }
  bool align(std::size_t boundary) {
    const std::size_t next = (at_ + boundary - 1) / boundary * boundary;
    if (next > bytes_.size()) return false;
    at_ = next;
    return true;
  }
  bool octets(std::byte* to, std::size_t size) {
    if (size > left()) return false;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), size, to);
    at_ += size;
    return true;
  }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

/// A basic data representation: a number in either order of its bytes.
template <class Number, std::endian order>
struct Basic {
  using Value = Number;
  static constexpr std::size_t boundary = sizeof(Number);
  template <class Stream>
  static bool exchange(Stream& stream, Value& value) {
    std::array<std::byte, sizeof(Number)> octets{};
    std::memcpy(octets.data(), &value, sizeof value);
    if (order != std::endian::native) std::reverse(octets.begin(), octets.end());
    if (!stream.align(boundary) || !stream.octets(octets.data(), octets.size())) return false;
    if constexpr (Stream::is_reading) {
      if (order != std::endian::native) std::reverse(octets.begin(), octets.end());
      std::memcpy(&value, octets.data(), sizeof value);
    }
    return true;
  }
};
using Octet = Basic<std::uint8_t, std::endian::big>;
using OctetPairBE = Basic<std::uint16_t, std::endian::big>;
using OctetPairLE = Basic<std::uint16_t, std::endian::little>;
using Integer16BE = Basic<std::int16_t, std::endian::big>;
using Integer16LE = Basic<std::int16_t, std::endian::little>;
using Integer32BE = Basic<std::int32_t, std::endian::big>;
using Integer32LE = Basic<std::int32_t, std::endian::little>;
using Integer64BE = Basic<std::int64_t, std::endian::big>;
using Integer64LE = Basic<std::int64_t, std::endian::little>;
using Float32BE = Basic<float, std::endian::big>;
using Float32LE = Basic<float, std::endian::little>;
using Float64BE = Basic<double, std::endian::big>;
using Float64LE = Basic<double, std::endian::little>;
using AsciiChar = Basic<char, std::endian::big>;
using UnicodeChar = Basic<char16_t, std::endian::big>;

/// HLAboolean: an HLAinteger32BE that is 0 or 1.
struct Boolean {
  using Value = bool;
  static constexpr std::size_t boundary = Integer32BE::boundary;
  template <class Stream>
  static bool exchange(Stream& stream, bool& value) {
    std::int32_t number = value ? 1 : 0;
    if (!Integer32BE::exchange(stream, number) || number < 0 || number > 1) return false;
    value = number == 1;
    return true;
  }
};

/// An enumerated data type over a basic representation. That a value is one of the enumerators is
/// for its user to check.
template <class Enumeration, class Representation>
struct Enumerated {
  using Value = Enumeration;
  static constexpr std::size_t boundary = Representation::boundary;
  template <class Stream>
  static bool exchange(Stream& stream, Enumeration& value) {
    auto number = static_cast<typename Representation::Value>(value);
    if (!Representation::exchange(stream, number)) return false;
    value = static_cast<Enumeration>(number);
    return true;
  }
};

/// HLAfixedArray of `count` elements.
template <class Element, std::size_t count>
struct FixedArray {
  using Value = std::array<typename Element::Value, count>;
  static constexpr std::size_t boundary = Element::boundary;
  template <class Stream>
  static bool exchange(Stream& stream, Value& values) {
    return std::all_of(values.begin(), values.end(),
                       [&](auto& value) { return Element::exchange(stream, value); });
  }
};

/// HLAvariableArray: the number of elements as HLAinteger32BE, then they. `List` is what holds
/// them.
template <class Element, class List = std::vector<typename Element::Value>>
struct VariableArray {
  using Value = List;
  static constexpr std::size_t boundary = std::max(Integer32BE::boundary, Element::boundary);
  template <class Stream>
  static bool exchange(Stream& stream, List& values) {
    assert(values.size() <= std::numeric_limits<std::int32_t>::max());
    auto count = static_cast<std::int32_t>(values.size());
    if (!stream.align(boundary) || !Integer32BE::exchange(stream, count)) return false;
    if constexpr (Stream::is_reading) {
      // An element takes an octet at least, so that a count can't claim memory that isn't there.
      if (count < 0 || static_cast<std::size_t>(count) > stream.left()) return false;
      values.resize(static_cast<std::size_t>(count));
    }
    return std::all_of(values.begin(), values.end(),
                       [&](auto& value) { return Element::exchange(stream, value); });
  }
};
using AsciiString = VariableArray<AsciiChar, std::string>;
using UnicodeString = VariableArray<UnicodeChar, std::u16string>;
using OpaqueData = VariableArray<Octet>;

/// A field of a record: the member that holds it, and its data type.
template <auto member, class FieldElement>
struct Field {
  using Element = FieldElement;
  static constexpr auto pointer = member;
};
template <class Struct, class Member>
Struct struct_of(Member Struct::*);

/// HLAfixedRecord of the fields, in their order.
template <class First, class... Others>
struct FixedRecord {
  using Value = decltype(struct_of(First::pointer));
  static constexpr std::size_t boundary =
      std::max({First::Element::boundary, Others::Element::boundary...});
  template <class Stream>
  static bool exchange(Stream& stream, Value& value) {
    return stream.align(boundary) && First::Element::exchange(stream, value.*First::pointer) &&
           (Others::Element::exchange(stream, value.*Others::pointer) && ...);
  }
};

/// An alternative of a variant record, for each of these values of its discriminant; with none, for
/// all that no alternative before it has: HLAother.
template <class AlternativeElement, auto... values>
struct Alternative {
  using Element = AlternativeElement;
  template <class Discriminant>
  static constexpr bool is_for([[maybe_unused]] Discriminant discriminant) {
    return sizeof...(values) == 0 || ((discriminant == values) || ...);
  }
};

/// The value of a variant record: the alternatives by number from 1 on; 0 where the discriminant
/// has none.
template <class Discriminant, class... Values>
struct VariantValue {
  Discriminant discriminant{};
  std::variant<std::monostate, Values...> alternative{};
  friend bool operator==(const VariantValue&, const VariantValue&) = default;
};

/// HLAvariantRecord: the discriminant, and at the greatest boundary of all alternatives that which
/// the discriminant chooses. The value must hold that alternative when it is written.
template <class Discriminant, class... Alternatives>
struct VariantRecord {
  using Value =
      VariantValue<typename Discriminant::Value, typename Alternatives::Element::Value...>;
  static constexpr std::size_t alternative_boundary =
      std::max({std::size_t{1}, Alternatives::Element::boundary...});
  static constexpr std::size_t boundary = std::max(Discriminant::boundary, alternative_boundary);
  template <class Stream>
  static bool exchange(Stream& stream, Value& value) {
    return stream.align(boundary) && Discriminant::exchange(stream, value.discriminant) &&
           exchange_chosen(stream, value, std::index_sequence_for<Alternatives...>{});
  }

 private:
  template <class Stream, std::size_t... indices>
  static bool exchange_chosen(Stream& stream, Value& value, std::index_sequence<indices...>) {
    bool is_sound = true;
    const bool is_any = ((Alternatives::is_for(value.discriminant) &&
                          (is_sound = exchange_one<indices, Alternatives>(stream, value), true)) ||
                         ...);
    if (!is_any && Stream::is_reading) value.alternative = std::monostate{};
    assert(is_any || value.alternative.index() == 0);
    return is_sound;
  }
  template <std::size_t index, class Chosen, class Stream>
  static bool exchange_one(Stream& stream, Value& value) {
    if constexpr (Stream::is_reading) value.alternative.template emplace<index + 1>();
    assert(value.alternative.index() == index + 1);
    return stream.align(alternative_boundary) &&
           Chosen::Element::exchange(stream, std::get<index + 1>(value.alternative));
  }
};

/// Appends `value` to `bytes`; its padding counts from where it begins.
template <class Element>
void encode(const typename Element::Value& value, std::vector<std::byte>& bytes) {
  DataWriter writer(bytes);
  auto copy = value;  // one function reads and writes, and takes what it may change
  [[maybe_unused]] const bool is_written = Element::exchange(writer, copy);
  assert(is_written);
}
template <class Element>
std::vector<std::byte> encode(const typename Element::Value& value) {
  std::vector<std::byte> bytes;
  encode<Element>(value, bytes);
  return bytes;
}
/// Nothing unless `bytes` are exactly one such value.
template <class Element>
std::optional<typename Element::Value> decode(Bytes bytes) {
  typename Element::Value value{};
  DataReader reader(bytes);
  if (!Element::exchange(reader, value) || reader.left() > 0) return std::nullopt;
  return value;
}

}  // namespace rink::rti::data
