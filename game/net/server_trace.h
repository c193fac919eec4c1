// A server's trace of its run, from which quality is computed: the data for a replay, the cost of
// each tick, and samples of its filter's decisions.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "game/model/key.h"
#include "game/net/sampling.h"
#include "game/net/scene_choice.h"

namespace rink::game {

/// Facts without evaluation. docs/metrics.md describes the file.
struct ServerTrace {
  struct Tick {
    double simulated_s = 0.0, physics_s = 0.0, filter_s = 0.0, send_s = 0.0;
  };
  struct Naming {
    std::uint32_t object = 0,
                  body = 0;  ///< RTI object handle and number of the body in the game's world
  };
  /// The objects in the scope of `player` by the decision in force at `instant_s`:
  /// `in_scope[first]` up to `in_scope[last - 1]`.
  struct Decision {
    double instant_s = 0.0;
    std::uint32_t player = 0;
    std::size_t first = 0, last = 0;
  };

  SceneChoice choice;
  std::string state_file;           ///< of the saved game from which the run began
                                    ///< (game/control/game_state.h); empty: the scene's beginning
  std::vector<std::uint8_t> state;  ///< its content
  std::string scheme, policy;
  std::uint32_t clients = 0;
  double rate_hz = 0.0;
  double from_s = 0.0, until_s = 0.0;  ///< the measured span of simulated time
  double end_s = 0.0;                  ///< simulated instant of the last tick
  std::uint64_t state_hash = 0;        ///< of the game then
  std::vector<InputEvent> keys;        ///< as stamped, in the order of submission
  std::vector<Tick> ticks;             ///< within the measured span
  std::vector<Naming> objects;
  std::vector<Decision> decisions;
  std::vector<std::uint32_t> in_scope;

  std::span<const std::uint32_t> scope_of(const Decision& decision) const {
    return std::span(in_scope).subspan(decision.first, decision.last - decision.first);
  }
};

/// A saved game is named by its path from `file`'s folder, and by its hash. Throws
/// std::runtime_error naming `file` if it cannot be written.
void write_trace(const std::string& file, const ServerTrace& trace);
/// Throws TraceError naming file, line and what was expected, or the saved game if that is
/// missing or another.
ServerTrace read_server_trace(const std::string& file);

}  // namespace rink::game
