// The rates at which a server's clients are told, all less often by one factor under overload.
#pragma once

#include <cstdint>

#include "game/net/server/server.h"
#include "rti/federation_execution.h"
#include "rti/update_rate.h"

namespace rink::game {

class OutputRates {
 public:
  /// `asked` for is the rate of federates that join.
  explicit OutputRates(rti::UpdateRate asked) : asked_(asked) {}

  /// From now on every player's client is sent one of `divisor` updates of the rate that was asked
  /// for; `divisor` is at least 1 (asserted). Clients that come later follow by `add_newcomers`. A
  /// client is sent what it has missed when its rate changes.
  void set_divisor(const Server& server, rti::FederationExecution& federation,
                   std::uint32_t divisor);
  /// After each tick: clients that were given a bat in it.
  void add_newcomers(const Server& server, rti::FederationExecution& federation) const;

  std::uint32_t divisor() const { return divisor_; }
  /// The rate of all now.
  rti::UpdateRate rate() const { return {asked_.turns, asked_.matches * divisor_}; }

 private:
  rti::UpdateRate asked_;
  std::uint32_t divisor_ = 1;
};

}  // namespace rink::game
