// Turns the two processes' reports into rates per client, and finds why a run does not count.
#include "loadgen/measure/judge_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "game/model/report_fields.h"
#include "loadgen/measure/truth/classification.h"

namespace rink::loadgen {
namespace {

namespace report = game::report;

constexpr double count_mismatch_max = 0.01;
constexpr double in_flight_bytes_max =
    128.0;  // per client: last bytes that the kernel has not seen acknowledged, which exceed 1 %
            // where nearly nothing is sent

/// Reads a report of another process: a missing value or one of another type is noted once and
/// reads as absent.
class ReportReader {
 public:
  /// `accepts_null`: null stands for a value that could not be measured, which is no error.
  ReportReader(const nlohmann::json& report, std::string who, bool accepts_null,
               std::vector<std::string>& complaints)
      : report_(report),
        who_(std::move(who)),
        accepts_null_(accepts_null),
        complaints_(complaints) {}

  std::optional<double> operator()(game::AmountField key) {
    const nlohmann::json* value = find(key);
    if (value && value->is_number() && std::isfinite(value->get<double>()) &&
        value->get<double>() >= 0.0)
      return value->get<double>();
    return complain(key, "a number that is not negative");
  }
  /// For optional figures: a missing value or one of another type is no error.
  std::optional<double> if_there(game::AmountField key) {
    const nlohmann::json* value = find(key);
    return value && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
  }
  std::vector<double> if_there(game::AmountsField key) {
    const nlohmann::json* value = find(key);
    std::vector<double> numbers;
    if (!value || !value->is_array()) return numbers;
    for (const nlohmann::json& element : *value)
      numbers.push_back(element.is_number() ? element.get<double>() : 0.0);
    return numbers;
  }
  std::optional<std::uint64_t> operator()(game::CountField key) {
    const nlohmann::json* value = find(key);
    if (value && value->is_number_integer() &&
        (value->is_number_unsigned() || value->get<std::int64_t>() >= 0))
      return value->get<std::uint64_t>();
    complain(key, "a count");
    return std::nullopt;
  }
  std::string operator()(game::TextField key) {
    const nlohmann::json* value = find(key);
    if (value && value->is_string()) return value->get<std::string>();
    complain(key, "a text");
    return {};
  }
  Percentiles operator()(game::DurationsField key) {
    const nlohmann::json* value = find(key);
    const auto histogram = value ? Histogram::from_json(*value) : std::nullopt;
    if (histogram) return histogram->percentiles_ms();
    complain(key, "a histogram");
    return {};
  }
  std::optional<std::uint64_t> samples_if_there(game::DurationsField key) {
    const nlohmann::json* value = find(key);
    const auto histogram = value ? Histogram::from_json(*value) : std::nullopt;
    return histogram ? std::optional(histogram->count()) : std::nullopt;
  }
  void verdict() {
    const nlohmann::json* value = find(report::valid);
    if (!value || !value->is_boolean()) {
      complain(report::valid, "true or false");
    } else if (!value->get<bool>()) {
      complaints_.push_back("the " + who_ + ": " + (*this)(report::why_invalid));
    }
  }

 private:
  const nlohmann::json* find(const char* key) const {
    if (!report_.is_object()) return nullptr;
    const auto found = report_.find(key);
    return found == report_.end() ? nullptr : &*found;
  }
  std::nullopt_t complain(const char* key, const std::string& expected) {
    const nlohmann::json* value = find(key);
    if (accepts_null_ && value != nullptr && value->is_null()) return std::nullopt;
    complaints_.push_back("the report of the " + who_ + " has no " + key + " that is " + expected);
    return std::nullopt;
  }

