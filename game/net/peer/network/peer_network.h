// Connects peers through any that plays already, and carries their mail: one connection between any
// two.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/net/peer/network/frames.h"
#include "game/net/peer/network/greetings.h"
#include "game/net/peer/network/side_channel.h"
#include "game/peer/protocol.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

/// The reason why a peer's session ends early.
class SessionError : public std::runtime_error {
 public:
  SessionError(ExitStatus status, const std::string& what)
      : std::runtime_error(what), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

struct PeerNetworkSettings {
  PeerInfo self;  ///< where others reach this peer, which listens there already; and the number of
                  ///< its bats, among so many:
  std::uint32_t bats = 0;
  Fingerprint session_fingerprint;
  std::uint64_t session = 0;  ///< of a first peer: a number that cannot be guessed
  double patience_s = 30.0;   ///< timeout of a peer whose answer is due
  std::function<bool()> must_end = [] {
    return is_interrupted != 0;
  };  ///< the user wants this peer's part to be over
};

/// Calls that wait throw SessionError when another peer is gone, interrupted or silent, when this
/// one is refused, or when a user interrupts it. From `begin` on, where parts are replicated, they
/// throw peer::PeerGone instead in the first three cases (peer::SentAway for a newcomer that may
/// try again), and for a user's interrupt only if leaving takes too long. A connection that sends
/// what no peer would is closed without further effect.
class PeerNetwork final : public peer::Mail, public SideChannel, private rti::TransportListener {
 public:
  PeerNetwork(rti::SocketTransport& sockets, const PeerNetworkSettings& settings,
              double (*now_s)());

  /// Become the first peer, number 0; or ask the peer at `any`, repeatedly for some seconds if none
  /// answers, and learn the members.
  void found(const Terms& terms);
  void join(const Place& any);
  /// The members at the time of a newcomer's joining a running game; otherwise empty.
  const std::vector<peer::PeerNumber>& members() const { return members_; }
  /// Waits until all first peers are connected.
  void gather();
  /// The game begins: from here on peers may be lost, and others join.
  void begin();
  /// Call it before each window, to measure its length and the time that leaving takes.
  void note_window();
  /// Closes all connections without a message.
  void abandon();
  /// Only receives until `time_s` of the clock, or a user's interrupt.
  void rest_until(double time_s);
  /// Sends a farewell to all, and waits until all bytes are sent.
  void leave(const Farewell& farewell);

  const Terms& terms() const { return terms_; }
  peer::PeerNumber number() const { return number_; }
  /// All peers, by number, once they are gathered.
  const std::vector<PeerInfo>& peer_infos() const { return peer_infos_; }
  /// The number of refused connections, and the bytes of all frames to peers.
  std::uint64_t dismissed() const { return dismissed_; }
  std::uint64_t bytes_sent() const { return bytes_sent_; }
  rti::TransportCounters transported() const { return sockets_.totals(); }

  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override;
  void part(peer::PeerNumber peer, bool is_lost) override;
  void rejoin(peer::PeerNumber peer) override;
  std::vector<peer::Newcomer> callers() override;
  void refuse(std::uint64_t token, const std::string& reason, bool may_ask_again) override;
  void expect(const peer::Candidate& candidate, bool has_asked_here,
              const peer::State& state) override;
  bool reaches(peer::PeerNumber candidate) override;
  bool has_given_up(peer::PeerNumber candidate) override;
  void admit(peer::PeerNumber candidate, bool is_in) override;
  void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;

  /// Keeps a side message that came too early.
  void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    deferred_.emplace_back(from, std::move(bytes));
  }

  /// If not empty, called before each wait, also for mail: does what is due, and returns when it
  /// must be called again [s of the clock].
  std::function<double()> before_wait;

