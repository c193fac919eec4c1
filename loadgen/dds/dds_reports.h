// The part of a report that server and bots share: what their process sent and received.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "loadgen/dds/rtps_traffic.h"

namespace rink::loadgen {

/// `sent` and `received` within the measured span, the others from start to end. The kernel counts
/// no bytes of a datagram socket, so its fields are null.
nlohmann::ordered_json traffic_report(const RtpsTraffic& sent, const RtpsTraffic& received,
                                      const RtpsTraffic& all_sent, const RtpsTraffic& all_received);

/// Of this process [bytes].
std::uint64_t resident_memory();

}  // namespace rink::loadgen
