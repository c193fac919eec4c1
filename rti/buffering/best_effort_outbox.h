// A federate's own best-effort updates on their way to the RTI by datagram: what is sent, what is
// not acknowledged, and the newest value of each attribute in case it is lost.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/buffering/datagram_batch.h"
#include "rti/federation/datagram_channel.h"
#include "rti/objects/object_map.h"

namespace rink::rti {

/// Made when a datagram channel opens. It keeps the newest value of each best-effort attribute that
/// it sent, as long as this federate owns the object: a repair sends that, not what was lost.
class BestEffortOutbox {
 public:
  static constexpr std::size_t size_min = 256;  ///< a channel for smaller datagrams is not used
                                                ///< [bytes]

  explicit BestEffortOutbox(const Fom& fom);

  /// The most bytes that a datagram may have now; 0 while there is no channel.
  void set_size(std::size_t size_max) { size_max_ = size_max; }
  bool is_usable() const { return size_max_ >= size_min && !channel_.has_fallen_back; }
  AttributeSet best_effort(ObjectClassHandle object_class) const {
    assert(object_class.value < best_effort_.size());
    return best_effort_[object_class.value];
  }

  /// `coded` are the values of `set`, all of them best-effort. False if it does not fit a datagram:
  /// then the stream takes it.
  bool enqueue(ObjectHandle object, ObjectClassHandle object_class, AttributeSet set,
               const Stamp& stamp, Bytes coded);
  /// True if some have not been sealed: a frame that is written now counts as sent before them.
  bool is_pending() const { return !batch_.is_empty(); }
  /// Seals what is pending, as sent after `frames` frames.
  void seal(std::uint32_t frames, double now);

  /// The newest value of one attribute, coded, and its stamp.
  struct Value {
    Stamp stamp;
    std::vector<std::byte> coded;
  };
  struct Kept {
    std::uint16_t object_class = 0;
    AttributeSet attributes;
    std::vector<Value> values;  ///< by attribute
  };
  const Kept* find(ObjectHandle object) const { return kept_.find(object); }
  /// The objects with values kept here.
  std::vector<ObjectHandle> list() const;
  /// Forgets them: they are sent by the stream from now on, or not at all.
  void forget(ObjectHandle object, AttributeSet attributes);

  /// False if it acknowledges a datagram that was never sent. Opens a channel again that had fallen
  /// back to the stream.
  bool acknowledge(const AcknowledgeDatagramsMessage& message, double now);
  /// Notices datagrams that went unanswered for too long: then all that is unacknowledged becomes
  /// `due`, and a probe is sent now and then.
  void advance_clock(double now, std::uint32_t frames);
  /// The attributes that were lost and must be sent again with their present values. The caller
  /// takes them.
  std::vector<DatagramLedger::Lost>& due() { return channel_.due; }

  /// Sealed datagrams, valid until `clear`.
  std::span<const Datagram> datagrams();
  void clear();

  std::uint64_t sent = 0, fallbacks = 0, recoveries = 0;
  std::size_t memory_bytes() const { return kept_.memory_bytes() + bytes_.capacity(); }

 private:
  void begin() { batch_.begin(size_max_ - DatagramHead::size); }

  std::vector<AttributeSet> best_effort_;  ///< by class
  const Fom& fom_;
  DatagramBatch batch_;
  DatagramChannel channel_{batch_.lists()};
  std::size_t size_max_ = 0;
  ObjectMap<Kept> kept_;
  std::vector<std::byte> bytes_;   ///< of sealed datagrams
  std::vector<std::size_t> ends_;  ///< where each of them ends
  std::vector<Datagram> sealed_;
};

}  // namespace rink::rti