 private:
  /// A caller has asked to join during the game. A dismissed connection is read no more; either end
  /// closes it.
  enum class Role : std::uint8_t { stranger, asked, caller, peer, dismissed };
  struct Link {
    Role role = Role::stranger;
    bool is_open = false, is_closed = false, is_done = false;
    bool is_counted = true;     ///< of a peer: its loss matters; that of a candidate does not
    bool is_announced = false;  ///< of a caller: by `callers`
    peer::PeerNumber number = 0;
    PeerInfo info;
    bool is_parted = false;
    std::string loss;  ///< why it is gone, if it is
    double since_s = 0.0, received_s = 0.0, sent_s = 0.0;
    FrameQueue reader;
    std::optional<Greeting> early;  ///< came before the own number was known
    std::optional<Hello> asking;    ///< came before the own number was known, too
    std::deque<std::vector<std::uint8_t>> inbox;
    std::deque<std::vector<std::uint8_t>> outbox;
    std::size_t out_begin = 0;  ///< bytes sent of the first message in the outbox
  };

  void on_open(rti::ConnectionId connection) override;
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override;
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string& detail) override;

  void attend(double wait_s);
  void read_frames(rti::ConnectionId connection);
  void push_all();
  void push(rti::ConnectionId connection, Link& link);
  void dial(const PeerInfo& info, Role role, peer::PeerNumber number);
  void send_frame(rti::ConnectionId connection, FrameKind kind,
                  const std::vector<std::uint8_t>& content);
  void dismiss(rti::ConnectionId connection);
  void refuse(rti::ConnectionId connection, RefusalKind kind, const std::string& reason);
  bool handle_stranger(rti::ConnectionId connection, const Frame& frame);
  bool handle_answer(rti::ConnectionId connection, const Frame& frame);
  bool handle_peer_frame(rti::ConnectionId connection, Link& link, const Frame& frame);
  void answer_in_play(rti::ConnectionId connection, const Hello& hello);
  void answer(rti::ConnectionId connection, const Hello& hello);
  void admit(rti::ConnectionId connection, const Greeting& greeting);
  void enter(rti::ConnectionId connection, const Welcome& welcome);
  void become_peer(rti::ConnectionId connection, peer::PeerNumber number, const PeerInfo& info);
  void note(ExitStatus status, const std::string& what);
  void lose(Link& link, ExitStatus status, const std::string& what);
  void show_signs();
  void deliver_deferred();
  bool are_all_here() const;
  bool may_leave_in_order() const;
  Link* link_at(peer::PeerNumber number);
  Link& link_of(peer::PeerNumber number) { return links_.at(*peers_[number]); }
  static std::string name_of(const Link& link) {
    return "peer " + std::to_string(link.number) + " (" + link.info.place.text() + ")";
  }

  rti::SocketTransport& sockets_;
  PeerNetworkSettings settings_;
  double (*now_s_)();
  Terms terms_;
  peer::PeerNumber number_ = 0;
  bool is_in_ = false, may_lose_ = false, is_playing_ = false;
  std::optional<double> interrupted_s_, window_begin_s_;
  double longest_window_s_ = 0.0;
  std::vector<peer::PeerNumber> members_;
  std::string unanswered_,
      sent_away_;  ///< why this peer must try again; why this newcomer was not admitted
  std::map<peer::PeerNumber, PeerInfo>
      expected_;  ///< candidates and newcomers, which will connect to this peer
  std::map<peer::PeerNumber, std::vector<std::vector<std::uint8_t>>> waiting_mail_;  ///< for such
  int redirections_ = 0;
  bool may_ask_again_ = false;
  std::map<rti::ConnectionId, Link> links_;
  std::vector<std::optional<rti::ConnectionId>> peers_;  ///< by number
  std::vector<PeerInfo> peer_infos_;  ///< by number: peers that the first peer admitted, or that
                                      ///< introduced themselves
  std::uint32_t peer_info_count_ = 1, bats_taken_ = 0;  ///< of a first peer
  std::deque<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>>
      deferred_;  ///< side messages that were not handled yet
  std::optional<SessionError> error_;
  std::uint64_t dismissed_ = 0, bytes_sent_ = 0;
};

}  // namespace rink::game
