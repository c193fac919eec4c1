// The server's side of a federation without its process: game, RTI and the link between them; the
// owner of a clock drives it.
#pragma once

#include <functional>
#include <optional>

#include "game/net/server/server.h"
#include "game/net/server/server_recorder.h"
#include "game/replication/exact/exact_feed.h"
#include "game/replication/game_facts.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"

namespace rink::game {

/// The costs of one tick on the owner's clock [s]; all 0 under a clock that stands still.
struct TickCosts {
  double physics_s = 0.0, filter_s = 0.0, send_s = 0.0;
};

/// Owns the federation execution and the server federate beside it. Reads no clock itself: `now_s`
/// [s] is real or virtual time; clients connect by the transports added to `host`.
class Serving {
 public:
  using Clock = std::function<double()>;

  /// `now_s` measures costs and silence; `simulated_now` returns the simulated instant at which a
  /// key arrives.
  struct Clocks {
    Clock now_s, simulated_now;
  };
  /// `fom` must outlive it.
  Serving(const rti::Fom& fom, const Scene& scene, const ServerSettings& server,
          const rti::FederationSettings& federation, Clocks clocks);

  rti::FederationHost& host() { return host_; }
  const rti::FederationHost& host() const { return host_; }
  rti::FederationExecution& execution() { return execution_; }
  const rti::FederationExecution& execution() const { return execution_; }
  Server& server() { return server_; }
  const Server& server() const { return server_; }

  /// Receives and forwards messages, for at most `longest_wait_s`. Interactions are forwarded at
  /// once, not with the tick, so that keys are stamped when they arrive.
  void exchange(double longest_wait_s);

  /// One tick: plays up to `simulated_s` [s], or as far as the server's budget lets it, publishes
  /// (see Server::publish), matches and flushes. `due_s` [s] is the instant on the owner's clock at
  /// which it was due, 0 before the start; clients get it as the stamp's tag, unless they play
  /// hosted matches.
  TickCosts tick(double simulated_s, double due_s);

  /// Watches every tick from now on.
  void collect_trace(const SamplingSettings& settings, double rate_hz) {
    recorder_.emplace(settings, rate_hz);
  }
  /// The trace, if it was collected; the caller adds scene, scheme and policy.
  std::optional<ServerTrace> trace() const;
  std::size_t evidence_bytes() const { return recorder_ ? recorder_->memory_bytes() : 0; }

  /// Publishes, matches and flushes without playing: one write per destination. False if there was
  /// nothing to publish yet, and so nothing to match.
  bool send(double simulated_s, double due_s, TickCosts& costs);
  /// What clients that compute are sent; null unless the policy is "exact".
  const ExactFeed* exact() const { return exact_ ? &*exact_ : nullptr; }

 private:
  void look_around();

  Clock now_s_;
  rti::InProcessNetwork network_;
  rti::InProcessEndpoint hub_{network_}, endpoint_{network_};
  rti::FederationExecution execution_;
  rti::FederationHost host_;
  Server server_;
  rti::FederateLink link_;
  rti::FederateLinks links_;
  std::optional<ServerRecorder> recorder_;
  GameFacts facts_;
  SharedPlay* shared_;              ///< null: this server alone plays
  std::optional<ExactFeed> exact_;  ///< under the policy "exact"
};

/// A federation under the filter `scheme` over the scene's field and among its posts; `cell_size`
/// [m] is for schemes with cells, 0 leaves it to them.
rti::FederationSettings federation_settings(const Scene& scene, const std::string& scheme,
                                            double cell_size);

/// The rate at which clients are told of a game of `tick_rate_hz` [1/s] ticks at `output_rate_hz`,
/// above 0 and at most that (asserted) and known to 0.001; 0: at every tick.
rti::UpdateRate update_rate_of(double output_rate_hz, double tick_rate_hz);

/// `cell_size` [m], or where that is 0 and the scheme has cells the one that follows from the
/// world: nodes have different clients, whose views would choose different cells.
double cell_size_of_nodes(const Scene& scene, const std::string& scheme, double cell_size);

}  // namespace rink::game
