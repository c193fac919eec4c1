// Makes a cell's record from its experiment.
#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

std::optional<double> RunRecord::total_us_per_tick() const {
  if (!physics_us_per_tick || !filter_us_per_tick || !send_us_per_tick) return std::nullopt;
  return *physics_us_per_tick + *filter_us_per_tick + *send_us_per_tick;
}

RunRecord record_for(const Experiment& experiment, const Cell& cell) {
  RunRecord record;
  record.cell = cell;
  record.scene = experiment.scene;
  record.population = experiment.population == Population::fixed ? "fixed" : "per_client";
  record.keys = experiment.keys == KeySource::replay ? "replay" : "live";
  record.transport = cell.mode == dds_mode ? "udp" : to_string(experiment.transport);
  record.delay_ms = experiment.transport == TransportKind::virtual_time ? experiment.delay_ms : 0.0;
  record.players = experiment.players;
  record.view_area = experiment.view_area;
  record.duration_s = experiment.duration_s;
  record.warm_up_s = experiment.warm_up_s;
  record.start_s = experiment.start_s;
  return record;
}

}  // namespace rink::loadgen
