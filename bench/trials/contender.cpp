// Rink's engines name themselves, so a new one takes part by itself.
#include "bench/trials/contender.h"

#include <algorithm>
#include <cassert>

#include "bench/peers/peers.h"
#include "game/physics/simulator_choice.h"

namespace rink::accuracy {
namespace {

bool is_wanted(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::ranges::find(wanted, name) != wanted.end();
}

bool is_peer(const std::string& engine) {
  return std::ranges::find(peers::peer_names(), engine) != peers::peer_names().end();
}

/// Impacts of unequal masses at most double a speed, and bats under thrust stay below 10 m/s.
double speed_max(const Trial& trial) {
  double fastest = 5.0;
  for (const physics::PuckSpec& puck : trial.pucks)
    fastest = std::max(fastest, puck.velocity.norm());
  return 2.0 * fastest;
}

physics::SimulatorChoice choice_of(const Contender& contender, double dt) {
  physics::SimulatorChoice choice;
  choice.engine = contender.engine;
  if (contender.is_stepped()) choice.integrator = contender.integrator, choice.dt = dt;
  return choice;
}

}  // namespace

std::vector<std::string> contender_engines() {
  std::vector<std::string> names = physics::engine_names();
  names.insert(names.end(), peers::peer_names().begin(), peers::peer_names().end());
  return names;
}

std::vector<Contender> contenders(const std::vector<std::string>& engines,
                                  const std::vector<std::string>& integrators) {
  std::vector<Contender> all;
  for (const std::string& engine : contender_engines()) {
    if (!is_wanted(engines, engine) || (is_peer(engine) && !peers::is_built_in(engine))) continue;
    if (engine == "exact" || is_peer(engine)) {
      all.push_back({engine});
      continue;
    }
    for (const std::string& integrator : physics::integrator_names())
      if (is_wanted(integrators, integrator)) all.push_back({engine, integrator});
  }
  return all;
}

std::vector<std::string> absences(const std::vector<std::string>& engines) {
  std::vector<std::string> sentences;
  for (const std::string& peer : peers::peer_names())
    if (is_wanted(engines, peer) && !peers::is_built_in(peer))
      sentences.push_back(peer + " is absent: " + peers::way_to(peer));
  return sentences;
}

std::unique_ptr<physics::Simulator> make_world(const Trial& trial, const Contender& contender,
                                               double dt) {
  auto world = is_peer(contender.engine)
                   ? peers::make_peer(trial.world, contender.engine, dt, speed_max(trial))
                   : physics::make_simulator(trial.world, choice_of(contender, dt));
  assert(world != nullptr);
  load(trial, *world);
  assert(world->body_count() == trial.body_count());
  return world;
}

}  // namespace rink::accuracy
