// How values of the basic representations and strings are written and read (IEEE
// 1516.2-2010, 4.13), and who holds them.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "rti/standard/encoding/octets.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

/// How a type of value is written and read; a reader returns the index behind it.
template <std::endian order, class Number>
struct NumberForm {
  static constexpr unsigned boundary = sizeof(Number);
  static void write(Octets& buffer, Number value) { put_number<order>(buffer, value); }
  static size_t read(const Octets& buffer, size_t index, Number& value) {
    value = get_number<order, Number>(buffer, index);
    return index + sizeof(Number);
  }
  static rti1516e::Integer64 hash(const Number& value) {
    return static_cast<rti1516e::Integer64>(std::hash<Number>()(value));
  }
};
template <class Number>
using BigEndian = NumberForm<std::endian::big, Number>;
template <class Number>
using LittleEndian = NumberForm<std::endian::little, Number>;

struct BooleanForm {
  static constexpr unsigned boundary = 4;
  static void write(Octets& buffer, bool value) {
    BigEndian<rti1516e::Integer32>::write(buffer, value ? 1 : 0);
  }
  static size_t read(const Octets& buffer, size_t index, bool& value) {
    rti1516e::Integer32 number = 0;
    const size_t end = BigEndian<rti1516e::Integer32>::read(buffer, index, number);
    if (number != 0 && number != 1)
      throw rti1516e::EncoderException(L"HLAboolean is 0 or 1, not " + std::to_wstring(number));
    value = number == 1;
    return end;
  }
  static rti1516e::Integer64 hash(bool value) { return value; }
};

struct UnicodeCharForm {
  static constexpr unsigned boundary = 2;
  static void write(Octets& buffer, wchar_t value) {
    // Half of a surrogate pair is a code unit too.
    if (static_cast<std::uint32_t>(value) > 0xffff)
      throw rti1516e::EncoderException(L"HLAunicodeChar holds one UTF-16 code unit only");
    put_number<std::endian::big>(buffer, static_cast<char16_t>(value));
  }
  static size_t read(const Octets& buffer, size_t index, wchar_t& value) {
    value = static_cast<wchar_t>(get_number<std::endian::big, char16_t>(buffer, index));
    return index + 2;
  }
  static rti1516e::Integer64 hash(wchar_t value) { return value; }
};

/// The first of a pair is the more significant one.
template <bool is_big_endian>
struct OctetPairForm {
  static constexpr unsigned boundary = 2;
  static void write(Octets& buffer, const rti1516e::OctetPair& value) {
    buffer.push_back(is_big_endian ? value.first : value.second);
    buffer.push_back(is_big_endian ? value.second : value.first);
  }
  static size_t read(const Octets& buffer, size_t index, rti1516e::OctetPair& value) {
    check_room(buffer, index, 2);
    value = {buffer[index], buffer[index + 1]};
    if (!is_big_endian) std::swap(value.first, value.second);
    return index + 2;
  }
  static rti1516e::Integer64 hash(const rti1516e::OctetPair& value) {
    return static_cast<unsigned char>(value.first) << 8 | static_cast<unsigned char>(value.second);
  }
};

struct AsciiStringForm {
  static constexpr unsigned boundary = 4;
  static void write(Octets& buffer, const std::string& value) {
    put_count(buffer, value.size());
    buffer.insert(buffer.end(), value.begin(), value.end());
  }
  static size_t read(const Octets& buffer, size_t index, std::string& value) {
    const size_t count = get_count(buffer, index);
    check_room(buffer, index + 4, count);
    value.assign(buffer.data() + index + 4, count);
    return index + 4 + count;
  }
  static rti1516e::Integer64 hash(const std::string& value) {
    return static_cast<rti1516e::Integer64>(std::hash<std::string>()(value));
  }
};

struct UnicodeStringForm {
  static constexpr unsigned boundary = 4;
  static void write(Octets& buffer, const std::wstring& value) {
    const std::u16string units = to_utf16(value);
    put_count(buffer, units.size());
    for (const char16_t unit : units) put_number<std::endian::big>(buffer, unit);
  }
  static size_t read(const Octets& buffer, size_t index, std::wstring& value) {
    const size_t count = get_count(buffer, index);
    check_room(buffer, index + 4, 2 * count);
    std::u16string units;
    units.reserve(count);
    for (size_t i = 0; i < count; ++i)
      units.push_back(get_number<std::endian::big, char16_t>(buffer, index + 4 + 2 * i));
    value = from_utf16(units);
    return index + 4 + 2 * count;
  }
  static rti1516e::Integer64 hash(const std::wstring& value) {
    return static_cast<rti1516e::Integer64>(std::hash<std::wstring>()(value));
  }
};

/// A value of its own, or one of the user's.
template <class Value>
struct Held {
  Held() = default;
  explicit Held(Value value) : own(std::move(value)) {}
  Held(const Held& other) : own(other.value()) {}
  Held& operator=(const Held&) = delete;
  Value& value() { return external == nullptr ? own : *external; }
  const Value& value() const { return external == nullptr ? own : *external; }

  Value own{};
  Value* external = nullptr;
};

template <class Value>
Value* checked_pointer(Value* pointer) {
  if (pointer == nullptr) throw rti1516e::EncoderException(L"the pointer to the value is null");
  return pointer;
}

}  // namespace rink::standard
