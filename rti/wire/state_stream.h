// Writes and reads the state of a federation and of its federates, by one function for both
// directions (docs/rti.md, "Save and restore").
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "im/region.h"

#include "rti/handles.h"
#include "rti/objects/bitmap.h"
#include "rti/objects/object_map.h"
#include "rti/types.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// A class whose state is kept has `template <class Stream> bool keep(Stream& stream)`, which names
/// its members by `keep_all`. A writer changes nothing. False if what is read is damaged: then the
/// object is fit for nothing but its destruction. Equal states have equal bytes.
template <class Value, class Stream>
concept KeepsItself = requires(Value& value, Stream& stream) {
  { value.keep(stream) } -> std::same_as<bool>;
};

template <class Stream, class... Values>
bool keep_all(Stream& stream, Values&... values);

namespace kept {

template <class Stream, class Number>
requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
bool keep(Stream& stream, Number& value) {
  if constexpr (std::is_same_v<Number, bool>) return stream.truth(value);
  else if constexpr (std::is_unsigned_v<Number> && sizeof(Number) > 1) return stream.varint(value);
  else return stream.number(value);
}

template <class Stream, class Tag>
bool keep(Stream& stream, Handle<Tag>& handle) {
  return stream.number(handle.value);
}

template <class Stream>
bool keep(Stream& stream, AttributeSet& set) {
  auto low = static_cast<std::uint64_t>(set.bits),
       high = static_cast<std::uint64_t>(set.bits >> 64);
  if (!stream.varint(low) || !stream.varint(high)) return false;
  if constexpr (Stream::is_reading) set.bits = AttributeBits{high} << 64 | low;
  return true;
}

template <class Stream>
bool keep(Stream& stream, DimensionSet& set) {
  return stream.varint(set.bits);
}

template <class Stream>
bool keep(Stream& stream, Stamp& stamp) {
  return stream.number(stamp.time) && stream.varint(stamp.tag);
}

template <class Stream>
bool keep(Stream& stream, Range& range) {
  return stream.numbers(range.low, range.high);
}

template <class Stream>
bool keep(Stream& stream, im::Region& region) {
  return stream.numbers(region.low_x, region.low_y, region.high_x, region.high_y);
}

template <class Stream, KeepsItself<Stream> Value>
bool keep(Stream& stream, Value& value) {
  return value.keep(stream);
}

template <class Stream, class Char>
requires(sizeof(Char) == 1) bool keep_bytes(Stream& stream, Char* data, std::size_t size) {
  Bytes view = std::as_bytes(std::span(data, size));
  if (!stream.rest(view, size)) return false;
  if constexpr (Stream::is_reading)
    std::ranges::copy(view, std::as_writable_bytes(std::span(data, size)).begin());
  return true;
}

template <class Stream>
bool keep(Stream& stream, std::string& text) {
  return stream.short_size(text) && keep_bytes(stream, text.data(), text.size());
}

template <class Stream>
bool keep(Stream& stream, std::vector<std::byte>& bytes) {
  return stream.short_size(bytes) && keep_bytes(stream, bytes.data(), bytes.size());
}

template <class Stream>
bool keep(Stream& stream, std::vector<bool>& truths) {
  if (!stream.short_size(truths)) return false;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    bool truth = truths[i];
    if (!stream.truth(truth)) return false;
    truths[i] = truth;
  }
  return true;
}

template <class Stream, class First, class Second>
bool keep(Stream& stream, std::pair<First, Second>& pair) {
  return keep_all(stream, pair.first, pair.second);
}

template <class Stream, class Value>
bool keep(Stream& stream, std::vector<Value>& values) {
  return stream.short_size(values) &&
         std::ranges::all_of(values, [&](Value& each) { return keep_all(stream, each); });
}

/// What an optional or a unique pointer holds, if anything.
template <class Stream, class Holder, class Make>
bool keep_held(Stream& stream, Holder& holder, Make make) {
  bool is_there = static_cast<bool>(holder);
  if (!stream.truth(is_there)) return false;
  if constexpr (Stream::is_reading) {
    holder.reset();
    if (is_there) make();
  }
  return !is_there || keep_all(stream, *holder);
}
template <class Stream, class Value>
bool keep(Stream& stream, std::optional<Value>& value) {
  return keep_held(stream, value, [&] { value.emplace(); });
}
template <class Stream, class Value>
bool keep(Stream& stream, std::unique_ptr<Value>& value) {
  return keep_held(stream, value, [&] { value = std::make_unique<Value>(); });
}

/// A map as the list of its elements in the order of their keys.
template <class Key, class Value, class Stream, class List, class Insert>
bool keep_elements(Stream& stream, List list, Insert insert) {
  std::vector<std::pair<Key, Value>> elements;
  if constexpr (!Stream::is_reading) {
    list([&](const Key& key, const Value& value) { elements.emplace_back(key, value); });
    std::ranges::sort(elements, {}, &std::pair<Key, Value>::first);
  }
  if (!keep(stream, elements)) return false;
  if constexpr (Stream::is_reading)
    for (auto& [key, value] : elements) insert(key, std::move(value));
  return true;
}

template <class Stream, class Value>
bool keep(Stream& stream, std::set<Value>& values) {
  std::vector<Value> list(values.begin(), values.end());
  if (!keep(stream, list)) return false;
  if constexpr (Stream::is_reading) values = {list.begin(), list.end()};
  return true;
}

template <class Stream, class Map>
requires requires { typename Map::mapped_type; }
bool keep(Stream& stream, Map& map) {
  using Key = typename Map::key_type;
  using Value = typename Map::mapped_type;
  if constexpr (Stream::is_reading) map.clear();
  return keep_elements<Key, Value>(
      stream,
      [&](const auto& visit) {
        for (const auto& [key, value] : map) visit(key, value);
      },
      [&](const Key& key, Value&& value) { map.insert_or_assign(key, std::move(value)); });
}

template <class Stream, class Value>
bool keep(Stream& stream, ObjectMap<Value>& map) {
  if constexpr (Stream::is_reading) map = {};
  bool is_sound = true;
  const bool is_read = keep_elements<ObjectHandle, Value>(
      stream, [&](const auto& visit) { map.for_each(visit); },
      [&](ObjectHandle object, Value&& value) {
        is_sound &= static_cast<bool>(object);
        if (object) map[object] = std::move(value);
      });
  return is_read && is_sound;
}

template <class Stream>
bool keep(Stream& stream, Bitmap& set) {
  std::vector<std::uint64_t> words(set.word_count());
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = set.word(i);
  while (!words.empty() && words.back() == 0) words.pop_back();
  if (!keep(stream, words)) return false;
  if constexpr (Stream::is_reading) {
    set = {};
    for (std::size_t i = 0; i < words.size(); ++i) set.insert_word(i, words[i]);
  }
  return true;
}

}  // namespace kept

/// Writes or reads the values in this order.
template <class Stream, class... Values>
bool keep_all(Stream& stream, Values&... values) {
  using namespace kept;
  return (keep(stream, values) && ...);
}

}  // namespace rink::rti
