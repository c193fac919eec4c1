// Messages of any kind whose fields are guesses: well-formed for the most part, so that they reach
// what looks at their meaning.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "rti/wire/message.h"
#include "tests/rti/bare.h"

namespace rink::rti::testing {

/// Reads a message that nobody has written: makes up each field as it is asked for, and keeps the
/// bytes. One field in sixteen is out of its range.
class Guess {
 public:
  static constexpr bool is_reading = true;
  Guess(std::mt19937& random, std::vector<std::byte>& bytes) : random_(random), bytes_(bytes) {}
  bool is_at_end() const { return true; }
  bool check(bool is_so) const { return is_so; }

  template <class Number>
  bool number(Number& value) {
    value = any<Number>();
    return keep(value);
  }
  template <class Number>
  bool varint(Number& value) {
    value = any<Number>();
    std::byte coded[varint_size_max];
    bytes_.insert(bytes_.end(), coded, put_varint(coded, static_cast<std::uint64_t>(value)));
    return true;
  }
  bool part(std::uint64_t& value, std::size_t size) {
    if (size > sizeof value) return false;
    value = any<std::uint64_t>() &
            (size == sizeof value ? ~std::uint64_t{0} : (std::uint64_t{1} << (8 * size)) - 1);
    const auto* at = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), at, at + size);
    return true;
  }
  template <class Number>
  bool range(Number& value, std::uint64_t max) {
    const std::uint64_t small = random_() % 4 == 0 ? 255 : 3,
                        any_small = random_() % (std::min(max, small) + 1);
    value = static_cast<Number>(random_() % 16 == 0 ? max + 1 : any_small);
    return keep(value);
  }
  bool finite(double& value) {
    const std::array times{0.0, 0.5, 1.0, 2.0, 1e9, -1.0, std::nan(""), HUGE_VAL};
    const std::size_t count = random_() % 16 == 0 ? times.size() : 5;
    value = times[random_() % count];
    return keep(value);
  }
  template <class Length>
  bool bytes(Bytes& value, std::size_t max) {
    if (random_() % 4 == 0) {  // a list of names
      std::vector<std::byte>& names = made_.emplace_back();
      for (std::size_t count = random_() % 4; count > 0; --count) {
        const std::string_view name = this->name();
        names.push_back(static_cast<std::byte>(name.size()));
        for (const char character : name) names.push_back(static_cast<std::byte>(character));
      }
      keep(static_cast<Length>(names.size()));
      bytes_.insert(bytes_.end(), names.begin(), names.end());
      value = names;
      return true;
    }
    std::size_t size = random_() % 16 == 0  ? std::min<std::size_t>(max + 1, 400)
                       : random_() % 4 == 0 ? 4 * (random_() % 4)
                                            : random_() % 20;
    size = std::min<std::size_t>(size, std::numeric_limits<Length>::max());
    keep(static_cast<Length>(size));
    return rest(value, size);
  }
  bool text(std::string_view& value, std::size_t max) {
    if (random_() % 16 == 0) {
      Bytes view;
      return bytes<std::uint8_t>(view, max);
    }
    value = name();
    keep(static_cast<std::uint8_t>(value.size()));
    const Bytes view = std::as_bytes(std::span(value));
    bytes_.insert(bytes_.end(), view.begin(), view.end());
    return true;
  }
  bool rest(Bytes& value, std::size_t size) {
    std::vector<std::byte>& made = made_.emplace_back(size);
    const std::uint32_t of = size % 16 == 0 ? 2 : random_() % 4;  // bytes, numbers, ranges
    const auto put = [&made](std::size_t at, auto number) {
      if (at + sizeof number <= made.size()) std::memcpy(made.data() + at, &number, sizeof number);
    };
    for (std::size_t at = 0; at < size; at += of == 2 ? 16 : 4) {
      if (of == 0) put(at, static_cast<std::uint32_t>(random_()));
      else if (of == 2)
        put(at, static_cast<double>(random_() % 3)),
            put(at + 8, static_cast<double>(2 + random_() % 3));
      else put(at, any<std::uint32_t>());
    }
    bytes_.insert(bytes_.end(), made.begin(), made.end());
    value = made;
    return true;
  }

 private:
  /// For the most part one that somebody has used.
  std::string_view name() {
    const std::array<std::string_view, 8> names{"Aurora", "start", "rink",   "witness",
                                                "guess",  "",      "tester", "Vessel"};
    return names[random_() % names.size()];
  }
  /// Numbers of what there is: classes, attributes, objects, regions, federates.
  template <class Number>
  Number any() {
    if constexpr (std::is_floating_point_v<Number>) return static_cast<Number>(random_() % 4);
    else {
      const std::array<std::uint64_t, 11> numbers{0,
                                                  1,
                                                  2,
                                                  3,
                                                  object_block,
                                                  object_block + 1,
                                                  vessel_number,
                                                  7,
                                                  0xffffffffu,
                                                  ~std::uint64_t{0},
                                                  random_()};
      const std::size_t count = random_() % 8 == 0 ? numbers.size() : 7;
      return static_cast<Number>(numbers[random_() % count]);
    }
  }
  template <class Number>
  bool keep(const Number& value) {
    const auto* at = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), at, at + sizeof value);
    return true;
  }

  std::mt19937& random_;
  std::vector<std::byte>& bytes_;
  std::vector<std::vector<std::byte>> made_;
};

/// A frame of one message of that type, now and then with a tail: records that it announces, or
/// what does not belong to it.
template <class Message>
std::vector<std::byte> guessed_frame(std::mt19937& random) {
  std::vector<std::byte> bytes;
  bytes.push_back(static_cast<std::byte>(Message::kind));
  Message message;
  Guess guess(random, bytes);
  exchange(guess, message);
  if (random() % 2 == 0) {
    for (std::size_t size = random() % 24; size > 0; --size)
      bytes.push_back(static_cast<std::byte>(random() % 3 == 0 ? random() : random() % 6));
    bytes.push_back(std::byte{0});
  }
  return in_frame(bytes);
}

/// One for each kind: its number, and what makes a frame of it.
struct Guesser {
  MessageKind kind;
  std::vector<std::byte> (*frame)(std::mt19937&);
};
template <class... Messages>
std::vector<Guesser> guessers_of() {
  return {{Messages::kind, &guessed_frame<Messages>}...};
}

}  // namespace rink::rti::testing
