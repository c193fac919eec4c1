// Who takes part: Rink's engines, with each integrator where they step, and the peers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/trials/trial.h"
#include "game/physics/simulator.h"

namespace rink::accuracy {

/// An engine and, where it has a choice, its integrator.
struct Contender {
  std::string engine;
  std::string integrator{};  ///< empty: it has none to choose

  std::string name() const { return integrator.empty() ? engine : engine + " " + integrator; }
  bool is_stepped() const { return engine != "exact"; }
};

/// The names that --engines takes: Rink's own, then the peers, built in or not.
std::vector<std::string> contender_engines();

/// Those of `engines` and `integrators` (empty: all) that can run, in the order of
/// contender_engines().
std::vector<Contender> contenders(const std::vector<std::string>& engines,
                                  const std::vector<std::string>& integrators);

/// For each of `engines` (empty: all) that was not built in, a sentence that says so and how to get
/// it.
std::vector<std::string> absences(const std::vector<std::string>& engines);

/// The world of `trial` with its bodies; `dt` [s] is the length of a step where there is one.
std::unique_ptr<physics::Simulator> make_world(const Trial& trial, const Contender& contender,
                                               double dt);

}  // namespace rink::accuracy
