// Servers with clients in this process, alone or as nodes that share a simulation by TCP, stepped
// tick by tick under a clock that the test holds.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/net/client/client.h"
#include "game/net/peer/shared_game.h"
#include "game/net/server/serving.h"
#include "game/node/node.h"
#include "game/node/socket_meeting.h"
#include "game/replication/scheme_reach.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/in_process.h"
#include "tests/net/rink_model.h"

namespace rink::game {

/// A real clock that stops at a limit, and stands still where it is past one. Nodes begin a window
/// by it.
class HeldClock {
 public:
  inline static std::atomic<double> limit_s = std::numeric_limits<double>::infinity();
  static void release() { limit_s = std::numeric_limits<double>::infinity(); }
  static double now_s() {
    const double real_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    const double now_s = std::min(real_s, limit_s.load());
    double latest_s = latest_s_;
    while (now_s > latest_s && !latest_s_.compare_exchange_weak(latest_s, now_s)) {
    }
    return std::max(now_s, latest_s);
  }

 private:
  inline static std::atomic<double> latest_s_ = 0.0;
};

/// One server with its clients.
class ClientServer {
 public:
  ClientServer(const Scene& scene, const ServerSettings& server, const std::string& scheme)
      : hub_(network_),
        serving_(rink_fom(), scene, server,
                 federation_settings(scene, scheme, cell_size_of_nodes(scene, scheme, 0.0)),
                 {HeldClock::now_s, [this] { return simulated_s_; }}) {
    hub_.listen("clients");
    serving_.host().add(hub_);
  }

  void add_player(std::uint32_t number, double view_fraction) {
    auto player = std::make_unique<Player>(network_);
    const ClientSettings settings{.name = "bat-" + std::to_string(number),
                                  .view_fraction = view_fraction};
    player->client = std::make_unique<Client>(rink_fom(), rink_model(), settings);
    player->link = std::make_unique<rti::FederateLink>(
        player->client->ambassador(), player->endpoint, player->endpoint.connect("clients"));
    player->links.add(*player->link);
    players_.push_back(std::move(player));
  }
  Client& client(std::size_t index) { return *players_[index]->client; }
  std::size_t client_count() const { return players_.size(); }
  Server& server() { return serving_.server(); }
  rti::FederationExecution& execution() { return serving_.execution(); }

  /// Exchanges messages until all is quiet; no simulated time passes.
  void settle() {
    constexpr int rounds = 6;  // a join takes five
    for (int round = 0; round < rounds; ++round) {
      serving_.exchange(0.0);
      for (const std::unique_ptr<Player>& player : players_) {
        player->endpoint.poll({}, player->links);
        player->client->follow_bat(simulated_s_);
        player->link->flush(HeldClock::now_s());
      }
    }
    serving_.exchange(0.0);
  }
  /// Joins everybody and passes the start barrier.
  void start() {
    for (int round = 0; round < 4; ++round) settle(), publish();
    settle();
    server().call_to_start();
    settle();
  }
  /// True once the game has come to `until` [s], which is then published.
  bool simulate(double until) {
    if (server().simulate(until) < until) return false;
    simulated_s_ = until;
    publish();
    settle();
    return true;
  }

 private:
  struct Player {
    explicit Player(rti::InProcessNetwork& network) : endpoint(network) {}
    rti::InProcessEndpoint endpoint;
    std::unique_ptr<Client> client;
    std::unique_ptr<rti::FederateLink> link;
    rti::FederateLinks links;
  };
  void publish() {
    TickCosts costs;
    serving_.send(simulated_s_, simulated_s_, costs);
  }

