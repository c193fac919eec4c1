// The frames between peers, which are the RTI's: a head, then the kind and what is in it, whose
// length the head has.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "rti/wire/frame.h"
#include "rti/wire/stream.h"

namespace rink::game {

inline constexpr std::uint32_t stranger_frame_max =
    32 * 1024;  ///< of connections that are not admitted [bytes]
inline constexpr std::uint32_t peer_frame_max =
    1u << 30;  ///< the states of four million bodies [bytes]

struct Frame {
  FrameKind kind = FrameKind::hello;
  std::vector<std::uint8_t> content;
};

/// Of what those of another version must be able to read, the older one.
inline rti::FrameForm form_of(FrameKind kind) {
  return kind == FrameKind::hello || kind == FrameKind::refusal ? rti::FrameForm::older
                                                                : rti::FrameForm::present;
}

/// The size [bytes] of a frame between peers that play.
constexpr std::size_t framed_size(std::size_t content_size) {
  return rti::frame_head_size(1 + content_size) + 1 + content_size;
}

inline std::vector<std::byte> framed(FrameKind kind, std::span<const std::uint8_t> content) {
  assert(kind <= frame_kind_max && content.size() < peer_frame_max);
  rti::FrameWriter writer(peer_frame_max, form_of(kind));
  writer.buffer().reserve(rti::frame_head_max + 1 + content.size());
  std::vector<std::byte>& bytes = writer.begin_message(1 + content.size());
  rti::Writer stream(bytes);
  rti::Bytes view = std::as_bytes(content);
  stream.number(kind), stream.rest(view, view.size());
  writer.appended();
  return std::move(bytes);
}

/// Nothing if the payload is of no kind that there is. It is not empty.
inline std::optional<Frame> frame_of(rti::Bytes payload) {
  Frame frame;
  rti::Reader stream(payload);
  if (!stream.choice(frame.kind, frame_kind_max)) return std::nullopt;
  const auto* const content = reinterpret_cast<const std::uint8_t*>(stream.rest().data());
  frame.content.assign(content, content + stream.left());
  return frame;
}

/// The frames of a connection, taken when their reader is ready for them: it may wait until it
/// knows who sends them. What has come waits here.
class FrameQueue {
 public:
  /// The bytes are not copied as long as all before them has been taken: call `keep` before they
  /// end.
  void add(rti::Bytes bytes) {
    keep();
    if (is_broken_) return;
    if (waiting_.empty()) fresh_ = bytes;
    else waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  }
  /// Copies what was added last and not taken.
  void keep() {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(begin_));
    waiting_.insert(waiting_.end(), fresh_.begin(), fresh_.end());
    fresh_ = {}, begin_ = 0;
  }
  /// The next whole frame of at most `length_max` bytes; nothing if there is none yet, or none ever
  /// because of `is_broken`.
  std::optional<Frame> next(std::uint32_t length_max) {
    if (is_broken_) return std::nullopt;
    rti::Bytes rest = waiting_.empty() ? fresh_ : rti::Bytes(waiting_).subspan(begin_), payload;
    const std::size_t before = rest.size();
    is_broken_ = reader_.next(rest, length_max, payload) != rti::Framing::sound;
    if (waiting_.empty()) fresh_ = rest;
    else begin_ += before - rest.size();
    std::optional<Frame> frame;
    if (!is_broken_ && !payload.empty()) {
      frame = frame_of(payload);
      is_broken_ = !frame || reader_.form() != form_of(frame->kind);
    }
    if (is_broken_) frame.reset();
    if (is_broken_) waiting_.clear(), fresh_ = {}, begin_ = 0;
    return frame;
  }
  bool is_broken() const { return is_broken_; }
  /// What was added and not taken, but for the beginning of a frame [bytes].
  std::size_t waiting_bytes() const { return waiting_.size() - begin_ + fresh_.size(); }

 private:
  rti::FrameReader reader_;
  std::vector<std::byte> waiting_;
  std::size_t begin_ = 0;  ///< of what `reader_` has not seen
  rti::Bytes fresh_;       ///< added last, where nothing waits before it
  bool is_broken_ = false;
};

}  // namespace rink::game
