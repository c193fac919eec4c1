// The keys of a line of runs.jsonl, defined once in the order of the line, for writing, reading and
// listing them.
#pragma once

#include <concepts>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <type_traits>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// Calls `part.field(key, value)` for each figure.
template <class Part, class Figures>
requires std::same_as<std::remove_const_t<Figures>, Percentiles>
void visit_fields(Part& part, Figures& percentiles) {
  part.field("p50", percentiles.p50);
  part.field("p90", percentiles.p90);
  part.field("p95", percentiles.p95);
  part.field("p99", percentiles.p99);
  part.field("p999", percentiles.p999);
  part.field("max", percentiles.max);
}

template <class Part, class Figures>
requires std::same_as<std::remove_const_t<Figures>, ErrorFigures>
void visit_fields(Part& part, Figures& error) {
  part.field("rms", error.rms);
  part.field("p50", error.p50);
  part.field("p90", error.p90);
  part.field("p99", error.p99);
  part.field("max", error.max);
  part.field("replaced_samples", error.replaced_samples);
  part.field("replaced_rms", error.replaced_rms);
}

/// Calls `line.field(key, value)` for each figure of `truth`, and `line.text_or_null(key, text)`
/// for texts that are null when empty.
template <class Line, class Truth>
void visit_truth(Line& line, Truth& truth) {
  line.field("filter_precision", truth.filter_precision);
  line.field("filter_recall", truth.filter_recall);
  line.field("delivered_precision", truth.delivered_precision);
  line.field("delivered_recall", truth.delivered_recall);
  line.field("missed_interactions", truth.missed_interactions);
  line.field("late_entry_ms", truth.late_entry_ms);
  line.field("position_error_mm", truth.position_error_mm);
  line.field("displayed_error_mm", truth.displayed_error_mm);
  line.field("churn_per_client_per_s", truth.churn_per_client_per_s);
  line.field("flapping_fraction", truth.flapping_fraction);
  line.field("wasted_bytes_fraction", truth.wasted_bytes_fraction);
  line.field("control_bytes_fraction", truth.control_bytes_fraction);
  line.field("fairness_jain", truth.fairness_jain);
  line.field("interactions", truth.interactions);
  line.text_or_null("truth_trouble", truth.error);
  line.text_or_null("relevance", truth.relevance);
}

/// Writes or reads the fields of a whole record, which is a RunRecord or a const one.
template <class Line, class Record>
requires std::same_as<std::remove_const_t<Record>, RunRecord>
void visit_fields(Line& line, Record& run) {
  line.field("mode", run.cell.mode);
  line.field("scheme", run.cell.scheme);
  line.field("policy", run.cell.policy);
  line.field("clients", run.cell.clients);
  line.field("entities", run.entities);
  line.field("seed", run.cell.seed);
  line.field("tick_rate_hz", run.cell.parameters.tick_rate_hz);
  line.field("ticks", run.ticks);
  line.field("ticks_on_time_fraction", run.ticks_on_time_fraction);
  line.field("down_bytes_per_client_per_s", run.down_bytes_per_client_per_s);
  line.field("up_bytes_per_client_per_s", run.up_bytes_per_client_per_s);
  line.field("wire_bytes_per_client_per_s", run.wire_bytes_per_client_per_s);
  line.field("messages_per_s", run.messages_per_s);
  line.field("update_age_ms", run.update_age_ms);
  line.field("key_to_effect_ms", run.key_to_effect_ms);
  line.field("physics_us_per_tick", run.physics_us_per_tick);
  line.field("filter_us_per_tick", run.filter_us_per_tick);
  line.field("send_us_per_tick", run.send_us_per_tick);
  line.field("server_rss_bytes", run.server_rss_bytes);
  line.text_or_null("state_hash", run.state_hash);
  line.field("valid", run.valid);
  line.field("why_invalid", run.why_invalid);
  line.field("scene", run.scene);
  line.field("population", run.population);
  line.field("keys", run.keys);
  line.field("view_fraction", run.cell.parameters.view_fraction);
  line.field("cell_size", run.cell.parameters.cell_size);
  line.field("duration_s", run.duration_s);
  line.field("warm_up_s", run.warm_up_s);
  line.field("start_s", run.start_s);
  line.field("measured_s", run.measured_s);
  line.field("segments_per_s", run.segments_per_s);
  line.field("writes_per_s", run.writes_per_s);
  line.field("keys_due", run.keys_due);
  line.field("keys_sent", run.keys_sent);
  line.field("late_sends_fraction", run.late_sends_fraction);
  line.field("server_cpu_s", run.server_cpu_s);
  line.field("bots_cpu_s", run.bots_cpu_s);
  visit_truth(line, run.truth);
  line.field("bots_cpu_share", run.health.bots_cpu_share);
  line.field("histogram_ns_per_record", run.health.histogram_ns_per_record);
  line.field("tick_us", run.tick_us);
  line.field("transport", run.transport);
  line.field("delay_ms", run.delay_ms);
  line.field("players", run.players);
  line.field("pucks", run.cell.pucks);
  line.field("bats", run.cell.bats);
  line.field("server_cores", run.cell.server_cores);
  line.field("view_area", run.view_area);
  line.field("view_margin", run.cell.parameters.view_margin);
  line.field("sweep_ticks", run.cell.parameters.sweep_ticks);
  line.field("halo_bytes_per_client_per_s", run.traffic.halo);
  line.field("claims_bytes_per_client_per_s", run.traffic.claims);
  line.field("agreement_bytes_per_client_per_s", run.traffic.agreement);
  line.field("interest_bytes_per_client_per_s", run.traffic.interest);
  line.field("updates_bytes_per_client_per_s", run.traffic.updates);
  line.field("keys_bytes_per_client_per_s", run.traffic.keys);
  line.field("busiest_node_bytes_per_s", run.nodes.busiest_bytes_per_s);
  line.field("busiest_node_events_per_s", run.nodes.busiest_events_per_s);
  line.field("busiest_node_cpu_s", run.nodes.busiest_cpu_s);
  line.field("mean_node_cpu_s", run.nodes.mean_cpu_s);
  line.field("update_age_samples", run.update_age_samples);
  line.field("part", run.cell.part);
  line.field("threshold", run.cell.parameters.threshold);
  line.field("extrapolate", run.cell.parameters.extrapolates);
  line.text_or_null("keys_trouble", run.keys_trouble);
  line.field("acknowledgements_per_s", run.acknowledgements_per_s);
  line.field("standby_bytes_per_client_per_s", run.traffic.standby);
  line.field("busiest_link_bytes_per_s", run.nodes.busiest_link_bytes_per_s);
  line.field("nodes", run.cell.parameters.nodes);
  line.field("output_rate_hz", run.cell.parameters.output_rate_hz);
  line.field("between_nodes_bytes_per_s", run.nodes.between_bytes_per_s);
  line.field("bytes_by_field", run.fields);
}

/// One line of runs.jsonl, keys in the documented order.
nlohmann::ordered_json to_json(const RunRecord& record);

/// Reads what `to_json(record)` wrote; writing it again gives the same line. Nothing, and a
/// `complaint` that names the key, if the line is not a record; unknown keys are ignored.
std::optional<RunRecord> run_record_from_json(const nlohmann::json& line, std::string& complaint);

}  // namespace rink::loadgen
