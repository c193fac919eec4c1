// The frame that one flush sends to one federate: its own bytes, and parts that federates share.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "rti/types.h"
#include "rti/wire/frame.h"
#include "rti/wire/message.h"
#include "rti/wire/stamp_steps.h"

namespace rink::rti {

/// The frame grows at its end. A part that many federates receive is not copied but sent from its
/// place. The next frame uses the memory again.
class GatheredFrame {
 public:
  /// `steps` are those of the federate that the frame is for.
  void begin(StampSteps& steps) {
    steps_ = &steps;
    bytes_.resize(frame_head_max);
    taken_ = shared_size_ = 0;
    stamp_.reset();
    is_keyframe_begun_ = false;
    pieces_.clear();
  }
  /// The size with room for the longest head.
  std::size_t size() const { return bytes_.size() + shared_size_; }
  bool is_empty() const { return size() == frame_head_max; }
  std::size_t payload_size() const { return size() - frame_head_max; }
  /// With the head that it is sent with.
  std::size_t sent_size() const { return frame_head_size(payload_size()) + payload_size(); }
  /// The bytes, for writers that append.
  std::vector<std::byte>& bytes() { return bytes_; }
  void append(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  template <class Message>
  void enqueue(Message message) {
    write(bytes_, message);
  }
  /// Writes the stamp of the updates that follow if it differs from the one before.
  void write_stamp(const Stamp& stamp) {
    if (stamp_ == stamp) return;
    std::optional<StampStepMessage> step = steps_to(*steps_, stamp);
    if (!step && !stamp_) step = step_to(*steps_, stamp);
    if (!step) return enqueue_whole(stamp);
    stamp_ = stamp;
    is_stamp_whole_ = false;
    Stamp reached;
    [[maybe_unused]] const bool is_reached = follow(*steps_, *step, reached);
    assert(is_reached && reached == stamp);
    enqueue(*step);
  }
  /// The same for updates that are read even if frames before this one were not: a step from a
  /// stamp that the federate never heard would lead to another time.
  void write_whole_stamp(const Stamp& stamp) {
    if (stamp_ != stamp || !is_stamp_whole_) enqueue_whole(stamp);
  }
  bool is_stamped(const Stamp& stamp) const { return stamp_ == stamp; }
  /// True for the first call in a frame: the message that begins a keyframe is written once.
  bool begins_keyframe() { return !std::exchange(is_keyframe_begun_, true); }
  /// `bytes` must stay where they are until the frame was sent.
  void add_shared(Bytes bytes) {
    // A short block is cheaper copied than gathered, and a write takes only so many parts.
    constexpr std::size_t copied_max = 512, piece_max = 64;
    if (bytes.size() <= copied_max || pieces_.size() >= piece_max) return append(bytes);
    take_own();
    pieces_.push_back({bytes, 0, 0});
    shared_size_ += bytes.size();
  }
  /// Writes the head, which only now has a size: it stands right before the payload. The parts are
  /// valid until the frame is changed.
  std::span<const Bytes> finish() {
    assert(payload_size() <= frame_max_to_federate);
    const std::size_t head = frame_head_max - frame_head_size(payload_size());
    write_frame_head(bytes_.data() + head, payload_size());
    take_own();
    pieces_.front().from = head;
    gathered_.clear();
    for (const Piece& piece : pieces_)
      gathered_.push_back(piece.shared.empty()
                              ? Bytes(bytes_).subspan(piece.from, piece.to - piece.from)
                              : piece.shared);
    return gathered_;
  }

 private:
  /// A stretch of `bytes_`, or a shared part.
  struct Piece {
    Bytes shared;
    std::size_t from = 0, to = 0;
  };
  void enqueue_whole(const Stamp& stamp) {
    stamp_ = stamp;
    is_stamp_whole_ = true;
    enqueue(StampMessage{stamp});
  }
  void take_own() {
    assert(taken_ <= bytes_.size());
    if (bytes_.size() > taken_) pieces_.push_back({{}, taken_, bytes_.size()});
    taken_ = bytes_.size();
  }

  std::vector<std::byte> bytes_;
  std::size_t taken_ = 0;  ///< up to here `bytes_` is in `pieces_`
  std::size_t shared_size_ = 0;
  std::optional<Stamp> stamp_;  ///< once it was written
  bool is_stamp_whole_ = false;
  StampSteps* steps_ = nullptr;
  bool is_keyframe_begun_ = false;
  std::vector<Piece> pieces_;
  std::vector<Bytes> gathered_;
};

}  // namespace rink::rti
