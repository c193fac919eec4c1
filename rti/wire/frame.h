// Frames: messages gathered under one length, cut and joined again from a stream of bytes.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <vector>

#include "rti/wire/bytes.h"

namespace rink::rti {

inline constexpr std::size_t frame_header_size = 4;  ///< the payload's length, u32
inline constexpr std::size_t frame_max_to_rti =
    64 * 1024;  ///< longest payload that a joined federate may send [bytes]
inline constexpr std::size_t frame_max_to_join = 1024;  ///< and one that has not joined
inline constexpr std::size_t frame_max_to_federate = 64u
                                                     << 20;  ///< longest payload that the RTI sends

/// Of the payload, as a header says.
inline std::size_t frame_length(Bytes header) {
  assert(header.size() >= frame_header_size);
  std::uint32_t length = 0;
  std::memcpy(&length, header.data(), sizeof length);
  return length;
}

/// Collects messages in frames; a frame is closed when the next message would not fit.
class FrameWriter {
 public:
  explicit FrameWriter(std::size_t payload_max) : payload_max_(payload_max) {
    assert(0 < payload_max && payload_max <= 0xffffffffu);  // a header has room for that
  }

  /// Where to append one message of `size` bytes. Call `appended` when it is written.
  std::vector<std::byte>& begin_message(std::size_t size) {
    if (!is_open_ || payload_size() + size > payload_max_) open();
    return bytes_;
  }
  /// True if the frame at the end takes `size` more bytes.
  bool has_room(std::size_t size) const {
    return is_open_ && payload_size() + size <= payload_max_;
  }
  bool is_open() const { return is_open_; }
  std::vector<std::byte>& buffer() { return bytes_; }
  /// The frame's length becomes true again.
  void appended() {
    assert(is_open_ && payload_size() > 0);  // a frame without a message ends a conversation
    const auto length = static_cast<std::uint32_t>(payload_size());
    std::memcpy(bytes_.data() + start_, &length, sizeof length);
  }
  /// The next message starts a new frame.
  void close_frame() { is_open_ = false; }
  Bytes bytes() const { return bytes_; }
  std::uint64_t frame_count() const { return frame_count_; }
  std::size_t memory_bytes() const { return bytes_.capacity(); }
  void clear() {
    bytes_.clear();
    is_open_ = false;
  }

 private:
  std::size_t payload_size() const { return bytes_.size() - start_ - frame_header_size; }
  void open() {
    start_ = bytes_.size();
    bytes_.resize(start_ + frame_header_size);
    is_open_ = true;
    ++frame_count_;
  }

  std::vector<std::byte> bytes_;
  std::size_t payload_max_;
  std::size_t start_ = 0;
  bool is_open_ = false;
  std::uint64_t frame_count_ = 0;
};

/// The result of reading bytes by a `FrameReader`. Any but `sound` ends the stream: what was not
/// read is lost.
enum class Framing : std::uint8_t {
  sound,      ///< all bytes are read, or kept until their frame is whole
  stopped,    ///< the callable that takes frames wants no more
  empty,      ///< a frame without a message, as in a stream of zeros
  oversized,  ///< a frame longer than allowed
};

/// Finds whole frames in a stream that may be cut anywhere. Keeps at most one frame's bytes and
/// reserves no memory for a length before the bytes are there.
class FrameReader {
 public:
  /// Gives each payload to `take`, a callable `bool(Bytes)`; stops as soon as it returns false, or
  /// at a length of 0 or beyond the limit. `limit()` is called before each frame, since messages
  /// may change it. Nothing is copied of frames that arrive whole. The caller must end the
  /// connection unless all was sound.
  template <class Limit, class Take>
  [[nodiscard]] Framing receive(Bytes bytes, Limit limit, Take take) {
    while (!bytes.empty()) {
      Bytes payload;
      if (const Framing framing = next(bytes, limit(), payload); framing != Framing::sound)
        return framing;
      if (!payload.empty() && !take(payload)) return Framing::stopped;
    }
    return Framing::sound;
  }
  /// Takes one frame from the front of `bytes` and gives its payload, which is valid until the next
  /// call. While it is not whole, all bytes are taken and the payload is empty.
  [[nodiscard]] Framing next(Bytes& bytes, std::size_t limit, Bytes& payload) {
    payload = {};
    if (partial_.empty() && bytes.size() >= frame_header_size) {
      const std::size_t size = frame_length(bytes);
      if (const Framing judged = judge(size, limit); judged != Framing::sound) return judged;
      if (bytes.size() >= frame_header_size + size) {
        payload = bytes.subspan(frame_header_size, size);
        bytes = bytes.subspan(frame_header_size + size);
        return Framing::sound;
      }
    }
    if (!fill(bytes, frame_header_size)) return Framing::sound;
    const std::size_t size = frame_length(partial_);
    if (const Framing judged = judge(size, limit); judged != Framing::sound) return judged;
    if (!fill(bytes, frame_header_size + size)) return Framing::sound;
    complete_.swap(partial_);
    partial_.clear();
    payload = Bytes(complete_).subspan(frame_header_size);
    return Framing::sound;
  }
  std::size_t waiting_bytes() const { return partial_.size(); }
  std::size_t memory_bytes() const { return partial_.capacity() + complete_.capacity(); }

 private:
  static Framing judge(std::size_t size, std::size_t limit) {
    if (size == 0) return Framing::empty;
    return size > limit ? Framing::oversized : Framing::sound;
  }
  /// Moves bytes to `partial_` until it has `size`; true if it has.
  bool fill(Bytes& bytes, std::size_t size) {
    if (partial_.size() < size) {
      const Bytes taken = bytes.first(std::min(bytes.size(), size - partial_.size()));
      partial_.insert(partial_.end(), taken.begin(), taken.end());
      bytes = bytes.subspan(taken.size());
    }
    return partial_.size() >= size;
  }

  std::vector<std::byte> partial_, complete_;
};

}  // namespace rink::rti
