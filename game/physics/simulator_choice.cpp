// Engines by their names, and what is wrong with a name.
#include "game/physics/simulator_choice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "game/physics/paper/naive_simulator.h"
#include "game/physics/paper/paper_simulator.h"
#include "game/physics/world.h"

namespace rink::physics {
namespace {

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
  if (choice.engine == "exact") return std::make_unique<World>(spec);
  const paper::Integrator integrator = *paper::integrator_named(choice.integrator);
  if (choice.engine == "naive")
    return std::make_unique<paper::NaiveSimulator>(spec, integrator, choice.dt);
  return std::make_unique<paper::PaperSimulator>(
      spec, integrator, choice.dt,
      choice.has_sharp_corners ? paper::Corners::sharp : paper::Corners::rounded);
}

}  // namespace rink::physics
