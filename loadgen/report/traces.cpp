// Reads the runs from the journal, and their definition of relevance from the experiment.
#include "loadgen/report/traces.h"

#include <string>

#include "loadgen/measure/truth/truth.h"
#include "loadgen/mobility/trace_scene.h"
#include "loadgen/report/artefact.h"
#include "loadgen/run/run_journal.h"

namespace rink::loadgen {

std::size_t write_traces(const std::filesystem::path& folder) {
  check_manifest(folder);
  const Experiment experiment = experiment_of_report(folder);
  std::size_t written = 0;
  for (const RunRecord& run : read_journal(folder / "runs.jsonl").runs) {
    const std::string name = folder / "cells" / name_of(run.cell);
    if (!run.valid || !std::filesystem::exists(name + ".server.jsonl") ||
        !std::filesystem::exists(name + ".bots.jsonl"))
      continue;
    const game::ServerTrace server = game::read_server_trace(name + ".server.jsonl");
    const RelevanceArea area = relevance_of(part_of(experiment, run.cell.part), run.cell,
                                            played_scene(server.choice).scene);
    write_trace(name + ".truth.jsonl", server, game::read_bots_trace(name + ".bots.jsonl"), area);
    ++written;
  }
  return written;
}

}  // namespace rink::loadgen
