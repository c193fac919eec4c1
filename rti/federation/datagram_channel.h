// One federate's channel for best-effort updates beside its stream.
#pragma once

#include <optional>
#include <vector>

#include "rti/buffering/datagram_ledger.h"

namespace rink::rti {

struct DatagramChannel {
  static constexpr double fallback_after_s =
      2.0;  ///< without an answer, everything is sent by the stream again [s]
  static constexpr double probe_period_s =
      1.0;  ///< period of the empty datagrams that then probe the channel [s]
  explicit DatagramChannel(SentRecordPool& lists) : ledger(lists) {}

  DatagramLedger ledger;
  std::vector<DatagramLedger::Lost> due;  ///< to be sent again with its present value
  bool has_fallen_back = false;
  double probed_s = 0.0;
};

}  // namespace rink::rti
