// What a federation execution keeps of time management, once somebody asked for it; for its own
// sources only.
#pragma once

#include <unordered_map>

#include "rti/federation/federation_parts.h"
#include "rti/wire/time_messages.h"

namespace rink::rti {

/// Checks what federates ask and send in time-stamp order, keeps each message until the last
/// constrained receiver's time has come, and tells what the time management decides.
class FederationParts::Time final : public TimeListener {
 public:
  Time(FederationParts& parts, std::unique_ptr<TimeManagement> management)
      : parts_(parts), management_(std::move(management)) {}

  Outcome take(std::uint32_t slot, MessageKind kind, Reader& reader);
  /// Gives what was sent since the last time to its receivers, then tells grants. Once per flush,
  /// after the match.
  void settle();
  /// The federate is gone; its messages stay.
  void leave(std::uint32_t slot);
  const TimeManagement& management() const { return *management_; }

 private:
  /// A message in time-stamp order. Its memory is used again.
  struct Message {
    struct Receiver {
      FederateHandle federate;
      AttributeSet told;        ///< of an update: what of it
      bool is_waiting = false;  ///< in the receiver's queue
      bool has_it = false;      ///< it was told
    };
    MessageKind kind = MessageKind::interaction;
    FederateHandle sender;
    std::uint64_t number = 0;
    Stamp stamp;
    std::uint32_t object = 0;  ///< of an update or deletion
    std::uint16_t class_number = 0;
    FederateHandle only;  ///< of an interaction: the only receiver, if any
    AttributeSet attributes;
    std::vector<std::byte>
        body;  ///< of an update its coded values, of an interaction its parameters
    std::vector<Receiver> receivers;
    std::size_t waiting = 0;  ///< receivers in whose queue it is
    bool is_distributed = false, is_retractable = false, is_retracted = false;
  };
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

  Outcome take_switch(std::uint32_t slot, Reader& reader);
  Outcome take_message(std::uint32_t slot, Reader& reader);
  Outcome read_content(std::uint32_t slot, Bytes content, Message& message);
  Outcome read_update(std::uint32_t slot, Reader& content, Message& message);
  Outcome read_interaction(std::uint32_t slot, Reader& content, Message& message);
  Outcome read_deletion(std::uint32_t slot, Reader& content, Message& message);
  Outcome retract(std::uint32_t slot, Reader& reader);
  bool is_full() const;
  void make_room(std::uint32_t speaker);
  std::uint32_t find_culprit() const;
  bool is_greedy(const Sender& sender) const;
  std::uint32_t take_place();
  Sender& sender(std::uint32_t slot);
  void forget_final(std::uint32_t slot);

  void distribute(std::uint32_t index);
  void find_receivers(Message& message);
  void give(std::uint32_t index);
  bool tell(std::uint32_t slot, const Message& message, AttributeSet told, bool is_in_order);
  void write_content(const Message& message, AttributeSet told);
  void finish(std::uint32_t index);
  void complete(const Message& message);
  bool is_news(const Message& message);
  void release(std::uint32_t index);
  bool is_here(FederateHandle federate) const;

  void deliver(std::uint32_t federate, const TimedEntry& entry) override;
  void discard(std::uint32_t federate, const TimedEntry& entry) override;
  void regulation_enabled(std::uint32_t federate, double time, double earliest) override;
  void constrained_enabled(std::uint32_t federate, double time) override;
  void grant(std::uint32_t federate, double time) override;

  FederationParts& parts_;
  std::unique_ptr<TimeManagement> management_;
  std::vector<Message> messages_;
  std::vector<std::uint32_t> free_;
  std::size_t bytes_ = 0;               ///< of the messages' bodies
  std::vector<Sender> senders_;         ///< by slot
  std::vector<std::uint32_t> arrived_;  ///< messages to distribute
  std::vector<std::uint32_t> asking_;   ///< slots that asked for their bounds
  std::vector<std::byte> content_;
  std::unordered_map<std::uint32_t, double>
      told_until_;  ///< by object: time stamp of the latest update that is its state for newcomers
};

}  // namespace rink::rti
