// Stamps of a sequence of frames, each as so many steps from the one before it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "im/basics/varint.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// The last stamp that was sent by steps, and the step from it to the next: both ends change it by
/// the same messages. A tick of one period leads to a time that differs by a few units of the last
/// place from the one before and a step, and their bits by so much: nothing is rounded.
struct StampSteps {
  double time = 0.0, time_step = 0.0;
  std::uint64_t tag = 0, tag_step = 0;
};

/// So many steps onwards, and what is still between; no steps: the difference, which is the next
/// step.
struct StampStepMessage {
  static constexpr MessageKind kind = MessageKind::stamp_step;
  static constexpr std::uint64_t count_max = 64;
  std::uint64_t count = 0, time = 0, tag = 0;  ///< the latter two zigzag
  /// One step, but for some units of the last place of the time: nearly all stamps are.
  bool is_next() const { return count == 1 && tag == 0 && time >> 32 == 0; }
};
/// The lowest bit of the first number says that the time is above it and all; else the count is.
template <class Stream>
bool exchange(Stream& stream, StampStepMessage& message) {
  std::uint64_t first = 0;
  if (!Stream::is_reading) first = message.is_next() ? message.time << 1 | 1u : message.count << 1;
  if (!stream.varint(first)) return false;
  if ((first & 1u) != 0) return message = {1, first >> 1, 0}, true;
  message.count = first >> 1;
  return message.count <= StampStepMessage::count_max && stream.varint(message.time) &&
         stream.varint(message.tag);
}

/// Product and sum are rounded apart, also where a processor could do both at once: both ends must
/// come to the same bits.
inline double steps_on(const StampSteps& steps, std::uint64_t count) {
  if (count == 0) return steps.time;
  const volatile double way = static_cast<double>(count) * steps.time_step;
  return steps.time + way;
}

/// False if the message leads to no stamp.
inline bool follow(StampSteps& steps, const StampStepMessage& message, Stamp& stamp) {
  const auto rest = static_cast<std::uint64_t>(from_zigzag(message.time)),
             tag = static_cast<std::uint64_t>(from_zigzag(message.tag));
  const auto time =
      std::bit_cast<double>(std::bit_cast<std::uint64_t>(steps_on(steps, message.count)) + rest);
  if (!std::isfinite(time)) return false;
  if (message.count == 0) steps.time_step = time - steps.time, steps.tag_step = tag;
  steps.time = time;
  steps.tag += message.count * steps.tag_step + tag;
  stamp = {steps.time, steps.tag};
  return true;
}

/// The message that leads to `stamp` by steps; nothing if it would be no shorter than a new step.
inline std::optional<StampStepMessage> steps_to(const StampSteps& steps, const Stamp& stamp) {
  constexpr std::int64_t rest_max = 1 << 20;
  const double steps_between = std::round((stamp.time - steps.time) / steps.time_step);
  if (!(steps_between >= 1.0 && steps_between <= StampStepMessage::count_max)) return std::nullopt;
  const auto count = static_cast<std::uint64_t>(steps_between);
  const auto time_rest =
                 static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(stamp.time) -
                                           std::bit_cast<std::uint64_t>(steps_on(steps, count))),
             tag_rest = static_cast<std::int64_t>(stamp.tag - steps.tag - count * steps.tag_step);
  if (time_rest > rest_max || time_rest < -rest_max || tag_rest > rest_max || tag_rest < -rest_max)
    return std::nullopt;
  return StampStepMessage{count, zigzag(time_rest), zigzag(tag_rest)};
}
/// The message that makes the way to `stamp` the next step.
inline StampStepMessage step_to(const StampSteps& steps, const Stamp& stamp) {
  return {0,
          zigzag(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(stamp.time) -
                                           std::bit_cast<std::uint64_t>(steps.time))),
          zigzag(static_cast<std::int64_t>(stamp.tag - steps.tag))};
}

}  // namespace rink::rti
