// The parameters of Inspect and Interest, by which a server's decisions reach watchers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "game/match/interest_seen.h"

namespace rink::game {

/// The object that a watcher asks about, by its handle, or InterestSeen::nothing.
struct Inspection {
  std::uint32_t object = InterestSeen::nothing;
};

inline constexpr std::size_t interest_bytes_max = 32'000;  ///< of one answer
inline constexpr std::uint16_t interest_views_max = 700;   ///< in one answer: half of its bytes

template <class Stream>
bool exchange(Stream& stream, Inspection& inspection) {
  return stream.number(inspection.object);
}

template <class Stream>
bool exchange(Stream& stream, InterestSeen::View& view) {
  auto hears = static_cast<std::uint8_t>(view.hears);
  if (!stream.number(view.bat) || !stream.range(hears, 1)) return false;
  view.hears = hears != 0;
  return stream.number(view.low_x) && stream.number(view.low_y) && stream.number(view.high_x) &&
         stream.number(view.high_y);
}

/// The counts, the views, and up to the end the steps from one received object to the next, of
/// which all but the first are short.
template <class Stream>
bool exchange(Stream& stream, InterestSeen& seen) {
  auto views = static_cast<std::uint16_t>(seen.views.size());
  if (!stream.number(seen.asked) || !stream.number(seen.cell_size) ||
      !stream.varint(seen.view_count) || !stream.varint(seen.heard_count) ||
      !stream.varint(seen.hearer_count))
    return false;
  if (!stream.range(views, interest_views_max)) return false;
  if constexpr (Stream::is_reading) seen.views.resize(views), seen.heard.clear();
  for (InterestSeen::View& view : seen.views)
    if (!exchange(stream, view)) return false;
  std::uint32_t before = 0, step = 0;
  if constexpr (Stream::is_reading) {
    for (; !stream.is_at_end(); seen.heard.push_back(before += step))
      if (!stream.varint(step) || step > InterestSeen::nothing - before) return false;
  } else {
    for (const std::uint32_t object : seen.heard) {
      step = object - before;
      stream.varint(step);
      before = object;
    }
  }
  return true;
}

}  // namespace rink::game
