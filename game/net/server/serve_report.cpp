// Differences of counters, under the names of the report.
#include "game/net/server/serve_report.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "game/model/report_fields.h"
#include "game/model/report_schema.h"
#include "game/replication/exact/exact_fields.h"
#include "im/basics/hexadecimal.h"

namespace rink::game {

using Json = nlohmann::ordered_json;

namespace {

std::uint64_t kernel_segments(const rti::TransportCounters& counters) {
  return counters.kernel_segments_sent.value_or(counters.segments_sent);
}

/// Before its first window a node has sent nothing.
void add_sent_to_nodes(Json& report, const std::vector<rti::TransportCounters>& begin,
                       const std::vector<rti::TransportCounters>& end) {
  for (std::size_t to = 0; to < end.size(); ++to) {
    const rti::TransportCounters first = to < begin.size() ? begin[to] : rti::TransportCounters{};
    const rti::TransportCounters& last = end[to];
    report[report::node_bytes_sent.key].push_back(last.bytes_sent - first.bytes_sent);
    report[report::node_segments_sent.key].push_back(last.segments_sent - first.segments_sent);
    report[report::node_acknowledgements_sent.key].push_back(last.acknowledgements_sent -
                                                             first.acknowledgements_sent);
    report[report::node_kernel_segments_sent.key].push_back(kernel_segments(last) -
                                                            kernel_segments(first));
  }
}

/// Nothing if no ledger was kept.
void add_fields(Json& report, const std::vector<rti::LedgerRow>& begin,
                const std::vector<rti::LedgerRow>& end) {
  for (const rti::LedgerRow& row : rti::ledger_between(begin, end))
    report[report::bytes_by_field].push_back(
        {{"direction", row.direction == rti::LedgerDirection::down ? "down" : "up"},
         {"channel", row.channel == rti::LedgerChannel::stream ? "stream" : "datagram"},
         {"form", row.form},
         {"field", row.field},
         {"bits", row.amount.bits},
         {"times", row.amount.times}});
}

/// Of clients that were there at both instants: how often the one that was updated the least, all
/// on average, and the one that was updated the most were.
void add_evenness(Json& report, const ServingCounts& begin, const ServingCounts& end) {
  std::uint64_t least = ~std::uint64_t{0}, most = 0, sum = 0, count = 0;
  auto first = begin.times_updated.begin();
  for (const auto& [federate, times] : end.times_updated) {
    while (first != begin.times_updated.end() && first->first.value < federate.value) ++first;
    if (first == begin.times_updated.end() || first->first != federate) continue;
    const std::uint64_t updates = times - first->second;
    least = std::min(least, updates);
    most = std::max(most, updates);
    sum += updates;
    ++count;
  }
  report["times_updated_min"] = count > 0 ? least : 0;
  report["times_updated_mean"] =
      count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0.0;
  report["times_updated_max"] = most;
}

}  // namespace

ServingCounts counts_of(const Serving& serving, const rti::TransportCounters& clients) {
  const im::Filter& filter = serving.execution().filter();
  std::vector<im::StageCount> stages;
  filter.list_counts(stages);
  ServingCounts counts{serving.execution().counters(), clients, filter.counters(),
                       std::move(stages), serving.server().game().world().counters()};
  serving.server().seats().for_each([&](rti::FederateHandle federate, const Seats::Seat&) {
    counts.times_updated.emplace_back(federate, serving.execution().times_updated(federate));
  });
  return counts;
}

void follow_times_updated(const Serving& serving, ServingCounts& counts) {
  for (auto& [federate, times] : counts.times_updated)
    times = std::max(times, serving.execution().times_updated(federate));
}

Json counted_report(const Serving& serving, const ServingCounts& first, const ServingCounts& last) {
  const rti::FederationCounters &begin = first.federation, &end = last.federation;
  const rti::FederationCounters now =
      serving.execution().counters();  // connections dropped after the span count, too
  const Server& server = serving.server();
  Json report{
      {"schema", report_schema},
      {report::entities, server.game().entities().size()},
      {report::state_hash, hexadecimal(server.game().hash())},
      {report::bytes_sent, last.transport.bytes_sent - first.transport.bytes_sent},
      {report::bytes_received, last.transport.bytes_received - first.transport.bytes_received},
      {report::writes_sent, last.transport.writes - first.transport.writes},
      {report::segments_sent, last.transport.segments_sent - first.transport.segments_sent},
      {report::state_bytes_sent, end.update_bytes_sent - begin.update_bytes_sent +
                                     end.entry_bytes_sent - begin.entry_bytes_sent},
      {"entry_bytes_sent",
       end.entry_bytes_sent - begin.entry_bytes_sent},  // of these, the states on entry
      {"updates_put_off", end.updates_put_off - begin.updates_put_off},
      {"updates_caught_up", end.updates_caught_up - begin.updates_caught_up},
      {report::key_bytes_received,
       end.interaction_bytes_sent -
           begin.interaction_bytes_sent},  // the RTI passes them to the server
      {report::messages_sent,
       end.updates_sent - begin.updates_sent + end.interactions_sent - begin.interactions_sent},
      {"scope_entries", end.scope_entries - begin.scope_entries},
      {"scope_exits", end.scope_exits - begin.scope_exits},
      {report::physics_events, last.physics.events() - first.physics.events()},
      {"filter_regions_moved", last.filter.regions_moved - first.filter.regions_moved},
      {"filter_pairs_tested", last.filter.pairs_tested - first.filter.pairs_tested},
      {report::lost_federates, server.counters().federates_lost},
      {report::dropped_connections,
       std::accumulate(now.drops.begin(), now.drops.end(), std::uint64_t{0}) +
           serving.host().closed_by_full_queue()},
      {"keys_received", server.keys().counters().received},
      {"keys_applied", server.keys().counters().applied},
      {"keys_refused", server.keys().counters().refused},
      {report::keys_over_limit, server.keys().counters().over_limit}};
  report[report::acknowledgements_sent.key] =
      last.transport.acknowledgements_sent - first.transport.acknowledgements_sent;
  report[report::kernel_segments_sent.key] =
      kernel_segments(last.transport) -
      kernel_segments(first.transport);  // without a kernel the own count
  add_sent_to_nodes(report, first.to_nodes, last.to_nodes);
  add_evenness(report, first, last);
  add_fields(report, first.fields, last.fields);
  // Stages are in the order of the expression; two of a kind have an entry each.
  for (std::size_t i = 0; i < last.stages.size(); ++i) {
    const im::StageCount& stage = last.stages[i];
    report["filter_stages"].push_back(
        {{"stage", stage.stage},
         {"counted", stage.what},
         {"count", stage.count - (i < first.stages.size() ? first.stages[i].count : 0)}});
  }
  return report;
}

rti::LedgerStage& add_ledger(rti::StagedTransport& transport, const rti::Fom& fom) {
  return transport.add<rti::LedgerStage>(fom, [] { return std::make_unique<ExactFields>(); });
}

void add_totals(Json& report, const rti::TransportCounters& total) {
  const auto or_null = [](const std::optional<std::uint64_t>& count) {
    return count ? Json(*count) : Json(nullptr);
  };
  report[report::total_bytes_sent.key] = total.bytes_sent;
  report[report::total_bytes_received.key] = total.bytes_received;
  report[report::kernel_bytes_sent.key] = or_null(total.kernel_bytes_sent);
  report[report::kernel_bytes_received.key] = or_null(total.kernel_bytes_received);
}

}  // namespace rink::game
