// The frames between peers, which are the RTI's: a length of four bytes, then the kind and what is
// in it, which the length counts.
#pragma once

#include <cassert>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "rti/wire/frame.h"

namespace rink::game {

inline constexpr std::size_t frame_head = rti::frame_header_size + 1;  ///< with the kind [bytes]
inline constexpr std::uint32_t stranger_frame_max =
    32 * 1024;  ///< of connections that are not admitted [bytes]
inline constexpr std::uint32_t peer_frame_max =
    1u << 30;  ///< the states of four million bodies [bytes]

struct Frame {
  FrameKind kind = FrameKind::hello;
  std::vector<std::uint8_t> content;
};

inline std::vector<std::uint8_t> framed(FrameKind kind, std::span<const std::uint8_t> content) {
  assert(kind <= frame_kind_max && content.size() < peer_frame_max);
  std::vector<std::uint8_t> bytes(frame_head + content.size());
  const auto length = static_cast<std::uint32_t>(content.size() + 1);
  std::memcpy(bytes.data(), &length, rti::frame_header_size);
  bytes[rti::frame_header_size] = static_cast<std::uint8_t>(kind);
  if (!content.empty()) std::memcpy(bytes.data() + frame_head, content.data(), content.size());
  return bytes;
}

/// Nothing if the payload is of no kind that there is. It is not empty.
inline std::optional<Frame> frame_of(rti::Bytes payload) {
  assert(!payload.empty());
  if (payload[0] > static_cast<std::byte>(frame_kind_max)) return std::nullopt;
  Frame frame{static_cast<FrameKind>(payload[0]), std::vector<std::uint8_t>(payload.size() - 1)};
  if (payload.size() > 1) std::memcpy(frame.content.data(), &payload[1], payload.size() - 1);
  return frame;
}

/// The frames of a connection, taken when their reader is ready for them: it may wait until it
/// knows who sends them. What has come waits here.
class FrameQueue {
 public:
  void add(rti::Bytes bytes) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  }
  /// The next whole frame of at most `length_max` bytes; nothing if there is none yet, or none ever
  /// because of `is_broken`.
  std::optional<Frame> next(std::uint32_t length_max) {
    if (is_broken_) return std::nullopt;
    rti::Bytes rest = rti::Bytes(waiting_).subspan(begin_), payload;
    is_broken_ = reader_.next(rest, length_max, payload) != rti::Framing::sound;
    begin_ = waiting_.size() - rest.size();
    if (is_broken_ || payload.empty()) return std::nullopt;
    std::optional<Frame> frame = frame_of(payload);
    is_broken_ = !frame;
    return frame;
  }
  bool is_broken() const { return is_broken_; }

 private:
  rti::FrameReader reader_;
  std::vector<std::byte> waiting_;
  std::size_t begin_ = 0;  ///< of what `reader_` has not seen
  bool is_broken_ = false;
};

}  // namespace rink::game
