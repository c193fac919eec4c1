// Measurements under the names of the report.
#include "loadgen/run/bots/bots_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "game/model/report_fields.h"
#include "game/model/report_schema.h"

namespace rink::loadgen {

using Json = nlohmann::ordered_json;

Json bots_report(const BotCrowd& crowd, const std::string& why_invalid) {
  const Crowd& bots = crowd.bots();
  const Meter& meter = crowd.meter();
  const Measurements& measured = meter.measurements();
  const CrowdTraffic traffic = meter.traffic(), total = bots.traffic();
  return {{"schema", game::report_schema},
          {game::report::clients, bots.size()},
          {game::report::measured_s, meter.measured_s()},
          {game::report::bytes_received, traffic.bytes_received},
          {game::report::bytes_sent, traffic.bytes_sent},
          {game::report::segments_sent, traffic.segments_sent},
          {game::report::acknowledgements_sent, traffic.acknowledgements_sent},
          {game::report::kernel_segments_sent, traffic.kernel_segments_sent},
          {"updates_received", traffic.updates_received},
          {game::report::update_age_ms, measured.update_latency.to_json()},
          {game::report::key_to_effect_ms, measured.input_latency.to_json()},
          {game::report::keys_due, measured.keys_due},
          {game::report::keys_sent, measured.keys_sent},
          {game::report::keys_unanswered, bots.unanswered_keys()},
          {game::report::late_sends_fraction,
           static_cast<double>(measured.late_sends) /
               std::max<double>(1.0, static_cast<double>(measured.keys_sent))},
          {game::report::send_lateness_ms, measured.send_lateness.to_json()},
          {game::report::schedule_trouble, measured.schedule_trouble()},
          {game::report::federates_lost, bots.lost_count()},
          {game::report::bytes_received_by_bot, meter.received_by_bot()},
          {"memory_bytes_per_client", bots.memory_bytes() / std::max<std::size_t>(1, bots.size())},
          {game::report::evidence_bytes, crowd.evidence_bytes()},
          {game::report::total_bytes_received, total.bytes_received},
          {game::report::total_bytes_sent, total.bytes_sent},
          {game::report::kernel_bytes_received, total.kernel_bytes_received},
          {game::report::kernel_bytes_sent, total.kernel_bytes_sent},
          {game::report::valid, why_invalid.empty()},
          {game::report::why_invalid, why_invalid}};
}

}  // namespace rink::loadgen
