// Reads a scene's population of kind trace, and makes the scene of its agents.
#include "loadgen/mobility/trace_scene.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "game/model/listed.h"
#include "game/model/scene_file.h"
#include "game/model/scene_table.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/mobility/trace_formats.h"
#include "loadgen/mobility/trace_models.h"

namespace rink::loadgen {
namespace {

using game::SceneError;

/// What a scene says of its trace.
struct TraceSpec {
  std::string name;
  std::filesystem::path file;  ///< empty: a model
  std::string format;
  TraceModel model;
  TraceRules rules;
  std::optional<double> from_s;  ///< of the trace; nothing: its first point
  Vector2 half_extent{0.25, 0.25};
};

/// The root of a scene's file if it has a population of kind trace. What is no TOML is left to the
/// reader of scenes.
std::optional<toml::table> traced_root(const std::string& scene) {
  if (!scene.ends_with(".toml")) return std::nullopt;
  const std::string text = game::scene_text(scene);
  if (text.find("trace") == std::string::npos) return std::nullopt;
  try {
    toml::table root = toml::parse(text, scene);
    const toml::array* populations = root["population"].as_array();
    if (!populations) return std::nullopt;
    for (const toml::node& each : *populations)
      if (const toml::table* table = each.as_table();
          table && (*table)["kind"].value_or(std::string()) == "trace")
        return root;
  } catch (const toml::parse_error&) {
  }
  return std::nullopt;
}

std::filesystem::path found_beside(const std::string& named, const std::string& scene) {
  const std::filesystem::path folder = std::filesystem::path(scene).parent_path();
  const std::filesystem::path kept = folder / kept_trace_name(named);
  return (std::filesystem::is_regular_file(kept) ? kept : folder / named).lexically_normal();
}

class TraceSpecReader {
 public:
  TraceSpecReader(const toml::table& root, const std::string& scene)
      : scene_(scene), root_(root, scene_, "the scene") {}

  TraceSpec read() {
    spec_.name = std::filesystem::path(scene_).stem().string();
    root_.text("name", spec_.name);
    root_.whole("seed", spec_.model.seed, 0, std::numeric_limits<std::int64_t>::max());
    if (std::optional<game::SceneTable> field = root_.table("field")) {
      spec_.rules.field.emplace(0.0, 0.0);
      field->require_number("length", spec_.rules.field->x(), {1e-3, trace_span_max});
      field->require_number("width", spec_.rules.field->y(), {1e-3, trace_span_max});
      field->finish();
    }
    std::vector<game::SceneTable> populations = root_.tables("population");
    if (populations.size() != 1)
      populations.back().refuse_all("a trace is the only population of its scene");
    read_population(populations.front());
    root_.finish();
    return spec_;
  }

 private:
  void read_population(game::SceneTable& table) {
    std::string kind, name, file;
    table.require_text("kind", kind);
    table.text("name", name);
    const bool has_file = table.text("file", file),
               has_model = table.text("model", spec_.model.name);
    if (has_file == has_model) table.refuse_all("expected either file or model");
    if (has_file) read_file(table, file);
    else read_model(table);
    double from_s = 0.0;
    if (table.number("from_s", from_s, {-1e9, 1e9})) spec_.from_s = from_s;
    table.vector("half_extent", spec_.half_extent, {1e-3, 1e3});
    table.finish();
  }

  void read_file(game::SceneTable& table, const std::string& named) {
    spec_.file = found_beside(named, scene_);
    spec_.format = trace_format_of(named).value_or("");
    table.text("format", spec_.format);
    const std::vector<std::string> known = trace_formats();
    if (spec_.format.empty())
      table.refuse_all("the ending of " + named +
                       " tells no format: expected the key format, one of " + game::listed(known));
    if (std::ranges::find(known, spec_.format) == known.end())
      table.refuse("format", "one of " + game::listed(known));
    if (table.number("gap_s", spec_.rules.gap_s, {0.0, 1e9, true}) && spec_.format != "csv")
      table.refuse("gap_s", "no gap_s but in CSV: " + spec_.format + " says itself who is away");
  }

  void read_model(game::SceneTable& table) {
    const std::vector<std::string> known = trace_models();
    if (std::ranges::find(known, spec_.model.name) == known.end())
      table.refuse("model", "one of " + game::listed(known));
    std::uint64_t count = spec_.model.count;
    table.whole("count", count, 1, spec_.rules.agents_max);
    spec_.model.count = static_cast<std::uint32_t>(count);
    table.number("side", spec_.model.side, {1.0, trace_span_max});
    table.number("duration_s", spec_.model.duration_s, {0.1, 1e6});
    if (spec_.rules.field) root_.refuse("field", "no field of a model, which fills its side");
  }

