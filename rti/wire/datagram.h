// Datagrams of best-effort updates: their head, their acknowledgement, and the order between them
// and the frames of the stream (docs/wire.md, "Datagrams").
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "rti/fom/fom.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// What every datagram begins with.
struct DatagramHead {
  static constexpr std::size_t size = 8;
  std::uint32_t number = 0;  ///< counts from 1 in each direction of a connection; 0: not to be
                             ///< acknowledged
  std::uint32_t frames = 0;  ///< of the stream, sent to the same receiver before it
};
template <class Stream>
bool exchange(Stream& stream, DatagramHead& head) {
  return stream.number(head.number) && stream.number(head.frames);
}

/// Ends the messages of a datagram; what follows is padding, so that many datagrams of one size can
/// be sent at once.
inline constexpr std::uint8_t datagram_end = 0;

/// Bit k of `before` means that datagram `newest` - 1 - k has arrived.
template <MessageKind k>
struct AcknowledgeMessage {
  static constexpr MessageKind kind = k;
  static constexpr std::uint32_t window = 64;
  std::uint32_t newest = 0;
  std::uint64_t before = 0;
  bool has(std::uint32_t number) const {
    const std::uint32_t age = newest - number;
    return age == 0 || (age <= window && (before >> (age - 1) & 1u) != 0);
  }
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, AcknowledgeMessage<k>& message) {
  return stream.number(message.newest) && stream.number(message.before);
}
using AcknowledgeDatagramsMessage = AcknowledgeMessage<MessageKind::acknowledge_datagrams>;

/// Which datagrams have arrived.
class DatagramReceipts {
 public:
  static constexpr std::uint32_t per_acknowledgement =
      32;  ///< half a window, so that each is acknowledged twice
  static constexpr double longest_delay_s =
      0.1;  ///< before what arrived is acknowledged [s], unless one is missing: reading an
            ///< acknowledgement costs a fourth of what sending a tick does

  /// False if it has been noted before, or is too old for an acknowledgement.
  bool note(std::uint32_t number) {
    AcknowledgeDatagramsMessage& state = state_;
    if (number <= state.newest) {
      const std::uint32_t age = state.newest - number;
      if (age > state.window || state.has(number)) return false;
      state.before |= std::uint64_t{1} << (age - 1);
    } else {
      const std::uint32_t step = number - state.newest;
      // Datagram 0, which does not exist, is not acknowledged.
      state.before = step > state.window
                         ? 0
                         : (step == state.window ? 0 : state.before << step) |
                               (state.newest == 0 ? 0 : std::uint64_t{1} << (step - 1));
      has_gap_ |= step > 1;
      state.newest = number;
    }
    ++due_;
    return true;
  }
  /// True if an acknowledgement should be sent now: many are due, or one is missing and may have to
  /// be sent again.
  bool is_urgent() const { return due_ >= per_acknowledgement || (has_gap_ && due_ > 0); }
  bool is_due() const { return due_ > 0; }
  /// The acknowledgement of all that was noted.
  AcknowledgeDatagramsMessage acknowledge() {
    due_ = 0;
    has_gap_ = false;
    return state_;
  }

 private:
  AcknowledgeDatagramsMessage state_;
  std::uint32_t due_ = 0;
  bool has_gap_ = false;
};

/// Orders datagrams and frames of one direction by when they were sent: a datagram after the frames
/// that it counts, one of a higher number after one of a lower.
inline std::uint64_t order_of_datagram(const DatagramHead& head) {
  return std::uint64_t{head.frames} << 32 | head.number;
}
/// `frame` counts from 1.
inline std::uint64_t order_of_frame(std::uint32_t frame) { return std::uint64_t{frame} << 32; }

/// Attributes of a class that travel by datagram where there is a channel: best-effort and in
/// receive order, since time-stamp order waits for all that was sent before.
inline AttributeSet best_effort_attributes(const ObjectClass& object_class) {
  AttributeSet set;
  for (std::uint32_t i = 0; i < object_class.attributes.size(); ++i)
    if (object_class.attributes[i].transportation == Transportation::best_effort &&
        object_class.attributes[i].order == Order::receive)
      set.insert({i});
  return set;
}

}  // namespace rink::rti
