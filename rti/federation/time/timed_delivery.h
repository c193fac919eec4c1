// Messages in time-stamp order on their way to their receivers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "rti/baselines/residual_states.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/announcements.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/interactions.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/object_service.h"
#include "rti/federation/time/timed_messages.h"
#include "rti/time/time_management.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Finds each message's receivers, sends it to them when their time has come, and stores the state
/// that it leaves behind.
class TimedDelivery {
 public:
  struct Uses {
    DataDistribution& distribution;
    Interactions& interactions;
    ObjectService& objects;
    NewestStamps& newest;
    Announcements& announcements;
    ResidualStates& residuals;
  };
  TimedDelivery(const FederationBasis& basis, TimedMessages& messages, const Uses& uses)
      : basis_(basis), messages_(messages), uses_(uses) {}

  /// Adds the message to those that `distribute` takes.
  void accept(std::uint32_t index);
  /// Distributes accepted messages: to the queues of constrained receivers, to the others at once.
  void distribute(TimeManagement& management);
  /// Sends the message to a receiver whose time has come.
  void deliver(std::uint32_t slot, const TimedEntry& entry, bool is_in_order);
  /// Drops the entry of a receiver that has left.
  void discard(const TimedEntry& entry);
  /// Removes a retracted message from all queues, and asks receivers that have it to take it back.
  void withdraw(std::uint32_t index, TimeManagement& management);
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, arrived_, stored_until_);
  }

 private:
  void distribute(std::uint32_t index, TimeManagement& management);
  void find_receivers(std::uint32_t index);
  void find_listeners(std::uint32_t index);
  void find_reflectors(std::uint32_t index, ObjectSlot object);
  void add_receiver(std::uint32_t index, std::uint32_t slot, AttributeSet attributes);
  bool prepare(std::uint32_t slot, const StampedMessage& message);
  bool send(std::uint32_t slot, const StampedMessage& message, AttributeSet attributes,
            bool is_in_order);
  void write_content(const StampedMessage& message, AttributeSet attributes);
  void write_update(const StampedMessage& message, AttributeSet attributes);
  void complete(const StampedMessage& message);
  bool is_news(const StampedMessage& message);

  FederationBasis basis_;
  TimedMessages& messages_;
  Uses uses_;
  std::vector<std::uint32_t> arrived_;  ///< messages to distribute
  std::vector<std::byte> content_;      ///< of the message that is being sent
  std::unordered_map<std::uint32_t, double>
      stored_until_;  ///< by object: time stamp of the latest update in its stored state
};

}  // namespace rink::rti
