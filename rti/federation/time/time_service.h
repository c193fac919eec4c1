// The advance of logical time and messages in time-stamp order (IEEE 1516.1-2010, clause 8).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "rti/federation/expulsion.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/status.h"
#include "rti/federation/time/timed_content.h"
#include "rti/federation/time/timed_delivery.h"
#include "rti/federation/time/timed_messages.h"
#include "rti/time/conservative_time.h"
#include "rti/time/time_management.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Passes federates' requests to the time management, and its decisions to federates. Costs nothing
/// before the first message of that kind.
class TimeService final : private TimeListener {
 public:
  using Maker = std::function<std::unique_ptr<TimeManagement>()>;
  struct Uses {
    const Publications& publications;
    const Ownership& ownership;
    KnownObjects& known;
    TimedDelivery::Uses delivery;
  };
  /// `make` may be empty: then time is conservative.
  TimeService(const FederationBasis& basis, const Uses& uses, Maker make, Expulsion expel)
      : basis_(basis),
        make_(std::move(make)),
        expel_(std::move(expel)),
        messages_(basis.settings),
        contents_(basis, uses.publications, uses.ownership, uses.known),
        delivery_(basis, messages_, uses.delivery) {}
  TimeService(const TimeService&) = delete;
  TimeService& operator=(const TimeService&) = delete;

  Status handle_regulation(std::uint32_t slot, Reader& reader);
  Status handle_lookahead(std::uint32_t slot, Reader& reader);
  Status handle_switch(std::uint32_t slot, Reader& reader);
  Status handle_advance(std::uint32_t slot, Reader& reader);
  Status handle_send(std::uint32_t slot, Reader& reader);
  Status handle_retract(std::uint32_t slot, Reader& reader);
  Status handle_query(std::uint32_t slot);
  /// Distributes messages that were sent since the last call, then sends grants. Called once per
  /// flush, after the match.
  void settle();
  void joined(std::uint32_t slot);
  /// The federate has left; its messages stay.
  void left(std::uint32_t slot);

  /// Null until a federate uses time management.
  const TimeManagement* management() const { return management_.get(); }
  /// The lookahead that the federate last asked for [s].
  double lookahead(std::uint32_t slot) const { return federates_[slot].lookahead; }
  bool is_advancing(std::uint32_t slot) const { return federates_[slot].is_advancing; }
  /// False if time is managed by another than the RTI's own part.
  template <class Stream>
  bool keep(Stream& stream) {
    bool is_used = management_ != nullptr;
    if (!stream.truth(is_used)) return false;
    if (Stream::is_reading && is_used)
      management_ = make_ ? make_() : std::make_unique<ConservativeTime>();
    auto* const own = dynamic_cast<ConservativeTime*>(management_.get());
    return is_used == (own != nullptr) && (!is_used || own->keep(stream)) &&
           keep_all(stream, federates_, messages_, delivery_, asking_);
  }

 private:
  struct Federate {
    double lookahead = 0.0;
    bool is_advancing = false;  ///< in logical time
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, lookahead, is_advancing);
    }
  };

  TimeManagement& begin(std::uint32_t slot);
  /// As the federate's message says, unless `set` finds it untimely.
  template <class Message>
  Status set_lookahead(std::uint32_t slot, Reader& reader,
                       bool (TimeManagement::*set)(std::uint32_t, double));
  Status keep(std::uint32_t slot);
  void make_room(std::uint32_t speaker);
  std::uint32_t find_culprit() const;
  std::uint32_t find_last_regulating() const;

  void deliver(std::uint32_t federate, const TimedEntry& entry) override;
  void discard(std::uint32_t federate, const TimedEntry& entry) override;
  void regulation_enabled(std::uint32_t federate, double time, double earliest) override;
  void constrained_enabled(std::uint32_t federate, double time) override;
  void grant(std::uint32_t federate, double time) override;

  FederationBasis basis_;
  Maker make_;
  Expulsion expel_;
  TimedMessages messages_;
  TimedContentReader contents_;
  TimedDelivery delivery_;
  std::unique_ptr<TimeManagement> management_;
  std::vector<Federate> federates_;    ///< by slot
  std::vector<std::uint32_t> asking_;  ///< slots that asked for their bounds
  StampedMessage incoming_;            ///< that is being read
};

}  // namespace rink::rti
