// Sums over peers as JSON.
#include "loadgen/run/peers/peer_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "game/model/report_fields.h"
#include "game/model/report_schema.h"
#include "loadgen/run/peers/peer_station.h"

namespace rink::loadgen {

using Json = nlohmann::ordered_json;

namespace {

Json or_null(const std::optional<std::uint64_t>& count) {
  return count ? Json(*count) : Json(nullptr);
}

}  // namespace

void TrafficTotals::add(const game::PeerNode& node, const rti::TransportCounters& counters) {
  for (std::size_t k = 0; k < game::traffic_count; ++k)
    by_subject[k] += node.sent()[k], messages += node.messages_sent()[k];
  bytes += counters.bytes_sent, writes += counters.writes, segments += counters.segments_sent;
  acknowledgements += counters.acknowledgements_sent,
      kernel_segments += counters.kernel_segments_sent.value_or(counters.segments_sent);
  sent.push_back(counters.bytes_sent);
  const peer::PeerCounters& played = node.peer().counters();
  events.push_back(played.own_events + played.ghost_events);
  received.push_back(counters.bytes_received);
}

void TrafficTotals::add(const game::PeerLoad& load) {
  for (std::size_t k = 0; k < game::traffic_count; ++k)
    by_subject[k] += load.bytes[k], messages += load.messages[k];
  bytes += load.bytes_sent, writes += load.writes, segments += load.segments;
  acknowledgements += load.acknowledgements, kernel_segments += load.kernel_segments;
  sent.push_back(load.bytes_sent);
  received.push_back(load.bytes_received);
  events.push_back(load.events);
}

TrafficTotals operator-(TrafficTotals a, const TrafficTotals& b) {
  for (std::size_t k = 0; k < game::traffic_count; ++k) a.by_subject[k] -= b.by_subject[k];
  a.messages -= b.messages, a.bytes -= b.bytes, a.writes -= b.writes, a.segments -= b.segments;
  a.acknowledgements -= b.acknowledgements, a.kernel_segments -= b.kernel_segments;
  for (std::size_t k = 0; k < b.sent.size(); ++k)
    a.sent[k] -= b.sent[k], a.received[k] -= b.received[k], a.events[k] -= b.events[k];
  for (std::size_t k = 0; k < b.link.size(); ++k) a.link[k] -= b.link[k];
  return a;
}

std::uint64_t last_window(const Experiment& experiment, const Cell& cell) {
  return static_cast<std::uint64_t>(std::floor(
      (experiment.warm_up_s + experiment.duration_s) * cell.parameters.tick_rate_hz + 1e-9));
}

/// Window 0 is the start, at which nothing ends.
std::uint64_t measured_windows(const Experiment& experiment, const Cell& cell) {
  const auto first = static_cast<std::uint64_t>(
      std::max(1.0, std::ceil(experiment.warm_up_s * cell.parameters.tick_rate_hz - 1e-9)));
  const std::uint64_t last = last_window(experiment, cell);
  return last > first ? last - first : 0;
}

Json peers_report(const Cell& cell, const PeerTotals& totals) {
  using game::Traffic;
  const TrafficTotals& measured = totals.measured;
  const auto of = [&](Traffic about) {
    return measured.by_subject[static_cast<std::size_t>(about)];
  };
  std::uint64_t busiest = 0;
  for (std::size_t k = 0; k < measured.sent.size(); ++k)
    busiest = std::max(busiest, measured.sent[k] + measured.received[k]);
  Json report{
      {"schema", game::report_schema},
      {game::report::mode, cell.mode},
      {game::report::scheme, cell.scheme},
      {game::report::policy, cell.policy},
      {game::report::clients, cell.clients},
      {game::report::seed, cell.seed},
      {game::report::tick_rate_hz, cell.parameters.tick_rate_hz},
      {game::report::ticks, totals.measured_windows},
      {game::report::ticks_on_time_fraction,
       totals.known == 0
           ? Json(nullptr)
           : Json(static_cast<double>(totals.on_time) / static_cast<double>(totals.known))},
      {game::report::physics_us_per_tick, nullptr},
      {game::report::filter_us_per_tick, nullptr},
      {game::report::send_us_per_tick, nullptr},
      {game::report::server_rss_bytes, or_null(totals.busiest_rss)},
      {game::report::measured_s, totals.measured_s},
      {game::report::valid, totals.measured_windows > 0},
      {game::report::why_invalid, totals.measured_windows > 0 ? "" : "no window was measured"},
      {game::report::entities, totals.entities},
      {game::report::state_hash, totals.state_hash},
      {game::report::bytes_sent, measured.bytes},
      {game::report::bytes_received, measured.bytes},
      {game::report::writes_sent, measured.writes},
      {game::report::segments_sent, measured.segments},
      {game::report::acknowledgements_sent, measured.acknowledgements},
      {game::report::kernel_segments_sent, measured.kernel_segments},
      {game::report::state_bytes_sent,
       2 * (of(Traffic::halo) + of(Traffic::updates))},  // each byte goes both down and up
      {game::report::key_bytes_received, 2 * of(Traffic::keys)},
      {game::report::messages_sent, measured.messages},
      {game::report::busiest_node_bytes, busiest},
      {game::report::busiest_node_events,
       measured.events.empty() ? 0
                               : *std::max_element(measured.events.begin(), measured.events.end())},
      {game::report::windows, totals.windows},
      {"repeated_windows", totals.counters.repeats},
      {game::report::own_events, totals.counters.own_events},
      {game::report::ghost_events, totals.counters.ghost_events},
      {game::report::hand_overs, totals.counters.hand_overs},
      {game::report::mean_ghosts,
       static_cast<double>(totals.counters.ghost_windows) /
           static_cast<double>(std::max<std::uint64_t>(1, totals.counters.windows))},
      {game::report::lost_federates, 0},
      {game::report::dropped_connections, 0},
      {game::report::total_bytes_sent, totals.whole.bytes},
      {game::report::total_bytes_received, totals.whole_received},
      {game::report::kernel_bytes_sent, or_null(totals.kernel_sent)},
      {game::report::kernel_bytes_received, or_null(totals.kernel_received)}};
  if (!measured.link.empty())
    report[game::report::busiest_link_bytes.key] =
        *std::max_element(measured.link.begin(), measured.link.end());
  for (std::size_t k = 0; k < game::traffic_count; ++k)
    report[game::report::traffic_bytes[k].key] = measured.by_subject[k];
  return report;
}

Json players_report(const Cell& cell, const PeerTotals& totals, const Measurements& measured) {
  return {{game::report::clients, cell.clients},
          {game::report::measured_s, totals.measured_s},
          {game::report::bytes_received, totals.measured.bytes},
          {game::report::bytes_sent, totals.measured.bytes},
          {game::report::segments_sent, totals.measured.segments},
          {game::report::acknowledgements_sent, totals.measured.acknowledgements},
          {game::report::kernel_segments_sent, totals.measured.kernel_segments},
          {game::report::update_age_ms, measured.update_latency.to_json()},
          {game::report::key_to_effect_ms, measured.input_latency.to_json()},
          {game::report::keys_due, measured.keys_due},
          {game::report::keys_sent, measured.keys_sent},
          {game::report::keys_unanswered, totals.keys_unanswered},
          {game::report::late_sends_fraction,
           static_cast<double>(measured.late_sends) /
               std::max<double>(1.0, static_cast<double>(measured.keys_sent))},
          {game::report::send_lateness_ms, measured.send_lateness.to_json()},
          {game::report::schedule_trouble, measured.schedule_trouble()},
          {game::report::federates_lost, 0},
          {game::report::bytes_received_by_bot, totals.measured.received},
          {game::report::total_bytes_received, totals.whole_received},
          {game::report::total_bytes_sent, totals.whole.bytes},
          {game::report::kernel_bytes_received, or_null(totals.kernel_received)},
          {game::report::kernel_bytes_sent, or_null(totals.kernel_sent)},
          {game::report::valid, totals.error.empty()},
          {game::report::why_invalid, totals.error}};
}

}  // namespace rink::loadgen
