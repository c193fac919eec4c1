// A hosted match between two clients in one process, over a modelled network under a virtual clock:
// the same server and clients as over sockets.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "game/model/random_stream.h"
#include "game/net/client/network_match.h"
#include "game/net/server/serving.h"
#include "loadgen/duel/match_bot.h"
#include "rti/transport/modelled/virtual_network.h"

namespace rink::loadgen {

/// Every packet takes a fixed time and, at random, up to five times the mean of an exponential
/// distribution longer; the network keeps them in order. A lost one is sent again after a round
/// trip and the least retransmission time-out, 0.2 s.
class JitteredDelay final : public rti::LinkModel {
 public:
  /// `loss`: of how many packets, as a fraction below 1.
  JitteredDelay(double delay_s, double jitter_s, double loss, std::uint64_t seed)
      : delay_s_(delay_s), jitter_s_(jitter_s), loss_(loss), random_(seed) {}
  std::int64_t arrival_ns(std::uint32_t line, std::int64_t now_ns, std::size_t size) override;

 private:
  double delay_s_, jitter_s_, loss_;
  game::RandomStream random_;
};

struct DuelSettings {
  double delay_s = 0.0;    ///< each way
  double jitter_s = 0.0;   ///< mean of the random part of the delay, each way
  double loss = 0.0;       ///< of packets, each way
  double rate_hz = 60.0;   ///< ticks
  double frame_hz = 60.0;  ///< frames of each client, at phases of their own
  std::uint64_t seed = 1;
  /// The player of each side: a kind of MatchBot, which plays by what its own client
  /// shows; empty: only the caller presses keys, by client().press().
  std::array<std::string, 2> players{};
  game::FlowTimes times{};
};

class Duel {
 public:
  /// `scene_text` is the file of `scene`; there must be no match_objection().
  Duel(const rti::Fom& fom, const game::Scene& scene, const std::string& scene_text,
       const DuelSettings& settings);

  static constexpr std::size_t watcher = 2;  ///< the client that plays no bat

  /// Connects client `k` (again), or removes it: in order, or as kill -9 does.
  void connect(std::size_t k);
  void leave(std::size_t k);
  void kill(std::size_t k);
  bool is_there(std::size_t k) const { return clients_[k] != nullptr; }

  /// Lets `seconds` pass. After each frame of client k, `watch(k)` is called.
  void run(double seconds);
  /// Runs until `condition`, at most `seconds`; returns whether it was met.
  bool run_until(const std::function<bool()>& condition, double seconds);
  std::function<void(std::size_t)> watch;

  game::NetworkMatch& client(std::size_t k) { return *clients_[k]->match; }
  const game::Server& server() const { return serving_.server(); }
  game::Server& server() { return serving_.server(); }
  double now_s() const { return network_.now_s(); }

 private:
  struct Client {
    Client(rti::VirtualNetwork& network, const rti::Fom& fom, const game::ObjectModel& model,
           const game::NetworkMatchSettings& settings);
    rti::VirtualEndpoint end;
    std::unique_ptr<game::NetworkMatch> match;
    std::optional<MatchBot> bot;
  };
  struct Frames {
    std::int64_t next_ns = 0, period_ns = 0;
  };

  void step_to(std::int64_t until_ns);
  void tick();
  void frame(std::size_t k);

  const rti::Fom& fom_;
  const game::ObjectModel model_;
  DuelSettings settings_;
  JitteredDelay link_;
  rti::VirtualNetwork network_;
  rti::VirtualEndpoint server_end_{network_};
  game::Serving serving_;
  std::array<std::unique_ptr<Client>, 3> clients_;
  std::array<Frames, 3> frames_;
  Frames ticks_;
  std::vector<std::unique_ptr<Client>> gone_;  ///< clients whose last bytes may still be under way
};

}  // namespace rink::loadgen