  std::string scene_;
  game::SceneTable root_;
  TraceSpec spec_;
};

/// Numbers and seed are as for other scenes (game/net/scene_choice.h).
void heed(const game::SceneChoice& choice, TraceSpec& spec) {
  if (choice.seed > 0) spec.model.seed = choice.seed;
  if (choice.puck_count > 0)
    throw SceneError(choice.scene +
                     " is a trace: expected pucks = 0, for agents are its only bodies");
  if (choice.bats == 0 && choice.bat_count == 0) return;
  if (!spec.file.empty())
    throw SceneError(choice.scene +
                     " is a trace of a file, which has as many agents as it has: "
                     "expected population = \"fixed\" and bats = 0");
  TraceModel& model = spec.model;
  if (model.side == 0.0) model.side = default_side(model.count);
  if (choice.bats > 0)
    model.side *= std::sqrt(static_cast<double>(choice.bats) / model.count),
        model.count = choice.bats;
  if (choice.bat_count > 0) model.count = choice.bat_count;
  if (model.count > spec.rules.agents_max)
    throw SceneError(choice.scene + ": " + std::to_string(model.count) + " agents: allowed are " +
                     std::to_string(spec.rules.agents_max));
  if (model.side > trace_span_max)
    throw SceneError(choice.scene + ": a side of " + shortest(model.side) + " m: allowed is " +
                     shortest(trace_span_max) + " m");
}

/// Time from the run's beginning, places from the corner of the field.
void shift(MobilityTrace& trace, double from_s, const Vector2& corner) {
  for (Agent& agent : trace.agents)
    for (TracePoint& point : agent.points)
      point.time_s -= from_s, point.x -= corner.x(), point.y -= corner.y();
  trace.begin_s -= from_s, trace.end_s -= from_s;
  trace.low -= corner, trace.high -= corner;
}

void order_by_stay(MobilityTrace& trace) {
  std::vector<std::pair<double, std::size_t>> stays;
  for (std::size_t k = 0; k < trace.agents.size(); ++k)
    stays.emplace_back(-there_until(trace.agents[k], 0.0), k);
  std::ranges::sort(stays);
  std::vector<Agent> ordered;
  ordered.reserve(stays.size());
  for (const auto& [until_s, k] : stays) ordered.push_back(std::move(trace.agents[k]));
  trace.agents = std::move(ordered);
}

MobilityTrace trace_of(const TraceSpec& spec, const std::string& scene) {
  MobilityTrace trace =
      spec.file.empty() ? drawn_trace(spec.model) : read_trace(spec.file, spec.format, spec.rules);
  const double from_s = spec.from_s.value_or(trace.begin_s);
  if (from_s < trace.begin_s || from_s >= trace.end_s)
    throw SceneError(scene + ": from_s = " + shortest(from_s) +
                     " is not within the trace: expected an instant from " +
                     shortest(trace.begin_s) + " to less than " + shortest(trace.end_s) + " s");
  const Vector2 corner =
      spec.rules.field ? Vector2(0.0, 0.0) : Vector2(trace.low - spec.half_extent);
  shift(trace, from_s, corner);
  order_by_stay(trace);
  return trace;
}

game::Scene scene_of(const TraceSpec& spec, const MobilityTrace& trace) {
  game::Scene scene;
  scene.name = spec.name;
  scene.seed = spec.model.seed;
  const Vector2 extent =
      spec.rules.field ? *spec.rules.field : Vector2(trace.high + spec.half_extent);
  scene.world.field.length = extent.x(), scene.world.field.width = extent.y();
  scene.world.allow_overlap = true;
  scene.bodies.bats.reserve(trace.agents.size());
  for (const Agent& agent : trace.agents) {
    const Leg leg = leg_at(agent, 0.0);
    game::Bat bat{.name = agent.id, .body = {}, .thrust = 0.0, .team = game::Team::none};
    bat.body.position = leg.is_there ? Vector2(leg.place - leg.velocity * leg.since_s) : leg.place;
    bat.body.velocity = leg.velocity;
    bat.body.half_extent = spec.half_extent;
    scene.bodies.bats.push_back(std::move(bat));
  }
  return scene;
}

}  // namespace

std::uint32_t PlayedScene::staying_until(double until_s) const {
  assert(trace);
  const auto end = std::ranges::partition_point(
      trace->agents, [until_s](const Agent& agent) { return there_until(agent, 0.0) >= until_s; });
  return static_cast<std::uint32_t>(end - trace->agents.begin());
}

PlayedScene played_scene(const game::SceneChoice& choice) {
  const std::optional<toml::table> root = traced_root(choice.scene);
  if (!root) return {game::chosen_scene(choice), std::nullopt};
  TraceSpec spec = TraceSpecReader(*root, choice.scene).read();
  heed(choice, spec);
  PlayedScene played;
  played.trace = trace_of(spec, choice.scene);
  played.scene = scene_of(spec, *played.trace);
  return played;
}

std::optional<std::filesystem::path> trace_file_of(const std::string& scene) {
  const std::optional<toml::table> root = traced_root(scene);
  if (!root) return std::nullopt;
  const TraceSpec spec = TraceSpecReader(*root, scene).read();
  return spec.file.empty() ? std::nullopt : std::optional(spec.file);
}

std::string kept_trace_name(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("trace-") ? name : "trace-" + name;
}

}  // namespace rink::loadgen
