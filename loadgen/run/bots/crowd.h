// The bots of a crowd with their connections: the bot of each connection, lost bots with reasons,
// and the traffic.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "game/net/client/client.h"
#include "game/net/exit_status.h"
#include "loadgen/run/bots/live_player.h"
#include "loadgen/run/bots/meter.h"
#include "loadgen/run/bots/probe.h"
#include "rti/transport/transport.h"

namespace rink::loadgen {

struct Bot {
  Bot(const rti::Fom& fom, const game::ObjectModel& model, const game::ClientSettings& settings,
      Measurements& measurements)
      : client(fom, model, settings), probe(measurements) {}
  bool is_playing() const { return !is_lost && client.state() == game::Client::State::playing; }

  game::Client client;
  Probe probe;
  std::uint32_t number = 0;  ///< in the crowd
  rti::ConnectionId connection = 0;
  std::array<std::uint64_t, 16> seen_tags{};  ///< of the ticks that brought news last
  std::size_t next_seen = 0;
  bool is_connected = false, is_lost = false;
  std::optional<LivePlayer> player;  ///< if it decides for itself
  game::KeysHeld held;               ///< by that one
};

class Crowd {
 public:
  using Connect = std::function<rti::ConnectionId(std::uint32_t bot)>;

  /// What all connections together have carried.
  using Totals = std::function<rti::TransportCounters()>;

  /// `transport` must outlive it. `totals` counts where connections share a socket, of which none
  /// knows the segments; null: each has its own.
  explicit Crowd(rti::Transport& transport, Totals totals = nullptr)
      : transport_(transport), totals_(std::move(totals)) {}

  /// Adds a bot, whose address stays valid.
  Bot& add(std::unique_ptr<Bot> bot);
  void connect(const Connect& connect);

  std::uint32_t size() const { return static_cast<std::uint32_t>(bots_.size()); }
  Bot& operator[](std::uint32_t number) { return *bots_[number]; }
  Bot& of(rti::ConnectionId connection) { return *bots_[bot_of_connection_[connection]]; }
  /// Calls `visit(bot)` for all bots that were not lost.
  template <class Visit>
  void for_each_present(Visit visit) {
    for (const std::unique_ptr<Bot>& bot : bots_)
      if (!bot->is_lost) visit(*bot);
  }

  /// Sends the bot's waiting bytes.
  void send(Bot& bot);
  void lose(Bot& bot, const std::string& why, game::ExitStatus status);
  /// Makes every bot resign, so that the server sees an orderly end.
  void resign();

  std::uint32_t lost_count() const { return lost_; }
  bool are_all_lost() const { return lost_ == bots_.size(); }
  /// The reason why the first lost or refused bot was; empty if none was.
  const std::string& first_error() const { return first_error_; }
  game::ExitStatus first_status() const { return first_status_; }

  /// The traffic from the start until now.
  CarriedSoFar carried() const { return {traffic(), received_by_bot()}; }
  CrowdTraffic traffic() const;
  std::uint64_t unanswered_keys() const;
  /// Memory of all clients' replicas, with their buffers [bytes].
  std::size_t memory_bytes() const;

 private:
  std::vector<std::uint64_t> received_by_bot() const;

  rti::Transport& transport_;
  Totals totals_;
  std::vector<std::unique_ptr<Bot>> bots_;
  std::vector<std::uint32_t> bot_of_connection_;
  std::uint32_t lost_ = 0;
  std::string first_error_;
  game::ExitStatus first_status_ = game::ExitStatus::no_server;
};

}  // namespace rink::loadgen
