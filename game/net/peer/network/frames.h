// Frames cut out of a stream of bytes: four bytes of length, lowest first, then the kind and what
// is in it, which the length counts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "rti/wire/bytes.h"

namespace rink::game {

inline constexpr std::size_t frame_head = 5;
inline constexpr std::uint32_t stranger_frame_max =
    32 * 1024;  ///< of connections that are not admitted [bytes]
inline constexpr std::uint32_t peer_frame_max =
    1u << 30;  ///< the states of four million bodies [bytes]

struct Frame {
  FrameKind kind = FrameKind::hello;
  std::vector<std::uint8_t> content;
};

inline std::vector<std::uint8_t> framed(FrameKind kind, std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes(frame_head + content.size());
  const std::size_t length = content.size() + 1;
  for (std::size_t k = 0; k < 4; ++k) bytes[k] = static_cast<std::uint8_t>(length >> (8 * k));
  bytes[4] = static_cast<std::uint8_t>(kind);
  if (!content.empty()) std::memcpy(bytes.data() + frame_head, content.data(), content.size());
  return bytes;
}

class FrameReader {
 public:
  void add(rti::Bytes bytes) {
    if (bytes.empty()) return;
    if (begin_ > 0)
      bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_)),
          begin_ = 0;
    const std::size_t before = bytes_.size();
    bytes_.resize(before + bytes.size());
    std::memcpy(bytes_.data() + before, bytes.data(), bytes.size());
  }
  /// The next whole frame; nothing if there is none yet, or none ever because of `is_broken`.
  std::optional<Frame> next(std::uint32_t length_max) {
    const std::span<const std::uint8_t> rest = std::span(bytes_).subspan(begin_);
    if (is_broken_ || rest.size() < frame_head) return std::nullopt;
    std::uint32_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length |= static_cast<std::uint32_t>(rest[k]) << (8 * k);
    is_broken_ =
        length == 0 || length > length_max || rest[4] > static_cast<std::uint8_t>(frame_kind_max);
    if (is_broken_ || rest.size() < length + std::size_t{4}) return std::nullopt;
    Frame frame{static_cast<FrameKind>(rest[4]), std::vector<std::uint8_t>(length - 1)};
    if (length > 1) std::memcpy(frame.content.data(), rest.data() + frame_head, length - 1);
    begin_ += length + std::size_t{4};
    return frame;
  }
  bool is_broken() const { return is_broken_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t begin_ = 0;
  bool is_broken_ = false;
};

}  // namespace rink::game
