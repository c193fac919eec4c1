// A server and any number of clients in one process, stepped tick by tick under a clock of the
// test's own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/net/client/client.h"
#include "game/net/server/server.h"
#include "game/replication/exact/exact_feed.h"
#include "game/replication/game_facts.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/staged/ledger_stage.h"
#include "tests/net/wire/recording_stage.h"

namespace rink::game {

/// Whether a box of these half sides touches `view`.
inline bool overlaps(const im::Region& view, const Vector2& centre, const Vector2& half_extent) {
  return centre.x() - half_extent.x() <= view.high_x &&
         centre.x() + half_extent.x() >= view.low_x &&
         centre.y() - half_extent.y() <= view.high_y && centre.y() + half_extent.y() >= view.low_y;
}

/// What a lockstep rink is made of; everything but the scene has a default that suits most tests.
struct LockstepSettings {
  std::string scheme = "region";
  std::uint32_t clients = 2;
  double rate_hz = 30.0;
  double view_fraction = 0.2;
  double view_margin = 0.0;
  bool extrapolates = true, declares_regions = true;
  std::uint32_t told = 0;  ///< the first so many clients do not compute, whatever the policy
  rti::UpdateRate update_rate = {};  ///< of every federate
  bool is_recorded = false;          ///< keeps a ledger and every byte
  ServerSettings server = {};
};

/// The whole path of the real commands (server, RTI, filter, transport, clients) without sockets or
/// real time.
class LockstepRink {
 public:
  LockstepRink(const Scene& scene, const LockstepSettings& settings);

  /// Exchanges messages until all is quiet; no simulated time passes.
  void settle();
  /// Joins everybody and passes the start barrier.
  void start();
  /// Simulates one tick, publishes, filters, delivers.
  void tick();
  void run(double seconds);

  Client& add_client(const std::string& name, bool only_watches = false);
  /// Cuts client `index` off without a word, as kill -9 does.
  void kill(std::size_t index);

  /// Client `index` takes its leave.
  void leave(std::size_t index);

  Server& server() { return *server_; }
  Client& client(std::size_t index) { return *clients_[index]->client; }
  std::size_t client_count() const { return clients_.size(); }
  const std::string& scheme() const { return settings_.scheme; }
  rti::FederationExecution& execution() { return execution_; }
  /// Null unless it is recorded.
  const rti::LedgerStage* ledger() const { return ledger_; }
  const RecordingStage* recording() const { return recording_; }
  /// Null unless the policy is "exact".
  const ExactFeed* exact_feed() const { return exact_ ? &*exact_ : nullptr; }
  /// Where the federation is called "rti", for who joins on his own.
  rti::InProcessNetwork& network() { return network_; }
  /// Simulated time of the next key: tests set it between two ticks.
  double now = 0.0;
  std::uint64_t tick_number = 0;

 private:
  struct Player {
    explicit Player(rti::InProcessNetwork& network) : endpoint(network) {}
    rti::InProcessEndpoint endpoint;
    std::unique_ptr<Client> client;
    std::unique_ptr<rti::FederateLink> link;
    rti::FederateLinks links;
    bool is_dead = false;
  };
  void send_tick(double time);

  LockstepSettings settings_;
  const rti::Fom fom_;
  const ObjectModel model_;
  rti::InProcessNetwork network_;
  rti::InProcessEndpoint hub_, server_endpoint_;
  rti::StagedTransport staged_{hub_};
  rti::LedgerStage* ledger_ = nullptr;
  RecordingStage* recording_ = nullptr;
  rti::FederationExecution execution_;
  rti::FederationHost host_;
  std::unique_ptr<Server> server_;
  GameFacts facts_;
  std::optional<ExactFeed> exact_;
  std::unique_ptr<rti::FederateLink> server_link_;
  rti::FederateLinks server_links_;
  std::vector<std::unique_ptr<Player>> clients_;
  bool is_started_ = false;
};

}  // namespace rink::game