  double simulated_s_ = 0.0;
  rti::InProcessNetwork network_;
  rti::InProcessEndpoint hub_;
  Serving serving_;
  std::vector<std::unique_ptr<Player>> players_;
};

/// Two nodes that play `ticks` windows of `tick_s` each.
class LockstepNodes {
 public:
  static constexpr std::uint32_t count = 2;
  struct Settings {
    /// Positions at every tick put views at equal places everywhere; trajectories that were sent at
    /// other instants would put them a rounding apart.
    std::string scheme = "region", policy = "periodic";
    std::uint32_t ticks = 30, players_of_each = 2;
    double tick_s = 1.0 / 30.0, view_fraction = 0.05;
  };

  LockstepNodes(const Scene& scene, const Settings& settings) : settings_(settings) {
    HeldClock::release();
    const Terms terms = terms_of_nodes(count, settings.ticks * settings.tick_s, settings.tick_s);
    const Place any{"127.0.0.1", 0};
    for (std::uint32_t k = 0; k < count; ++k) {
      games_.push_back(std::make_unique<SharedGame>(scene, std::vector<InputEvent>{}));
      meetings_.push_back(
          k == 0 ? std::make_unique<SocketMeeting>(any, terms)
                 : std::make_unique<SocketMeeting>(any, meetings_.front()->place().value()));
      nodes_.push_back(std::make_unique<Node>(*games_.back(), *meetings_.back(), node_settings(),
                                              HeldClock::now_s));
    }
    std::thread meeting([&] { nodes_[1]->meet(); });
    nodes_[0]->meet();
    meeting.join();
    for (std::uint32_t k = 0; k < count; ++k) {
      servers_.push_back(std::make_unique<ClientServer>(
          scene,
          ServerSettings{
              .policy = settings.policy, .replay = std::nullopt, .shared = nodes_[k].get()},
          settings.scheme));
      for (std::uint32_t player = 0; player < settings.players_of_each; ++player)
        servers_[k]->add_player(nodes_[k]->first_player() + player, settings.view_fraction);
      servers_[k]->start();
    }
  }
  ~LockstepNodes() { HeldClock::release(); }

  /// All begin at once, when all are ready.
  void begin() {
    bool is_ready = false;
    while (!is_ready) {
      is_ready = true;
      for (const std::unique_ptr<Node>& node : nodes_) is_ready = node->may_begin() && is_ready;
      pause();
    }
    for (const std::unique_ptr<Node>& node : nodes_) start_s_ = std::max(start_s_, node->begin());
    HeldClock::limit_s = start_s_;
  }
  /// Plays the next window everywhere, and publishes it.
  void tick() {
    HeldClock::limit_s = start_s_ + tick_number_ * settings_.tick_s + 1e-6;
    ++tick_number_;
    for (std::uint32_t k = 0; k < count; ++k)
      while (!servers_[k]->simulate(now())) nodes_[k]->check(), pause();
  }
  double now() const {
    return tick_number_ == settings_.ticks ? nodes_[0]->terms().until
                                           : tick_number_ * settings_.tick_s;
  }
  std::uint32_t tick_number() const { return tick_number_; }
  /// After the last tick.
  const PlayedPart& finish(std::uint32_t node) {
    HeldClock::release();
    return nodes_[node]->finish();
  }

  SchemeReach reach() const {
    const SharedGame& game = *games_.front();
    const double cell_size = cell_size_of_nodes(game.scene(), settings_.scheme, 0.0);
    return reach_of(settings_.scheme,
                    federation_settings(game.scene(), settings_.scheme, cell_size).filter_settings,
                    game.extent_max());
  }
  ClientServer& server(std::uint32_t node) { return *servers_[node]; }
  Node& node(std::uint32_t number) { return *nodes_[number]; }

 private:
  NodeSettings node_settings() const {
    return {.player_count = settings_.players_of_each, .reach = reach()};
  }
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

  Settings settings_;
  std::vector<std::unique_ptr<SharedGame>> games_;
  std::vector<std::unique_ptr<SocketMeeting>> meetings_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<std::unique_ptr<ClientServer>> servers_;
  double start_s_ = 0.0;
  std::uint32_t tick_number_ = 0;
};

}  // namespace rink::game
