// What is measured of an RTI, by the standard's C++ API and by Rink's own: the amounts, what is
// sent, and what comes out. C++14, as the standard's API is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace rink_driver {

constexpr std::uint64_t object_count = 100;
/// Rounds of updates that are under way at most, below what any queue holds: an RTI may send newest
/// states only to whoever is further behind.
constexpr std::uint64_t round_window = 32;

/// One update's content, 24 bytes: any mix-up of objects, rounds or bytes shows.
struct State {
  std::uint64_t object = 0, round = 0, check = 0;

  static std::uint64_t mixed(std::uint64_t object, std::uint64_t round) {
    return (object * 0x9E3779B97F4A7C15u) ^ (round * 0xC2B2AE3D27D4EB4Fu);
  }
  static State of(std::uint64_t object, std::uint64_t round) {
    State state;
    state.object = object;
    state.round = round;
    state.check = mixed(object, round);
    return state;
  }
  /// False if there are not 24 sound bytes.
  static bool read(const void* bytes, std::size_t size, State& state) {
    if (size != sizeof(State)) return false;
    std::memcpy(&state, bytes, size);
    return state.check == mixed(state.object, state.round);
  }
};
static_assert(sizeof(State) == 24, "no padding");

/// What a federate has received in one run. Sound: each object's rounds in order, none missing.
struct Received {
  std::uint64_t discovered = 0, updates = 0, valued = 0;
  bool is_spoilt = false;
  std::uint64_t next_round[object_count] = {};

  void update(const void* bytes, std::size_t size) {
    State state;
    if (!State::read(bytes, size, state) || state.object >= object_count) {
      is_spoilt = true;
      return;
    }
    if (next_round[state.object] != state.round) is_spoilt = true;
    next_round[state.object] = state.round + 1;
    ++updates;
  }
};

struct Outcome {
  double seconds = 0.0, processor_seconds = 0.0;  ///< of the whole process
  std::uint64_t count = 0;                        ///< of what the run is about, all of it received
  std::string fault;                              ///< empty: all that was sent came, once and right
};

/// The RTI, and the object model's file (driver.xml).
struct Place {
  std::string host;
  unsigned short port = 0;
  std::string model;
};

}  // namespace rink_driver
