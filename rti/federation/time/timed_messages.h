// Messages in time-stamp order, kept until nothing needs them any more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/federation_settings.h"
#include "rti/types.h"
#include "rti/wire/message.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// A message that a federate sent in time-stamp order, and its receivers.
struct StampedMessage {
  struct Receiver {
    FederateHandle federate;
    AttributeSet attributes;  ///< of an update: the receiver's part
    bool is_waiting = false;  ///< in the receiver's queue
    bool has_it = false;      ///< it was sent on
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, federate, attributes, is_waiting, has_it);
    }
  };
  MessageKind kind = MessageKind::interaction;
  FederateHandle sender;
  std::uint64_t number = 0;
  Stamp stamp;
  std::uint32_t object = 0;  ///< of an update or deletion
  std::uint16_t class_number = 0;
  FederateHandle only;  ///< of an interaction: the only receiver, if any
  AttributeSet attributes;
  std::vector<std::byte> body;  ///< the coded values of an update, the parameters of an interaction
  std::vector<Receiver> receivers;
  std::size_t waiting = 0;  ///< receivers in whose queue it is
  bool is_distributed = false, is_retractable = false, is_retracted = false;

  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, kind, sender, number, stamp, object, class_number, only, attributes,
                    body, receivers, waiting, is_distributed, is_retractable, is_retracted);
  }
};

/// Empties a message for new content and keeps its memory.
void clear(StampedMessage& message);

/// A message stays while its sender can retract it, while it is not distributed, and while it waits
/// for a receiver. Its index is valid until then; its memory is used again.
class TimedMessages {
 public:
  explicit TimedMessages(const FederationSettings& settings) : settings_(settings) {}

  void joined(std::uint32_t slot);
  /// The federate has left: its messages stay, and cannot be retracted any more.
  void left(std::uint32_t slot);

  bool is_full() const;
  /// True if a sender's next message may have this number: senders count upwards.
  bool may_be_next(std::uint32_t slot, std::uint64_t number) const;
  /// Moves `message`, which may be next, out of its place and leaves an empty one there. Returns
  /// its index.
  std::uint32_t add(std::uint32_t slot, StampedMessage& message);
  /// True if enough messages of the sender are kept for forget_final() to be worth its time.
  bool is_forgetting_due(std::uint32_t slot) const;
  /// Drops messages that `slot` cannot retract any more: their time stamps are before `earliest`,
  /// the least that it could still use.
  void forget_final(std::uint32_t slot, double earliest);
  /// True if the federate has too many messages that it can still retract, since it sends faster
  /// than it lets time pass.
  bool is_greedy(std::uint32_t slot) const;
  /// The sender retracts a message, so that it waits for no receiver; finish() follows. Nothing if
  /// it was retracted before, or its time stamp is before `earliest`.
  std::optional<std::uint32_t> retract(std::uint32_t slot, std::uint64_t number, double earliest);

  void add_receiver(std::uint32_t index, FederateHandle federate, AttributeSet attributes);
  void enqueued(std::uint32_t index, std::uint32_t place);
  /// True if the message waited for no other receiver.
  bool dequeued(std::uint32_t index, std::uint32_t place);
  void sent(std::uint32_t index, std::uint32_t place);
  /// The message has left all queues.
  void withdrawn(std::uint32_t index);
  void distributed(std::uint32_t index);
  /// Frees the message's place once nothing needs it.
  void finish(std::uint32_t index);

  const StampedMessage& operator[](std::uint32_t index) const;
  /// All places; free ones hold messages without receivers that cannot be retracted.
  const std::vector<StampedMessage>& all() const { return messages_; }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, messages_, free_, bytes_, senders_);
  }

 private:
  /// A message that a federate has sent and may still retract, by its count.
  struct Sent {
    std::uint64_t number = 0;
    std::uint32_t message = 0;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, number, message);
    }
  };
  struct Sender {
    std::uint64_t next_number = 0;
    std::vector<Sent> sent;
    std::size_t bytes = 0;  ///< of the messages in `sent`
    std::size_t compact_at = 64, compact_bytes_at = 1u << 20;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, next_number, sent, bytes, compact_at, compact_bytes_at);
    }
  };
  std::uint32_t take_place();
  void release(std::uint32_t index);

  const FederationSettings& settings_;
  std::vector<StampedMessage> messages_;
  std::vector<std::uint32_t> free_;
  std::size_t bytes_ = 0;        ///< of the messages' bodies
  std::vector<Sender> senders_;  ///< by slot
};

}  // namespace rink::rti
