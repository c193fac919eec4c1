// The messages that wait to be sent to the RTI by the stream: frames, and the blocks that still
// grow.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "rti/federate/join_phase.h"
#include "rti/types.h"
#include "rti/wire/frame.h"
#include "rti/wire/message.h"
#include "rti/wire/object_block.h"

namespace rink::rti {

/// The common header of the updates in one block.
struct UpdateHeader {
  ObjectClassHandle object_class;
  AttributeSet attributes;
  Stamp stamp;
  friend bool operator==(const UpdateHeader&, const UpdateHeader&) = default;
};

/// The only writer of a federate's stream.
class FrameOutbox {
 public:
  /// Must outlive it.
  explicit FrameOutbox(const JoinPhase& phase) : phase_(phase), frames_(frame_max_to_rti) {}

  /// Appends a message, which ends a growing block of updates. Throws FederateNotExecutionMember.
  template <class Message>
  void enqueue(Message message) {
    phase_.require_sending();
    append(message);
  }
  /// Appends a message in a frame of its own, of a form that hosts of every version read: a host
  /// routes a frame by its first message, and before a federate has joined it may only send short
  /// frames.
  template <class Message>
  void enqueue_alone(Message message) {
    frames_.open(FrameForm::older);
    append(message);
    frames_.close_frame();
  }
  /// Appends `object` to the block at the end if that has an equal header, else begins a block. The
  /// federate must be joined.
  template <class Header>
  void enqueue_in_block(Header header, ObjectHandle object) {
    assert(phase_.is_joined());
    const std::size_t size = measure(header) + object_record_max;
    if (!frames_.has_room(size)) object_block_.close();
    object_block_.append(frames_.begin_message(size), header, object.value);
    frames_.appended();
    has_open_updates_ = false;
  }
  /// `values` are coded, at most `values_max` bytes. True if the update began a block.
  bool enqueue_update(const UpdateHeader& header, ObjectHandle object, Bytes values);

  /// Messages that follow are in another frame and another block.
  void close_frame();
  /// `frames_since_join` counts the frames that follow.
  void count_from_here() { frames_to_join_ = frames_.frame_count(); }
  std::uint32_t frames_since_join() const {
    return static_cast<std::uint32_t>(frames_.frame_count() - frames_to_join_);
  }
  std::uint64_t frame_count() const { return frames_.frame_count(); }

  Bytes bytes() const { return frames_.bytes(); }
  bool is_empty() const { return frames_.bytes().empty(); }
  /// Clears what has been sent.
  void clear();
  std::size_t memory_bytes() const { return frames_.memory_bytes(); }

 private:
  template <class Message>
  void append(Message& message) {
    write(frames_.begin_message(measure(message)), message);
    frames_.appended();
    has_open_updates_ = false;
  }
  void begin_updates(const UpdateHeader& header);

  const JoinPhase& phase_;
  FrameWriter frames_;
  ObjectBlockWriter object_block_;  ///< the block of objects at the end, if any
  UpdateHeader open_;               ///< of the updates that still grow at the end
  bool has_open_updates_ = false;
  std::uint32_t last_object_ = 0;     ///< in that block
  Stamp stamp_;                       ///< the last one sent
  std::uint64_t stamped_frame_ = 0;   ///< the frame that it is in: a stamp holds for its frame
  std::uint64_t frames_to_join_ = 0;  ///< frames up to the one that asks to join
};

}  // namespace rink::rti
