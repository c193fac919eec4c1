// One of the servers that share a simulation: it plays the windows of its own part in a thread of
// its own, and hands the server what all nodes have played.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "game/net/peer/network/session_error.h"
#include "game/net/peer/network/session_network.h"
#include "game/net/peer/shared_game.h"
#include "game/net/server/shared_play.h"
#include "game/node/meeting.h"
#include "game/node/node_match.h"
#include "game/node/node_messages.h"
#include "game/node/node_seats.h"
#include "game/node/node_subscription.h"
#include "game/node/node_terms.h"
#include "game/node/node_traffic.h"
#include "game/node/part_receiver.h"
#include "game/node/part_teller.h"
#include "game/node/recovery/node_recovery.h"
#include "game/node/seated_players.h"
#include "game/node/window_feed.h"

namespace rink::game {

struct NodeSettings {
  std::uint32_t player_count = 0;  ///< that this node seats
  double patience_s = 30.0;        ///< with silent nodes
  double gathering_s = 30.0;       ///< how long it waits until all nodes are there
  SchemeReach reach{};      ///< of this node's filter: how far beyond its region a client may see
  double absence_s = 30.0;  ///< for which a player's bat is kept; node 0's holds
  std::optional<FlowTimes> hosting{};  ///< matches, one after the other; the referee's times hold.
                                       ///< Bats are not kept then, but given to whoever comes.
  std::function<void(const std::string&)> notify{};  ///< the user, of losses; by the node's thread
  std::function<std::string()> players_place{};      ///< by it, too: where players reach this node,
                                                     ///< ADDRESS:PORT; late nodes are told
};

/// A node's own thread plays; all functions are the server's thread's. What ends the session early
/// is thrown there, too: SessionError, peer::Halt, peer::ProtocolError.
class Node final : public SharedPlay, private WindowParticipant {
 public:
  /// `game` and `meeting` must outlive it, and the game gives up its start when play begins;
  /// `now_s` is the clock by which windows are played. Throws SceneError for a scene that nodes
  /// cannot share, as meet() does if its pucks come back too soon.
  Node(SharedGame& game, Meeting& meeting, const NodeSettings& settings, double (*now_s)());
  /// Ends the session if it is not over, which ends that of all.
  ~Node() override;

  /// Waits until all nodes are connected, and starts the thread.
  void meet();
  const Terms& terms() const { return network_->terms(); }
  peer::PeerNumber number() const { return network_->number(); }

  std::uint32_t first_player() const override { return network_->peer_infos()[number()].first_bat; }
  std::uint32_t player_count() const override { return network_->peer_infos()[number()].bat_count; }
  void check() override;
  bool may_begin() override;
  double begin() override {
    has_begun_ = true;
    return start_s_;
  }
  bool has_begun() const override { return has_begun_; }
  void ask_seat(const SeatQuestion& question) override {
    seats_->wish({.player = question.player.value_or(no_player), .token = question.token});
  }
  std::optional<SeatAnswer> next_seat() override { return seats_->next_answer(); }
  void keep_seat(std::uint32_t player, std::uint64_t token) override {
    seats_->wish({.change = SeatChange::stay, .player = player, .token = token});
  }
  void leave_seat(std::uint32_t player, std::uint64_t token) override {
    players_->leave(player);
    seats_->wish({.change = SeatChange::leave, .player = player, .token = token});
  }
  void press(std::uint32_t player, Key key, bool is_down, double time) override {
    players_->press(player, key, is_down, match_ ? time : 0.0);
  }
  void look(std::span<const im::Region> regions, bool at_everything) override {
    subscription_.look(regions, at_everything);
  }
  bool has_come(double until) const override;
  std::optional<ShownWindow> show_next(double until, Game& game) override;
  bool has_shown_all() const override;
  SharedMatch* match() override { return match_ ? &*match_ : nullptr; }
  std::vector<rti::TransportCounters> sent() const override { return traffic_.sent(); }

  /// Then finish() does not wait.
  bool has_ended() const { return outcome_.has_ended; }
  /// Waits for the end of the session, which comes with its last window: what was played.
  const PlayedPart& finish();
  /// What the others were told, once it is finished.
  const TellingCounters& telling() const { return teller_->counters(); }

 private:
  /// All but the flag is read once that is true.
  struct Outcome {
    std::atomic<bool> has_ended = false;
    std::exception_ptr failure;
    PlayedPart part;
  };

  void before_window(peer::Session& session) override;
  void after_stretch(const peer::Session& session) override;
  void after_window(const peer::Session& session) override {
    players_->look(session);
    traffic_.note(*network_);
  }

  /// So often a waiting node looks at what its server wants, and sends its keys [s].
  static constexpr double look_s = 0.002;
  /// A tick's instant is computed otherwise than a window's.
  static constexpr double rounding_s = 1e-9;
  /// From when all are ready to the start [s], long enough for each server to notice.
  static constexpr double start_lead_s = 0.2;

  double clock_s() const { return now_s_() - start_s_; }
  void run();
  void wait_for(const std::function<bool()>& is_there);
  void play();
  // node_hosting.cpp
  void host();
  PlayedPart play_whole(const PartOptions& options);
  void await_match_window(const peer::Session& session);

  void pass_on_wishes();
  void pass_on_keys();
  void decide_seats(std::uint64_t instant, double now_s);
  void agree_on_seats(peer::Session& session);
  void take_over(const SeatDecision& decision, peer::Session& session);
  bool receive(peer::PeerNumber from, const std::vector<std::uint8_t>& bytes);
  bool receive(const SeatDecision& decision);

  SharedGame& game_;
  Meeting& meeting_;
  NodeSettings settings_;
  double (*now_s_)();
  std::unique_ptr<SessionNetwork> network_;
  std::optional<SeatedPlayers> players_;
  std::optional<NodeSeats> seats_;
  std::optional<WindowFeed> feed_;
  std::optional<PartReceiver> receiver_;
  std::optional<PartTeller> teller_;
  NodeSubscription subscription_;
  NodeTraffic traffic_;
  std::optional<NodeMatch> match_;
  std::optional<NodeRecovery> recovery_;
  peer::Session* session_ = nullptr;  ///< while one is played
  std::atomic<bool> is_ready_ = false, has_begun_ = false, must_end_ = false;
  std::atomic<double> start_s_ = 0.0;  ///< on the clock; 0: not agreed on yet
  Outcome outcome_;
  std::thread thread_;
};

}  // namespace rink::game
