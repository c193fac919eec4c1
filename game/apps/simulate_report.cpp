// The order of columns and keys, which scripts rely on.
#include "game/apps/simulate_report.h"

#include <nlohmann/json.hpp>

#include "game/model/report_schema.h"
#include "game/physics/overrun.h"
#include "im/basics/hexadecimal.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_name(physics::BodyKind kind) {
  return kind == physics::BodyKind::puck ? "puck" : kind == physics::BodyKind::bat ? "bat" : "post";
}

Json engine_of(const physics::SimulatorChoice& engine) {
  if (engine.engine == "exact") return {{"engine", engine.engine}};
  return {{"engine", engine.engine}, {"integrator", engine.integrator}, {"dt", engine.dt}};
}

Json by_kind(physics::Counters counters) {
  Json kinds;
  for (std::size_t kind = 0; kind < physics::event_kind_names.size(); ++kind)
    kinds[physics::event_kind_names[kind]] = counters.of(static_cast<physics::EventKind>(kind));
  return kinds;
}

Json report_of(const Game& game, const physics::EventBudget& budget) {
  Json report{{"events_per_s", budget.events_per_s()}, {"is_exceeded", budget.is_exceeded()}};
  if (!budget.is_exceeded()) return report;
  const physics::Overrun overrun = physics::overrun_of(game.world(), budget);
  report.update({{"looked_at", overrun.looked_at}, {"span", overrun.span}});
  for (const physics::BusyBody& busy : overrun.busiest)
    report["busiest"].push_back(
        {{"body", busy.body.index},
         {"share", busy.share},
         {"reason", physics::overrun_reason_names[static_cast<std::size_t>(busy.reason)]},
         {"partner", busy.partner ? Json(busy.partner->index) : Json()},
         {"free_path", busy.free_path},
         {"mass_ratio", busy.mass_ratio}});
  return report;
}

}  // namespace

void write_states(std::ostream& stream, const Game& game) {
  stream << "kind,id,x,y,vx,vy\n";
  stream.precision(17);
  for (const Entity& entity : game.entities()) {
    const Vector2 position = game.position(entity.id), velocity = game.velocity(entity.id);
    stream << kind_name(entity.kind) << ',' << entity.id.index << ',' << position.x() << ','
           << position.y() << ',' << velocity.x() << ',' << velocity.y() << '\n';
  }
}

void write_events_heading(std::ostream& stream) { stream << "time,kind,body,other\n"; }

void write_events(std::ostream& stream, std::span<const physics::Event> events) {
  stream.precision(17);
  for (const physics::Event& event : events) {
    stream << event.time << ',' << physics::event_kind_names[static_cast<std::size_t>(event.kind)]
           << ',' << event.body.index << ',';
    if (event.other) stream << event.other->index;
    stream << '\n';
  }
}

std::string summary_of(const Game& game, const physics::SimulatorChoice& engine, double wall_s,
                       const std::optional<physics::EventBudget>& budget) {
  const physics::Simulator& simulator = game.simulator();
  const physics::Counters counters = simulator.counters();
  const Vector2 momentum = simulator.momentum();
  Json summary{{"schema", report_schema}};
  summary.update(engine_of(engine));
  summary.update({{"time", game.now()},
                  {"events", counters.events()},
                  {"collisions", counters.impacts()},
                  {"events_by_kind", by_kind(counters)},
                  {"kinetic_energy", simulator.kinetic_energy()},
                  {"energy_introduced", simulator.energy_introduced()},
                  {"work_of_thrust", simulator.work_of_thrust()},
                  {"dissipated", simulator.dissipated()},
                  {"momentum_x", momentum.x()},
                  {"momentum_y", momentum.y()},
                  {"max_overlap", simulator.max_overlap()},
                  {"escapes", physics::escape_count(simulator)},
                  {"goals_left", game.score().left},
                  {"goals_right", game.score().right},
                  {"is_over", game.is_over()},
                  {"hash", hexadecimal(game.hash())},
                  {"bodies_touched", counters.bodies_touched},
                  {"predictions", counters.predictions},
                  {"evaluations", counters.evaluations},
                  {"stale_events", counters.stale_events},
                  {"crossings", counters.crossings},
                  {"wall_s", wall_s}});
  if (budget) summary["budget"] = report_of(game, *budget);
  return summary.dump(2);
}

std::string summary_of(const Scene& scene, const GoalRatePlan& plan, const GoalRate& rate) {
  return Json{{"schema", report_schema},
              {"scene", scene.name},
              {"players", plan.players},
              {"games", rate.games},
              {"seconds", plan.seconds},
              {"goals_per_min", rate.left_per_min + rate.right_per_min},
              {"goals_per_min_error_95", rate.error_per_min},
              {"goals_left_per_min", rate.left_per_min},
              {"goals_right_per_min", rate.right_per_min},
              {"serves_per_min", rate.serves_per_min},
              {"longest_wait_s", rate.longest_wait_s},
              {"hash", hexadecimal(rate.hash)}}
      .dump(2);
}

}  // namespace rink::game
