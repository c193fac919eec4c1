// The server's counts under the names of reports.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "game/model/report_fields.h"
#include "game/model/report_schema.h"
#include "im/basics/hexadecimal.h"
#include "loadgen/dds/dds_reports.h"
#include "loadgen/dds/dds_server.h"

namespace rink::loadgen {

namespace report = game::report;

nlohmann::ordered_json DdsServer::report(const std::string& why_invalid) const {
  const double ticks = std::max<double>(1.0, static_cast<double>(costs_.ticks));
  const auto us = [&](double seconds) { return 1e6 * seconds / ticks; };
  const RtpsTraffic sent = costs_.end.sent - costs_.begin.sent,
                    received = costs_.end.received - costs_.begin.received;
  nlohmann::ordered_json written{
      {"schema", game::report_schema},
      {report::mode, "dds"},
      {report::scheme, options_.scheme},
      {report::policy, "periodic"},
      {"domain", domain_.number()},
      {"partitions", grid_.size()},
      {report::clients, options_.clients},
      {report::seed, options_.seed},
      {report::tick_rate_hz, options_.rate_hz},
      {report::entities, game_.entities().size()},
      {report::ticks, costs_.ticks},
      {report::ticks_on_time_fraction,
       static_cast<double>(costs_.on_time) / (ticks + static_cast<double>(costs_.left_out))},
      {"ticks_left_out", costs_.left_out},
      {report::physics_us_per_tick, us(costs_.physics_s)},
      {report::filter_us_per_tick, us(costs_.filter_s)},
      {report::send_us_per_tick, us(costs_.send_s)},
      {report::server_rss_bytes, resident_memory()},
      {report::state_hash, hexadecimal(game_.hash())},
      {report::measured_s, costs_.span_s},
      {report::messages_sent, sent.samples},
      {report::writes_sent, sent.messages},
      {"writes_received", received.messages},
      {report::state_bytes_sent, sent.data_bytes},
      {report::key_bytes_received, received.data_bytes},
      {report::lost_federates, lost_},
      {report::dropped_connections, 0},
      {"keys_received", keys_},
      {"cell_crossings", costs_.end.crossings - costs_.begin.crossings},
      {"gathering_s", gathering_s_},
      {"gathering_bytes", gathering_.bytes},
      {"gathering_discovery_bytes", gathering_.discovery_bytes},
      {"discovery_bytes", sent.discovery_bytes + received.discovery_bytes},
      {"loopback_bytes", costs_.end.loopback - costs_.begin.loopback},
      {report::valid, why_invalid.empty()},
      {report::why_invalid, why_invalid}};
  written.update(traffic_report(sent, received, sent_so_far(), received_so_far()));
  return written;
}

}  // namespace rink::loadgen
