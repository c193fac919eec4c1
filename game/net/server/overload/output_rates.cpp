// Changes the rate of all clients at once, so that none is updated less often than another.
#include "game/net/server/overload/output_rates.h"

#include <cassert>

namespace rink::game {

void OutputRates::set_divisor(const Server& server, rti::FederationExecution& federation,
                              std::uint32_t divisor) {
  assert(divisor >= 1);
  divisor_ = divisor;
  server.seats().for_each([&](rti::FederateHandle federate, const Seats::Seat&) {
    federation.set_update_rate(federate, rate());
  });
}

void OutputRates::add_newcomers(const Server& server, rti::FederationExecution& federation) const {
  if (divisor_ == 1) return;
  for (const auto& [federate, player] : server.seats().offered())
    federation.set_update_rate(federate, rate());
}

}  // namespace rink::game
