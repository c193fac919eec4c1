// The choice among all engines, by name.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/physics/body.h"
#include "game/physics/simulator.h"

namespace rink::physics {

/// `engine` is one of engine_names(), `integrator` one of integrator_names(). `integrator` and the
/// length of a frame `dt` [s] apply to the stepped engines, paper and naive.
struct SimulatorChoice {
  std::string engine = "exact";
  std::string integrator = "euler";
  double dt = 1.0 / 60.0;
  bool has_sharp_corners = true;  ///< of bats, where the paper's engine lets a disc meet them
};

/// exact: events at their exact times (docs/physics.md). paper: frames with times of impact; naive:
/// frames with static tests only (docs/paper-engine.md).
const std::vector<std::string>& engine_names();
/// euler (explicit), semi_implicit (Euler), verlet (velocity Verlet) and rk4 (classical
/// Runge-Kutta).
const std::vector<std::string>& integrator_names();

/// Why make_simulator() cannot make this, naming what would be possible; nothing if it can.
std::optional<std::string> objection(const SimulatorChoice& choice);

/// An engine without bodies. There must be no objection (asserted).
std::unique_ptr<Simulator> make_simulator(const WorldSpec& spec,
                                          const SimulatorChoice& choice = {});

}  // namespace rink::physics
