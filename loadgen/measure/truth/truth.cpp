// Adds figures of truth to a run's record, and finds the experiment's definition of relevance.
#include "loadgen/measure/truth/truth.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include "game/net/trace_lines.h"
#include "game/net/view.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/measure/truth/classification.h"
#include "loadgen/measure/truth/replay_judgement.h"
#include "loadgen/measure/truth/trace.h"
#include "loadgen/mobility/trace_scene.h"

namespace rink::loadgen {

TruthFigures truth_of(const game::ServerTrace& server, const game::BotsTrace& bots,
                      const RelevanceArea& area, Discoveries* discoveries, Entries entries) {
  ReplayJudgement judgement(server, bots, area, entries);
  const TruthFigures figures = judgement.figures();
  if (discoveries) *discoveries = judgement.discoveries();
  return figures;
}

void write_trace(const std::string& file, const game::ServerTrace& server,
                 const game::BotsTrace& bots, const RelevanceArea& area) {
  TruthTrace trace(file);
  ReplayJudgement judgement(server, bots, area);
  judgement.trace_to(trace);
  judgement.figures();
  trace.finish();
}

RelevanceArea relevance_of(const Experiment& experiment, const Cell& cell,
                           const game::Scene& scene) {
  const physics::Field& field = scene.world.field;
  const double reach = game::view_half_side(experiment.view_area, cell.parameters.view_fraction,
                                            field.length, field.width);
  using Shape = RelevanceArea::Shape;
  constexpr Shape shapes[] = {Shape::square, Shape::disc, Shape::contact, Shape::filter};
  RelevanceArea area{.shape = shapes[static_cast<std::size_t>(experiment.relevance)],
                     .reach = reach,
                     .contact_s = experiment.contact_s};
  if (area.shape == Shape::filter)
    area.expression = experiment.relevant,
    area.always_by_role = game::relevant_kinds_of(scene, experiment.always);
  for (const std::string& more : experiment.also_relevant) {
    if (more == "team") area.has_team = true;
    else area.always = game::relevant_kinds_of(scene, experiment.always);
  }
  return area;
}

namespace {

void judge(RunRecord& record, const Experiment& experiment, const game::ServerTrace& server,
           const game::BotsTrace& bots, Discoveries* discoveries) {
  const Entries entries = discoveries ? Entries::found : Entries::passed_over;
  const RelevanceArea area =
      relevance_of(experiment, record.cell, played_scene(server.choice).scene);
  TruthFigures figures = truth_of(server, bots, area, discoveries, entries);
  figures.control_bytes_fraction = record.truth.control_bytes_fraction;
  figures.fairness_jain = record.truth.fairness_jain;
  record.truth = figures;
}

/// Under a virtual clock nothing takes time.
void add_tick_costs(RunRecord& record, const game::ServerTrace& server) {
  std::vector<double> ticks_s;
  for (const game::ServerTrace::Tick& tick : server.ticks)
    ticks_s.push_back(tick.physics_s + tick.filter_s + tick.send_s);
  if (std::any_of(ticks_s.begin(), ticks_s.end(), [](double tick_s) { return tick_s > 0.0; }))
    record.tick_us = percentiles_us(std::move(ticks_s));
}

/// Runs `act`; its error becomes the reason why figures are absent, or why the run does not count.
template <class Act>
void record_error(RunRecord& record, const Act& act) {
  try {
    act();
  } catch (const DifferentGame& error) {
    record.valid = false;
    record.why_invalid += (record.why_invalid.empty() ? "" : "; ") + std::string(error.what());
  } catch (const std::exception& error) {
    record.truth.error = error.what();
  }
}

const char* const too_many_changes =
    "more scopes changed than there was room for; what was delivered is not judged";

}  // namespace

void add_truth(RunRecord& record, const Experiment& experiment, const game::ServerTrace& server,
               const game::BotsTrace& bots) {
  record_error(record, [&] {
    judge(record, experiment, server, bots, nullptr);
    if (!bots.is_complete) record.truth.error = too_many_changes;
  });
}

void add_truth(RunRecord& record, const Experiment& experiment, const std::string& server_file,
               const std::string& bots_file, const std::filesystem::path& discovery_file) {
  std::optional<Discoveries> discoveries;
  std::error_code ignored;
  if (!discovery_file.empty())
    std::filesystem::remove(discovery_file, ignored);  // of an earlier run
  record_error(record, [&] {
    const game::ServerTrace server = game::read_server_trace(server_file);
    record.truth.relevance =
        text_of(relevance_of(experiment, record.cell, played_scene(server.choice).scene));
    add_tick_costs(record, server);
    const game::BotsTrace bots = game::read_bots_trace(bots_file);
    Discoveries found;
    judge(record, experiment, server, bots, &found);
    if (bots.is_complete) discoveries = found;
    if (!bots.is_complete) record.truth.error = bots_file + ": " + too_many_changes;
  });
  if (discoveries && !discovery_file.empty()) write_discoveries(discovery_file, *discoveries);
}

}  // namespace rink::loadgen
