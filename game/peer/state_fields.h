// A body's state and contacts as a message has them: whole, or as those fields of a
// state that another one, which both ends know, has not.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "game/physics/body_state.h"
#include "im/basics/byte_stream.h"

namespace rink::peer {

using physics::BodyState;
using physics::RestContact;

/// Fields that change most often come first, those of the scene last.
template <class Stream>
bool exchange(Stream& stream, BodyState& s) {
  auto& [flight, mass, inverse_mass, half_extent, thrust, acceleration, drag, impacts_begin,
         last_hop, impacts, hops, repeats, repeats_instant, rest_time, slowing, spin, jam, kind,
         material, half, flags, mouth] = s;
  return stream.numbers(flight.x, flight.y, flight.vx, flight.vy, flight.time, impacts_begin,
                        impacts, thrust.x(), thrust.y(), acceleration.x(), acceleration.y(),
                        last_hop, hops, spin, repeats, repeats_instant, rest_time, slowing.x(),
                        slowing.y(), jam, flags, mouth, drag.x(), drag.y(), flight.radius, mass,
                        inverse_mass, half_extent.x(), half_extent.y()) &&
         stream.choice(kind, physics::BodyKind::post) && stream.number(material) &&
         stream.choice(half, physics::Half::both);
}

template <class Stream>
bool exchange(Stream& stream, RestContact& rest) {
  auto& [low, high, axis, pull_time, force, turn_time, age] = rest;
  return stream.numbers(low, high, axis, pull_time, force, turn_time, age.time, age.lower,
                        age.higher, age.rank) &&
         stream.truth(age.follows_keys) && (axis == 0 || axis == 1);
}

/// The fields of a state in the order of `exchange`.
class StateFields {
 public:
  explicit StateFields(BodyState state) {
    Taker taker(*this);
    exchange(taker, state);
  }
  std::size_t count() const { return count_; }
  /// The `size_of` lowest bytes of a word.
  std::uint64_t& operator[](std::size_t field) {
    assert(field < count_);
    return words_[field];
  }
  std::size_t size_of(std::size_t field) const {
    assert(field < count_);
    return sizes_[field];
  }
  /// False if they are no state's.
  bool write_to(BodyState& state) {
    Giver giver(*this);
    return exchange(giver, state);
  }

 private:
  class Taker : public ByteStream<Taker> {
   public:
    static constexpr bool is_reading = false;
    explicit Taker(StateFields& fields) : fields_(fields) {}
    bool part(const std::uint64_t& value, std::size_t size) {
      assert(fields_.count_ < count_max);
      fields_.words_[fields_.count_] = value;
      fields_.sizes_[fields_.count_++] = static_cast<std::uint8_t>(size);
      return true;
    }
    static bool check([[maybe_unused]] bool is_sound) {
      assert(is_sound);
      return true;
    }

   private:
    StateFields& fields_;
  };
  class Giver : public ByteStream<Giver> {
   public:
    static constexpr bool is_reading = true;
    explicit Giver(const StateFields& fields) : fields_(fields) {}
    bool part(std::uint64_t& value, [[maybe_unused]] std::size_t size) {
      assert(next_ < fields_.count_ && size == fields_.sizes_[next_]);
      value = fields_.words_[next_++];
      return true;
    }
    static bool check(bool is_sound) { return is_sound; }

   private:
    const StateFields& fields_;
    std::size_t next_ = 0;
  };

  static constexpr std::size_t count_max = 32;
  std::array<std::uint64_t, count_max> words_;
  std::array<std::uint8_t, count_max> sizes_;
  std::size_t count_ = 0;
};

/// A mask:v, and the fields of its bits: a puck that had only free impacts since `before` takes 41
/// bytes instead of 209.
template <class Stream>
bool exchange_changes(Stream& stream, BodyState& state, const BodyState& before) {
  StateFields old(before), now(state);
  assert(old.count() == now.count());
  std::uint64_t mask = 0;
  for (std::size_t field = 0; field < now.count(); ++field)
    mask |= static_cast<std::uint64_t>(now[field] != old[field]) << field;
  if (!stream.varint(mask) || mask >> now.count() != 0) return false;
  for (std::size_t field = 0; field < now.count(); ++field) {
    if ((mask >> field & 1) == 0) now[field] = old[field];
    else if (!stream.part(now[field], now.size_of(field))) return false;
  }
  if constexpr (Stream::is_reading) return now.write_to(state);
  else return true;
}

/// Numbers as what they are more or less than the one before, modulo 2^32: few bytes where they
/// rise.
class NumberGaps {
 public:
  template <class Stream>
  bool exchange(Stream& stream, std::uint32_t& number) {
    const std::uint32_t gap = number - before_;
    std::uint32_t folded = gap << 1 ^ (gap >> 31 != 0 ? ~0u : 0u);
    if (!stream.varint(folded)) return false;
    if constexpr (Stream::is_reading)
      number = before_ + (folded >> 1 ^ ((folded & 1) != 0 ? ~0u : 0u));
    before_ = number;
    return true;
  }

 private:
  std::uint32_t before_ = 0;
};

}  // namespace rink::peer
