// Messages in time-stamp order and the advance of logical time (IEEE 1516.1-2010, clause 8).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/announcements.h"
#include "rti/federation/expulsion.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/outcome.h"
#include "rti/federation/services/interactions.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/object_service.h"
#include "rti/federation/services/publications.h"
#include "rti/ownership/ownership.h"
#include "rti/time/time_management.h"
#include "rti/wire/time_messages.h"

namespace rink::rti {

/// Checks what federates ask and send in time-stamp order, keeps each message until the last
/// constrained receiver's time has come, and tells what the time management decides. Nothing is
/// kept, and nothing done, before the first message of that kind.
class TimeService final : private TimeListener {
 public:
  using Maker = std::function<std::unique_ptr<TimeManagement>()>;
  struct Uses {
    const Publications& publications;
    const Ownership& ownership;
    KnownObjects& known;
    DataDistribution& distribution;
    Interactions& interactions;
    ObjectService& objects;
    NewestStamps& newest;
    Announcements& announcements;
  };
  /// `make` may be empty: then time is conservative.
  TimeService(const FederationBasis& basis, const Uses& uses, Maker make, Expulsion expel)
      : basis_(basis), uses_(uses), make_(std::move(make)), expel_(std::move(expel)) {}

  Outcome handle_regulation(std::uint32_t slot, Reader& reader);
  Outcome handle_lookahead(std::uint32_t slot, Reader& reader);
  Outcome handle_switch(std::uint32_t slot, Reader& reader);
  Outcome handle_advance(std::uint32_t slot, Reader& reader);
  Outcome handle_send(std::uint32_t slot, Reader& reader);
  Outcome handle_retract(std::uint32_t slot, Reader& reader);
  Outcome handle_query(std::uint32_t slot);
  /// Gives what was sent since the last time to its receivers, then tells grants. Once per flush,
  /// after the match.
  void settle();
  void joined(std::uint32_t slot);
  /// The federate is gone; its messages stay.
  void left(std::uint32_t slot);

  /// Null until somebody asked for it.
  const TimeManagement* management() const { return management_.get(); }
  /// As it last asked for [s].
  double lookahead(std::uint32_t slot) const { return federates_[slot].lookahead; }
  bool is_advancing(std::uint32_t slot) const { return federates_[slot].is_advancing; }

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
    double lookahead = 0.0;
    bool is_advancing = false;  ///< in logical time
  };

  TimeManagement& begin(std::uint32_t slot);
  Outcome read_content(std::uint32_t slot, Bytes content, Message& message);
  Outcome read_update(std::uint32_t slot, Reader& content, Message& message);
  Outcome read_interaction(std::uint32_t slot, Reader& content, Message& message);
  Outcome read_deletion(std::uint32_t slot, Reader& content, Message& message);
  void withdraw(std::uint32_t index);
  bool is_full() const;
  void make_room(std::uint32_t speaker);
  std::uint32_t find_culprit() const;
  std::uint32_t find_last_regulating() const;
  bool is_greedy(const Sender& sender) const;
  std::uint32_t take_place();
  Outcome keep(std::uint32_t slot, std::uint32_t index);
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

  void deliver(std::uint32_t federate, const TimedEntry& entry) override;
  void discard(std::uint32_t federate, const TimedEntry& entry) override;
  void regulation_enabled(std::uint32_t federate, double time, double earliest) override;
  void constrained_enabled(std::uint32_t federate, double time) override;
  void grant(std::uint32_t federate, double time) override;

  FederationBasis basis_;
  Uses uses_;
  Maker make_;
  Expulsion expel_;
  std::unique_ptr<TimeManagement> management_;
  std::vector<Message> messages_;
  std::vector<std::uint32_t> free_;
  std::size_t bytes_ = 0;               ///< of the messages' bodies
  std::vector<Sender> federates_;       ///< by slot
  std::vector<std::uint32_t> arrived_;  ///< messages to distribute
  std::vector<std::uint32_t> asking_;   ///< slots that asked for their bounds
  std::vector<std::byte> content_;
  std::unordered_map<std::uint32_t, double>
      told_until_;  ///< by object: time stamp of the latest update that is its state for newcomers
};

}  // namespace rink::rti
