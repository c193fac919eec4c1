// Measurements under the names of the report.
#include "loadgen/run/bots/bots_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "game/model/report_schema.h"

namespace rink::loadgen {

using Json = nlohmann::ordered_json;

Json bots_report(const BotCrowd& crowd, const std::string& why_invalid) {
  const Measurements& measured = crowd.measurements();
  const CrowdTraffic traffic = crowd.traffic(), total = crowd.total_traffic();
  return {
      {"schema", game::report_schema},
      {"clients", crowd.bot_count()},
      {"measured_s", crowd.measured_s()},
      {"bytes_received", traffic.bytes_received},
      {"bytes_sent", traffic.bytes_sent},
      {"segments_sent", traffic.segments_sent},
      {"acknowledgements_sent", traffic.acknowledgements_sent},
      {"kernel_segments_sent", traffic.kernel_segments_sent},
      {"updates_received", traffic.updates_received},
      {"update_age_ms", measured.update_age.to_json()},
      {"key_to_effect_ms", measured.key_to_effect.to_json()},
      {"keys_due", measured.keys_due},
      {"keys_sent", measured.keys_sent},
      {"keys_unanswered", crowd.unanswered_keys()},
      {"late_sends_fraction", static_cast<double>(measured.late_sends) /
                                  std::max<double>(1.0, static_cast<double>(measured.keys_sent))},
      {"send_lateness_ms", measured.send_lateness.to_json()},
      {"schedule_trouble", measured.schedule_trouble()},
      {"federates_lost", crowd.lost_count()},
      {"bytes_received_by_bot", crowd.bytes_received_by_bot()},
      {"memory_bytes_per_client",
       crowd.client_memory_bytes() / std::max<std::size_t>(1, crowd.bot_count())},
      {"evidence_bytes", crowd.evidence_bytes()},
      {"total_bytes_received", total.bytes_received},
      {"total_bytes_sent", total.bytes_sent},
      {"kernel_bytes_received", total.kernel_bytes_received},
      {"kernel_bytes_sent", total.kernel_bytes_sent},
      {"valid", why_invalid.empty()},
      {"why_invalid", why_invalid}};
}

}  // namespace rink::loadgen
