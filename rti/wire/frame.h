// Frames: messages gathered under one length, cut and joined again from a stream of bytes.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "rti/wire/bytes.h"

namespace rink::rti {

inline constexpr std::size_t frame_max_to_rti =
    64 * 1024;  ///< longest payload that a joined federate may send [bytes]
inline constexpr std::size_t frame_max_to_join = 1024;  ///< and one that has not joined
inline constexpr std::size_t frame_max_to_federate = 64u
                                                     << 20;  ///< longest payload that the RTI sends

/// How a frame's head has the length of its payload (docs/wire.md).
enum class FrameForm : std::uint8_t {
  present,
  older,  ///< as in every version of the protocol: so that one that refuses it can read it
};
inline constexpr std::size_t frame_head_max = 4;        ///< [bytes]
inline constexpr std::size_t short_frame_max = 0x7fff;  ///< longest payload after a head of 2
inline constexpr std::size_t frame_max = 0x7fff'ffff;   ///< and at all
inline constexpr std::size_t older_frame_max = 0xffff;  ///< in the older form that is read

constexpr std::size_t frame_head_size(std::size_t length, FrameForm form = FrameForm::present) {
  return form == FrameForm::present && length <= short_frame_max ? 2 : frame_head_max;
}

/// Writes `frame_head_size(length, form)` bytes.
inline void write_frame_head(std::byte* at, std::size_t length,
                             FrameForm form = FrameForm::present) {
  assert(0 < length && length <= (form == FrameForm::older ? older_frame_max : frame_max));
  std::uint64_t head = length;
  if (form == FrameForm::present && length > short_frame_max)
    head = (length & short_frame_max) | (short_frame_max + 1) | length >> 15 << 16;
  const auto word = static_cast<std::uint32_t>(head);
  std::memcpy(at, &word, frame_head_size(length, form));
}

struct FrameHead {
  std::size_t size = 0;    ///< of the head
  std::size_t length = 0;  ///< of the payload
  FrameForm form = FrameForm::present;
};

/// Of the frame that begins with `bytes`; nothing if these are too few to tell. The older form has
/// two zeros where the present one has a long frame's upper bits, which are not all zero, or a kind
/// of message: none of the RTI is 0, and the peers' first kind, 0, is not followed by a zero.
inline std::optional<FrameHead> read_frame_head(Bytes bytes) {
  const auto number_at = [bytes](std::size_t at) {
    return std::to_integer<std::size_t>(bytes[at]) | std::to_integer<std::size_t>(bytes[at + 1])
                                                         << 8;
  };
  if (bytes.size() < 2) return std::nullopt;
  const std::size_t low = number_at(0);
  const bool is_short = low <= short_frame_max;
  if (low == 0) return FrameHead{2, 0, FrameForm::present};
  if (is_short && bytes.size() > 2 && bytes[2] != std::byte{0})
    return FrameHead{2, low, FrameForm::present};
  if (bytes.size() < frame_head_max) return std::nullopt;
  const std::size_t high = number_at(2);
  if (high == 0) return FrameHead{4, low, FrameForm::older};
  // One zero and no more is no message: the byte after it would be another frame's.
  if (is_short) return FrameHead{2, low == 1 ? 0 : low, FrameForm::present};
  return FrameHead{4, (low & short_frame_max) | high << 15, FrameForm::present};
}

/// Collects messages in frames; a frame is closed when the next message would not fit.
class FrameWriter {
 public:
  explicit FrameWriter(std::size_t payload_max, FrameForm form = FrameForm::present)
      : payload_max_(payload_max), form_(form) {
    assert(0 < payload_max && payload_max <= frame_max);  // a head has room for that
  }

  /// Where to append one message of `size` bytes. Call `appended` when it is written.
  std::vector<std::byte>& begin_message(std::size_t size) {
    if (!is_open_ || payload_size() + size > payload_max_) open(form_);
    return bytes_;
  }
  /// True if the frame at the end takes `size` more bytes.
  bool has_room(std::size_t size) const {
    return is_open_ && payload_size() + size <= payload_max_;
  }
  bool is_open() const { return is_open_; }
  std::vector<std::byte>& buffer() { return bytes_; }
  /// Begins a frame of another form than the others.
  void open(FrameForm form) {
    start_ = bytes_.size();
    head_size_ = frame_head_size(0, form);
    bytes_.resize(start_ + head_size_);
    is_open_ = true;
    open_form_ = form;
    ++frame_count_;
  }
  /// The frame's length becomes true again.
  void appended() {
    assert(is_open_ && payload_size() > 0);  // a frame without a message ends a conversation
    const std::size_t length = payload_size(), size = frame_head_size(length, open_form_);
    if (size > head_size_) {
      bytes_.insert(bytes_.begin() + static_cast<std::ptrdiff_t>(start_), size - head_size_, {});
      head_size_ = size;
    }
    write_frame_head(bytes_.data() + start_, length, open_form_);
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
  std::size_t payload_size() const { return bytes_.size() - start_ - head_size_; }

  std::vector<std::byte> bytes_;
  std::size_t payload_max_;
  FrameForm form_, open_form_ = FrameForm::present;
  std::size_t start_ = 0, head_size_ = 0;  ///< of the frame at the end
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
    if (partial_.empty()) {
      const std::optional<FrameHead> head = read_frame_head(bytes);
      if (head) {
        if (const Framing judged = judge(*head, limit); judged != Framing::sound) return judged;
        if (bytes.size() >= head->size + head->length) {
          payload = bytes.subspan(head->size, head->length);
          bytes = bytes.subspan(head->size + head->length);
          form_ = head->form;
          return Framing::sound;
        }
      }
    }
    std::optional<FrameHead> head;
    while (!(head = read_frame_head(partial_)))
      if (!fill(bytes, partial_.size() + 1)) return Framing::sound;
    if (const Framing judged = judge(*head, limit); judged != Framing::sound) return judged;
    if (!fill(bytes, head->size + head->length)) return Framing::sound;
    complete_.swap(partial_);
    partial_.clear();
    payload = Bytes(complete_).subspan(head->size);
    form_ = head->form;
    return Framing::sound;
  }
  /// Of the frame that was given last.
  FrameForm form() const { return form_; }
  std::size_t waiting_bytes() const { return partial_.size(); }
  std::size_t memory_bytes() const { return partial_.capacity() + complete_.capacity(); }

 private:
  static Framing judge(const FrameHead& head, std::size_t limit) {
    if (head.length == 0) return Framing::empty;
    return head.length > limit ? Framing::oversized : Framing::sound;
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
  FrameForm form_ = FrameForm::present;
};

}  // namespace rink::rti
