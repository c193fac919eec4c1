// The same work by Rink's own API over TCP.
#pragma once

#include "bench/standard/work.h"
#include "rti/fom/fom.h"

namespace rink_driver {

struct OwnPlace {
  const rink::rti::Fom& model;
  unsigned short port;
};

Outcome own_updates(const OwnPlace& place, int subscribers, std::uint64_t rounds);
Outcome own_round_trips(const OwnPlace& place, std::uint64_t count);
Outcome own_advances(const OwnPlace& place, int federates, std::uint64_t steps);
Outcome own_joins(const OwnPlace& place, std::uint64_t count);
Outcome own_late_joiners(const OwnPlace& place, std::uint64_t joiners);

}  // namespace rink_driver
