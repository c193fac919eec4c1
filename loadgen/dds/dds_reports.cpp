// Datagrams stand where reports have segments; nothing acknowledges them below RTPS.
#include "loadgen/dds/dds_reports.h"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "game/model/report_fields.h"

namespace rink::loadgen {

namespace report = game::report;

nlohmann::ordered_json traffic_report(const RtpsTraffic& sent, const RtpsTraffic& received,
                                      const RtpsTraffic& all_sent,
                                      const RtpsTraffic& all_received) {
  return {{report::bytes_sent, sent.bytes},
          {report::bytes_received, received.bytes},
          {report::segments_sent, sent.packets},
          {report::acknowledgements_sent, 0},
          {report::header_bytes_sent, sent.headers},
          {report::kernel_segments_sent, nullptr},
          {report::total_bytes_sent, all_sent.bytes},
          {report::total_bytes_received, all_received.bytes},
          {report::kernel_bytes_sent, nullptr},
          {report::kernel_bytes_received, nullptr}};
}

std::uint64_t resident_memory() {
  std::ifstream counts("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  counts >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace rink::loadgen
