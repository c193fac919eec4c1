// How peers find each other through any that is there already, and the mail between them: one connection from each to each.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/net/peer/frames.h"
#include "game/net/peer/greetings.h"
#include "game/peer/protocol.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

/// Why a peer's part is over before its time.
class Parting : public std::runtime_error {
 public:
  Parting(ExitStatus status, const std::string& what) : std::runtime_error(what), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

struct MeetingSettings {
  Guest self;               ///< where others reach this peer, which listens there already; and how many bats it plays, of so many:
  std::uint32_t bats = 0;
  Luggage luggage;
  std::uint64_t session = 0;  ///< of a first peer: a number that nobody guesses
  double patience_s = 30.0;   ///< with one whose answer is due
  std::function<bool()> must_end = [] { return is_interrupted != 0; };  ///< the user wants this peer's part to be over
};

/// Calls that wait throw Parting: when another peer is gone, interrupted or silent, when we are refused, or when a user interrupts us. From `begin` on, where parts are mirrored,
/// it is peer::PeerGone instead of the first three, and of a user's interrupt only what takes too long. A stranger who says what a peer would not loses the connection, and
/// nothing else happens.
class Meeting final : public peer::Mail, private rti::TransportListener {
 public:
  Meeting(rti::SocketTransport& sockets, const MeetingSettings& settings, double (*now_s)());

  /// Become the first peer, number 0; or ask the peer at `any` and hear who is there.
  void found(const Terms& terms);
  void join(const Place& any);
  /// Until all are connected.
  void gather();
  /// The play begins: from here on peers may be lost.
  void begin() { may_lose_ = terms_.is_mirrored; }
  /// Does nothing but listen until `time_s` of the clock, or a user's interrupt.
  void rest_until(double time_s);
  /// Says goodbye to all, and sees that all that was sent is on its way.
  void leave(const Farewell& farewell);

  const Terms& terms() const { return terms_; }
  peer::PeerNumber number() const { return number_; }
  /// All of them, by number, once they are gathered.
  const std::vector<Guest>& guests() const { return guests_; }
  /// Strangers who were sent away, and the bytes of all frames to peers.
  std::uint64_t dismissed() const { return dismissed_; }
  std::uint64_t bytes_sent() const { return bytes_sent_; }

  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override;
  void part(peer::PeerNumber peer, bool is_lost) override;

 private:
  enum class Role : std::uint8_t { stranger, asked, peer };
  struct Link {
    Role role = Role::stranger;
    bool is_open = false, is_closed = false, is_done = false;
    peer::PeerNumber number = 0;
    Guest guest;
    bool is_parted = false;
    std::string loss;               ///< why it is gone, if it is
    double since_s = 0.0, heard_s = 0.0, said_s = 0.0;
    FrameReader reader;
    std::optional<Greeting> early;  ///< came before we knew our own number
    std::optional<Hello> asking;    ///< likewise
    std::deque<std::vector<std::uint8_t>> inbox;
    std::deque<std::vector<std::uint8_t>> outbox;
    std::size_t out_begin = 0;  ///< of the first in the outbox, so much is sent
  };

  void on_open(rti::ConnectionId connection) override;
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override;
  void on_close(rti::ConnectionId connection, rti::CloseReason reason, const std::string& detail) override;

  void attend(double wait_s);
  void read_frames(rti::ConnectionId connection);
  void push_all();
  void push(rti::ConnectionId connection, Link& link);
  void dial(const Guest& guest, Role role, peer::PeerNumber number);
  void say(rti::ConnectionId connection, FrameKind kind, const std::vector<std::uint8_t>& content);
  void dismiss(rti::ConnectionId connection);
  void refuse(rti::ConnectionId connection, RefusalKind kind, const std::string& reason);
  bool hear_stranger(rti::ConnectionId connection, const Frame& frame);
  bool hear_answer(rti::ConnectionId connection, const Frame& frame);
  bool hear_peer(Link& link, const Frame& frame);
  void answer(rti::ConnectionId connection, const Hello& hello);
  void admit(rti::ConnectionId connection, const Greeting& greeting);
  void enter(rti::ConnectionId connection, const Welcome& welcome);
  void become_peer(rti::ConnectionId connection, peer::PeerNumber number, const Guest& guest);
  void note(ExitStatus status, const std::string& what);
  void lose(Link& link, ExitStatus status, const std::string& what);
  void show_signs();
  bool are_all_here() const;
  Link& link_of(peer::PeerNumber number) { return links_.at(*peers_[number]); }
  static std::string name_of(const Link& link) { return "peer " + std::to_string(link.number) + " (" + link.guest.place.text() + ")"; }

  rti::SocketTransport& sockets_;
  MeetingSettings settings_;
  double (*now_s_)();
  Terms terms_;
  peer::PeerNumber number_ = 0;
  bool is_in_ = false, may_lose_ = false;
  std::optional<double> interrupted_s_;
  int redirections_ = 0;
  std::map<rti::ConnectionId, Link> links_;
  std::vector<std::optional<rti::ConnectionId>> peers_;  ///< by number
  std::vector<Guest> guests_;                            ///< by number: whom the first peer has let in, or who has said that it was
  std::uint32_t guest_count_ = 1, bats_taken_ = 0;       ///< of a first peer
  std::optional<Parting> trouble_;
  std::uint64_t dismissed_ = 0, bytes_sent_ = 0;
};

}  // namespace rink::game
