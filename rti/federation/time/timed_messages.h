// Messages in time-stamp order that a federation keeps until nobody can ask for them any more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/federation_settings.h"
#include "rti/types.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// What a federate sent in time-stamp order, and who is to have it.
struct StampedMessage {
  struct Receiver {
    FederateHandle federate;
    AttributeSet attributes;  ///< of an update: what of it
    bool is_waiting = false;  ///< in the receiver's queue
    bool has_it = false;      ///< it was sent on
  };
  MessageKind kind = MessageKind::interaction;
  FederateHandle sender;
  std::uint64_t number = 0;
  Stamp stamp;
  std::uint32_t object = 0;  ///< of an update or deletion
  std::uint16_t class_number = 0;
  FederateHandle only;  ///< of an interaction: the only receiver, if any
  AttributeSet attributes;
  std::vector<std::byte> body;  ///< of an update its coded values, of an interaction its parameters
  std::vector<Receiver> receivers;
  std::size_t waiting = 0;  ///< receivers in whose queue it is
  bool is_distributed = false, is_retractable = false, is_retracted = false;
};

/// A message that says nothing yet, in the memory of an old one.
void clear(StampedMessage& message);

/// A message stays while its sender can take it back, while it is not distributed, and while it
/// waits for a receiver. Its index is valid until then, and its memory is used again.
class TimedMessages {
 public:
  explicit TimedMessages(const FederationSettings& settings) : settings_(settings) {}

  void joined(std::uint32_t slot);
  /// The federate is gone: what it sent stays, and can't be taken back any more.
  void left(std::uint32_t slot);

  bool is_full() const;
  /// A sender counts its messages upwards.
  bool may_be_next(std::uint32_t slot, std::uint64_t number) const;
  /// Takes in `message`, which may be next, and leaves an empty one there. Returns its index.
  std::uint32_t add(std::uint32_t slot, StampedMessage& message);
  /// True if enough has come from there for forget_final() to be worth its time.
  bool is_forgetting_due(std::uint32_t slot) const;
  /// Drops what `slot` can't take back any more: its time stamp lies before `earliest`, the least
  /// that it could still use.
  void forget_final(std::uint32_t slot, double earliest);
  /// What a federate can still take back is there by its own doing: it sends more than it lets time
  /// pass.
  bool is_greedy(std::uint32_t slot) const;
  /// The sender takes it back, and nothing waits for it any more; finish() follows. Nothing if it
  /// was taken back before, or its time stamp lies before `earliest`.
  std::optional<std::uint32_t> retract(std::uint32_t slot, std::uint64_t number, double earliest);

  void add_receiver(std::uint32_t index, FederateHandle federate, AttributeSet attributes);
  void enqueued(std::uint32_t index, std::uint32_t place);
  /// True if it was the last for which the message waited.
  bool dequeued(std::uint32_t index, std::uint32_t place);
  void sent(std::uint32_t index, std::uint32_t place);
  /// From the queues of all.
  void withdrawn(std::uint32_t index);
  void distributed(std::uint32_t index);
  /// Frees the message's place once nobody can ask for it.
  void finish(std::uint32_t index);

  const StampedMessage& operator[](std::uint32_t index) const;
  /// Places that are free hold messages without receivers, which nobody can take back.
  const std::vector<StampedMessage>& all() const { return messages_; }

 private:
  /// What a federate has sent and may still take back, by its count.
  struct Sent {
    std::uint64_t number = 0;
    std::uint32_t message = 0;
  };
  struct Sender {
    std::uint64_t next_number = 0;
    std::vector<Sent> sent;
    std::size_t bytes = 0;  ///< of what is in `sent`
    std::size_t compact_at = 64, compact_bytes_at = 1u << 20;
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
