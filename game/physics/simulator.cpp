// The exact engine behind the common interface, and the choice among all engines.
#include "game/physics/simulator.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <utility>

#include "game/physics/paper/naive_simulator.h"
#include "game/physics/paper/paper_simulator.h"

namespace rink::physics {
namespace {

class ExactSimulator final : public Simulator {
 public:
  explicit ExactSimulator(const WorldSpec& spec) : world_(spec) {}
  explicit ExactSimulator(World world) : world_(std::move(world)) {}

  BodyId add(const PuckSpec& spec) override { return world_.add(spec); }
  BodyId add(const BatSpec& spec) override { return world_.add(spec); }
  BodyId add(const PostSpec& spec) override { return world_.add(spec); }
  void remove(BodyId body) override { world_.remove(body); }
  void set_thrust(BodyId bat, const Vector2& acceleration) override {
    world_.set_thrust(bat, acceleration);
  }
  void place(BodyId puck, const Vector2& position, const Vector2& velocity) override {
    world_.place(puck, position, velocity);
  }
  std::optional<Goal> advance(double until) override { return world_.advance(until); }

  void record_events(bool is_wanted) override { world_.record_events(is_wanted); }
  std::span<const Event> events() const override { return world_.events(); }
  void forget_events() override { world_.forget_events(); }

  const WorldSpec& spec() const override { return world_.spec(); }
  double now() const override { return world_.now(); }
  std::uint32_t body_count() const override { return world_.body_count(); }
  BodyKind kind(BodyId body) const override { return world_.kind(body); }
  double radius(BodyId body) const override { return world_.radius(body); }
  Vector2 half_extent(BodyId body) const override { return world_.half_extent(body); }
  double mass(BodyId body) const override { return world_.mass(body); }
  bool is_in_play(BodyId body) const override { return world_.is_in_play(body); }
  Vector2 position(BodyId body) const override { return world_.position(body); }
  Vector2 velocity(BodyId body) const override { return world_.velocity(body); }
  bool is_free(const Vector2& centre, double radius) const override {
    return world_.is_free(centre, radius);
  }
  bool is_free(const Vector2& centre, const Vector2& half_extent) const override {
    return world_.is_free(centre, half_extent);
  }

  Counters counters() const override { return world_.counters(); }
  double spin(BodyId body) const override { return world_.spin(body); }
  double kinetic_energy() const override { return world_.kinetic_energy(); }
  double energy_introduced() const override { return world_.energy_introduced(); }
  double work_of_thrust() const override { return world_.work_of_thrust(); }
  double dissipated() const override { return world_.dissipated(); }
  Vector2 momentum() const override { return world_.momentum(); }
  double max_overlap() const override { return world_.max_overlap(); }
  std::uint64_t hash() const override { return world_.hash(); }

  std::unique_ptr<Simulator> copy() const override {
    std::optional<World> world = World::restore(world_.save());
    assert(world);
    return std::make_unique<ExactSimulator>(std::move(*world));
  }

  const World* exact_world() const override { return &world_; }

 private:
  World world_;
};

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

const std::vector<std::string>& engine_names() {
  static const std::vector<std::string> names{"exact", "paper", "naive"};
  return names;
}

const std::vector<std::string>& integrator_names() { return paper::integrator_names(); }

std::optional<std::string> objection(const SimulatorChoice& choice) {
  if (!is_among(engine_names(), choice.engine))
    return "the engine " + choice.engine + " is unknown: expected one of " + listed(engine_names());
  if (!is_among(integrator_names(), choice.integrator))
    return "the integrator " + choice.integrator + " is unknown: expected one of " +
           listed(integrator_names());
  if (!std::isfinite(choice.dt) || choice.dt <= 0.0)
    return "frames of " + text_of(choice.dt) + " s: expected a finite length above 0 s";
  return std::nullopt;
}

std::unique_ptr<Simulator> make_simulator(const WorldSpec& spec, const SimulatorChoice& choice) {
  assert(!objection(choice));
  if (choice.engine == "exact") return std::make_unique<ExactSimulator>(spec);
  const paper::Integrator integrator = *paper::integrator_named(choice.integrator);
  if (choice.engine == "naive")
    return std::make_unique<paper::NaiveSimulator>(spec, integrator, choice.dt);
  return std::make_unique<paper::PaperSimulator>(
      spec, integrator, choice.dt,
      choice.has_sharp_corners ? paper::Corners::sharp : paper::Corners::rounded);
}

std::unique_ptr<Simulator> exact_simulator(World world) {
  return std::make_unique<ExactSimulator>(std::move(world));
}

std::uint32_t escape_count(const Simulator& simulator) {
  const Field& field = simulator.spec().field;
  std::uint32_t count = 0;
  for (BodyId body; body.index < simulator.body_count(); ++body.index) {
    if (!simulator.is_in_play(body)) continue;
    const Vector2 position = simulator.position(body);
    const bool is_inside = position.x() >= 0.0 && position.x() <= field.length &&
                           position.y() >= 0.0 && position.y() <= field.width;
    if (!is_inside) ++count;  // also where a coordinate is not a number
  }
  return count;
}

}  // namespace rink::physics