  const nlohmann::json& report_;
  std::string who_;
  bool accepts_null_;
  std::vector<std::string>& complaints_;
};

std::string plain_text(double number) {
  std::string text = std::to_string(number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

void compare_counts(const std::string& what, std::optional<double> payload,
                    std::optional<double> kernel, double clients,
                    std::vector<std::string>& complaints) {
  if (!payload || !kernel ||
      std::abs(*payload - *kernel) <= count_mismatch_max * *kernel + in_flight_bytes_max * clients)
    return;
  complaints.push_back(what + ": " + plain_text(*payload) + " B counted, " + plain_text(*kernel) +
                       " B by the kernel, more than 1 % and what may be on its way apart");
}

void expect_none(const std::string& what, std::optional<std::uint64_t> count,
                 std::vector<std::string>& complaints) {
  if (count.value_or(0) > 0) complaints.push_back(std::to_string(*count) + " " + what);
}

void expect_equal(const std::string& what, std::optional<double> value, double expected,
                  std::vector<std::string>& complaints) {
  if (value && *value != expected)
    complaints.push_back(what + " is " + plain_text(*value) + " instead of " +
                         plain_text(expected));
}

std::optional<double> per(std::optional<double> amount, std::optional<double> divisor) {
  if (!amount || !divisor || *divisor <= 0.0) return std::nullopt;
  return *amount / *divisor;
}

/// The amounts that one process sent on its connections.
struct Sent {
  std::optional<double> bytes, segments, acknowledgements, with_headers;

  explicit Sent(ReportReader& report)
      : bytes(report(report::bytes_sent)),
        segments(report(report::segments_sent)),
        acknowledgements(report(report::acknowledgements_sent)) {
    const auto kernel_segments = report(report::kernel_segments_sent);
    const auto headers = report.if_there(report::header_bytes_sent);  // of datagrams
    if (headers && bytes) with_headers = *bytes + *headers;
    if (headers || !acknowledgements || !segments) return;
    const SentAmounts sent{.bytes = bytes.value_or(0.0),
                           .segments = *segments,
                           .acknowledgements = *acknowledgements,
                           .kernel_segments = kernel_segments.value_or(*segments)};
    acknowledgements = sent.all_acknowledgements();
    if (bytes) with_headers = sent.with_headers();
  }
};

void fill_from_server(RunRecord& record, ReportReader& server) {
  record.entities = server(report::entities);
  record.ticks = server(report::ticks);
  record.ticks_on_time_fraction = server(report::ticks_on_time_fraction);
  record.physics_us_per_tick = server(report::physics_us_per_tick);
  record.filter_us_per_tick = server(report::filter_us_per_tick);
  record.send_us_per_tick = server(report::send_us_per_tick);
  record.server_rss_bytes = server(report::server_rss_bytes);
  record.state_hash = server(report::state_hash);
  record.measured_s = server(report::measured_s);
  record.messages_per_s = per(server(report::messages_sent), record.measured_s);
  record.writes_per_s = per(server(report::writes_sent), record.measured_s);
}

void fill_bytes(RunRecord& record, ReportReader& server, ReportReader& bots) {
  const double clients = record.cell.clients;
  const Sent by_server(server), by_bots(bots);
  const auto down = by_server.bytes, up = server(report::bytes_received);
  const auto bots_measured_s = bots(report::measured_s);
  const auto wire_down_per_s = per(by_server.with_headers, record.measured_s),
             wire_up_per_s = per(by_bots.with_headers, bots_measured_s);
  record.down_bytes_per_client_per_s = per(per(down, record.measured_s), clients);
  record.up_bytes_per_client_per_s = per(per(up, record.measured_s), clients);
  if (wire_down_per_s && wire_up_per_s)
    record.wire_bytes_per_client_per_s = (*wire_down_per_s + *wire_up_per_s) / clients;
  const auto states = server.if_there(report::state_bytes_sent),
             keys = server.if_there(report::key_bytes_received);
  if (down && up && *down + *up > 0.0 && states && keys)
    record.truth.control_bytes_fraction = std::max(0.0, 1.0 - (*states + *keys) / (*down + *up));
  const auto both = [](std::optional<double> down_per_s, std::optional<double> up_per_s) {
    return down_per_s && up_per_s ? std::optional(*down_per_s + *up_per_s) : std::nullopt;
  };
  record.segments_per_s =
      both(per(by_server.segments, record.measured_s), per(by_bots.segments, bots_measured_s));
  record.acknowledgements_per_s = both(per(by_server.acknowledgements, record.measured_s),
                                       per(by_bots.acknowledgements, bots_measured_s));
}

/// Rows of another shape are left out, so that the sum no longer is the payload.
void fill_fields(RunRecord& record, const nlohmann::json& server) {
  record.fields.clear();
  const auto rows = server.is_object() ? server.find(report::bytes_by_field) : server.end();
  if (rows == server.end() || !rows->is_array() || record.measured_s.value_or(0.0) <= 0.0) return;
  const double clients_s = *record.measured_s * std::max(1u, record.cell.clients);
  for (const nlohmann::json& row : *rows) {
    const auto text = [&row](const char* key) {
      return row.is_object() && row.contains(key) && row[key].is_string()
                 ? row[key].get<std::string>()
                 : std::string();
    };
    const auto amount = [&row](const char* key) {
      return row.is_object() && row.contains(key) && row[key].is_number() ? row[key].get<double>()
                                                                          : 0.0;
    };
    if (text("form").empty()) continue;
    record.fields.push_back({text("direction"), text("channel"), text("form"), text("field"),
                             amount("bits") / 8.0 / clients_s, amount("times") / clients_s});
  }
}

/// The busiest node is the server where there is one, since all traffic passes it; several nodes,
/// and peers, report that of the busiest.
void fill_nodes(RunRecord& record, ReportReader& server) {
  const bool are_peers = record.cell.mode == peer_mode;
  const auto down = server.if_there(report::bytes_sent),
             up = server.if_there(report::bytes_received);
  const auto rate = [&](std::optional<double> bytes) {
    return per(per(bytes, record.measured_s), record.cell.clients);
  };
  if (are_peers) {
    const auto [halo, claims, agreement, interest, updates, keys, standby] = report::traffic_bytes;
    record.traffic = {rate(server.if_there(halo)),      rate(server.if_there(claims)),
                      rate(server.if_there(agreement)), rate(server.if_there(interest)),
                      rate(server.if_there(updates)),   rate(server.if_there(keys)),
                      rate(server.if_there(standby))};
    record.nodes.busiest_bytes_per_s =
        per(server.if_there(report::busiest_node_bytes), record.measured_s);
  } else {
    const auto states = server.if_there(report::state_bytes_sent),
               keys = server.if_there(report::key_bytes_received);
    record.traffic.updates = rate(states), record.traffic.keys = rate(keys);
    if (down && up && states && keys)
      record.traffic.interest = rate(std::max(0.0, *down + *up - *states - *keys));
    if (down && up && record.cell.parameters.nodes == 1)
      record.nodes.busiest_bytes_per_s = per(*down + *up, record.measured_s);
    if (record.wire_bytes_per_client_per_s && record.cell.parameters.nodes == 1)
      record.nodes.busiest_link_bytes_per_s =
          *record.wire_bytes_per_client_per_s * record.cell.clients;
  }
  if (const auto link = server.if_there(report::busiest_link_bytes))
    record.nodes.busiest_link_bytes_per_s = per(link, record.measured_s);
  record.nodes.between_bytes_per_s =
      per(server.if_there(report::between_nodes_bytes), record.measured_s);
  record.nodes.busiest_events_per_s =
      per(server.if_there(are_peers ? report::busiest_node_events : report::physics_events),
          record.measured_s);
}

void fill_from_bots(RunRecord& record, ReportReader& bots) {
  record.update_age_ms = bots(report::update_age_ms);
  record.update_age_samples = bots.samples_if_there(report::update_age_ms);
  record.key_to_effect_ms = bots(report::key_to_effect_ms);
  record.keys_due = bots(report::keys_due);
  record.keys_sent = bots(report::keys_sent);
  record.late_sends_fraction = bots(report::late_sends_fraction);
  record.keys_trouble = bots(report::schedule_trouble);
  if (!record.keys_trouble.empty()) record.key_to_effect_ms = {};
  record.health.bots_cpu_share = bots.if_there(report::cpu_share);
  record.health.histogram_ns_per_record = bots.if_there(report::histogram_ns_per_record);
  record.truth.fairness_jain = jain_index(bots.if_there(report::bytes_received_by_bot));
}

/// True if the server has the planned keys itself and applies each at its instant, so that late
/// bots change neither the game nor its traffic.
bool is_plan_applied(const RunRecord& record) {
  return record.keys == "replay" && record.cell.mode != peer_mode;
}

void check(const RunRecord& record, ReportReader& server, ReportReader& bots,
           std::vector<std::string>& complaints) {
  server.verdict();
  bots.verdict();
  expect_equal("the server's clients", server(report::clients), record.cell.clients, complaints);
  expect_equal("the bots' clients", bots(report::clients), record.cell.clients, complaints);
  expect_equal("the server's tick_rate_hz", server(report::tick_rate_hz),
               record.cell.parameters.tick_rate_hz, complaints);
  if (record.cell.parameters.output_rate_hz > 0.0)
    expect_equal("the server's output_rate_hz", server(report::output_rate_hz),
                 record.cell.parameters.output_rate_hz, complaints);
  expect_none("clients lost by the server", server(report::lost_federates), complaints);
  expect_none("connections dropped by the server", server(report::dropped_connections), complaints);
  expect_none("clients lost by the bots", bots(report::federates_lost), complaints);
  if (!record.keys_trouble.empty() && !is_plan_applied(record))
    complaints.push_back("the bots could not keep their schedule: " + record.keys_trouble);
  // Shared memory bypasses the kernel, which has no counts then, nor of a datagram socket's bytes.
  if (record.transport != "shm" && record.cell.mode != dds_mode) {
    compare_counts("sent by the server", server(report::total_bytes_sent),
                   server(report::kernel_bytes_sent), record.cell.clients, complaints);
    compare_counts("received by the server", server(report::total_bytes_received),
                   server(report::kernel_bytes_received), record.cell.clients, complaints);
    compare_counts("sent by the bots", bots(report::total_bytes_sent),
                   bots(report::kernel_bytes_sent), record.cell.clients, complaints);
    compare_counts("received by the bots", bots(report::total_bytes_received),
                   bots(report::kernel_bytes_received), record.cell.clients, complaints);
  }
  if (record.keys_due && record.keys_sent && *record.keys_sent < *record.keys_due) {
    complaints.push_back("only " + std::to_string(*record.keys_sent) + " of " +
                         std::to_string(*record.keys_due) + " due keys were sent");
  }
  if (record.measured_s == 0.0) complaints.emplace_back("nothing was measured");
}

}  // namespace

void judge(RunRecord& record, const nlohmann::json& server_report,
           const nlohmann::json& bots_report) {
  std::vector<std::string> complaints;
  const bool has_kernel_counts =
      record.transport == "tcp" || record.transport == "udp" || record.transport == "bundle";
  const bool may_lack_figures =
      !has_kernel_counts || record.cell.mode == peer_mode || record.cell.mode == dds_mode ||
      record.cell.parameters.nodes > 1;  // nobody plays, filters and sends for all
  ReportReader server(server_report, "server", may_lack_figures, complaints),
      bots(bots_report, "bots", may_lack_figures, complaints);
  fill_from_server(record, server);
  fill_bytes(record, server, bots);
  fill_nodes(record, server);
  fill_from_bots(record, bots);
  fill_fields(record, server_report);
  check(record, server, bots, complaints);
  std::vector<std::string> once;
  for (const std::string& complaint : complaints) {
    if (std::find(once.begin(), once.end(), complaint) == once.end()) once.push_back(complaint);
  }
  assert(once.size() <= complaints.size() && once.empty() == complaints.empty());
  record.valid = once.empty();
  record.why_invalid.clear();
  for (const std::string& complaint : once)
    record.why_invalid += (record.why_invalid.empty() ? "" : "; ") + complaint;
}

}  // namespace rink::loadgen
