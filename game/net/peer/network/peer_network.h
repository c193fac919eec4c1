// How peers find each other through any that is there already, and the mail between them: one
// connection from each to each.
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

/// Why a peer's part is over before its time.
class SessionError : public std::runtime_error {
 public:
  SessionError(ExitStatus status, const std::string& what)
      : std::runtime_error(what), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

struct PeerNetworkSettings {
  PeerInfo self;  ///< where others reach this peer, which listens there already; and how many bats
                  ///< it plays, of so many:
  std::uint32_t bats = 0;
  Fingerprint session_fingerprint;
  std::uint64_t session = 0;  ///< of a first peer: a number that nobody guesses
  double patience_s = 30.0;   ///< with one whose answer is due
  std::function<bool()> must_end = [] {
    return is_interrupted != 0;
  };  ///< the user wants this peer's part to be over
};

/// Calls that wait throw Parting: when another peer is gone, interrupted or silent, when we are
/// refused, or when a user interrupts us. From `begin` on, where parts are mirrored, it is
/// peer::PeerGone instead of the first three (peer::SentAway of a newcomer who may ask again), and
/// of a user's interrupt only what takes too long. A stranger who says what a peer would not loses
/// the connection, and nothing else happens.
class PeerNetwork final : public peer::Mail, public SideChannel, private rti::TransportListener {
 public:
  PeerNetwork(rti::SocketTransport& sockets, const PeerNetworkSettings& settings,
              double (*now_s)());

  /// Become the first peer, number 0; or ask the peer at `any`, again and again for some seconds if
  /// nobody answers there, and hear who is there.
  void found(const Terms& terms);
  void join(const Place& any);
  /// Of a newcomer while others play: whom it was told of; otherwise nobody.
  const std::vector<peer::PeerNumber>& members() const { return members_; }
  /// Until all are connected who begin.
  void gather();
  /// The play begins: from here on peers may be lost, and others come.
  void begin();
  /// Before each window: so it is known how long one takes, and how long it takes to leave.
  void note_window();
  /// Closes all connections without a word.
  void abandon();
  /// Does nothing but listen until `time_s` of the clock, or a user's interrupt.
  void rest_until(double time_s);
  /// Says goodbye to all, and sees that all that was sent is on its way.
  void leave(const Farewell& farewell);

  const Terms& terms() const { return terms_; }
  peer::PeerNumber number() const { return number_; }
  /// All of them, by number, once they are gathered.
  const std::vector<PeerInfo>& peer_infos() const { return peer_infos_; }
  /// Strangers who were sent away, and the bytes of all frames to peers.
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

  /// An aside that was heard too early.
  void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    deferred_.emplace_back(from, std::move(bytes));
  }

  /// If not empty, called before each wait, also for mail: does what is due, and says when it wants
  /// to be called again [s of the clock].
  std::function<double()> before_wait;

 private:
  /// A caller has asked to be let in while we play. Who is dismissed is heard no more, and closes
  /// the connection itself or has it closed.
  enum class Role : std::uint8_t { stranger, asked, caller, peer, dismissed };
  struct Link {
    Role role = Role::stranger;
    bool is_open = false, is_closed = false, is_done = false;
    bool is_counted = true;     ///< of a peer: its loss matters, as that of a candidate does not
    bool is_announced = false;  ///< of a caller: by `callers`
    peer::PeerNumber number = 0;
    PeerInfo info;
    bool is_parted = false;
    std::string loss;  ///< why it is gone, if it is
    double since_s = 0.0, received_s = 0.0, sent_s = 0.0;
    FrameReader reader;
    std::optional<Greeting> early;  ///< came before we knew our own number
    std::optional<Hello> asking;    ///< came before we knew our own number, too
    std::deque<std::vector<std::uint8_t>> inbox;
    std::deque<std::vector<std::uint8_t>> outbox;
    std::size_t out_begin = 0;  ///< of the first in the outbox, so much is sent
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
      sent_away_;  ///< why we are to ask again; why we, newcomers, are not in after all
  std::map<peer::PeerNumber, PeerInfo>
      expected_;  ///< candidates and newcomers, who will connect to us
  std::map<peer::PeerNumber, std::vector<std::vector<std::uint8_t>>> waiting_mail_;  ///< for such
  int redirections_ = 0;
  bool may_ask_again_ = false;
  std::map<rti::ConnectionId, Link> links_;
  std::vector<std::optional<rti::ConnectionId>> peers_;  ///< by number
  std::vector<PeerInfo>
      peer_infos_;  ///< by number: peers that the first peer admitted, or that said so themselves
  std::uint32_t peer_info_count_ = 1, bats_taken_ = 0;  ///< of a first peer
  std::deque<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>>
      deferred_;  ///< that were not heard yet
  std::optional<SessionError> error_;
  std::uint64_t dismissed_ = 0, bytes_sent_ = 0;
};

}  // namespace rink::game
