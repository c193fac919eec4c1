// What a verdict says of single instants of its sender's run, and of where the sender looks.
#pragma once

#include <cmath>
#include <cstdint>

#include "game/peer/box.h"

namespace rink::peer {

/// An instant at which the sender's run has so many events with own bodies, or a joint impact that
/// has no solution, that it may depend on events anywhere in the field.
struct CriticalInstant {
  double time = 0.0;         ///< s
  std::uint64_t events = 0;  ///< with own bodies
  bool is_unsolved = false;
};

/// The events of the sender's run at an instant that all were asked about.
struct InstantReport {
  std::uint64_t events = 0, own = 0,
                led = 0;     ///< all; those with an own body; those whose first body is own
  std::uint64_t digest = 0;  ///< of what all of them did
};

/// A part of the field, its sides rounded outwards [m].
struct Annex {
  float low_x = 0.0f, low_y = 0.0f, high_x = 0.0f, high_y = 0.0f;
  Box box() const { return {low_x, low_y, high_x, high_y}; }
};

template <class Stream>
bool exchange(Stream& stream, CriticalInstant& instant) {
  return stream.number(instant.time) && stream.varint(instant.events) &&
         stream.truth(instant.is_unsolved) && std::isfinite(instant.time);
}

template <class Stream>
bool exchange(Stream& stream, InstantReport& report) {
  return stream.varint(report.events) && stream.varint(report.own) && stream.varint(report.led) &&
         stream.number(report.digest);
}

/// Sides may lie at infinity.
template <class Stream>
bool exchange(Stream& stream, Annex& annex) {
  return stream.numbers(annex.low_x, annex.low_y, annex.high_x, annex.high_y) &&
         annex.low_x <= annex.high_x && annex.low_y <= annex.high_y;
}

}  // namespace rink::peer
