// Connects peers through any that plays already, and carries their mail: one connection between any
// two.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "game/net/peer/network/leaving_time.h"
#include "game/net/peer/network/peer_admission.h"
#include "game/net/peer/network/peer_conversation.h"
#include "game/net/peer/network/peer_dialling.h"
#include "game/net/peer/network/peer_links.h"
#include "game/net/peer/network/peer_losses.h"
#include "game/net/peer/network/peer_roster.h"
#include "game/net/peer/network/session_error.h"
#include "game/net/peer/network/session_network.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

/// Waits for the transport, and gives what comes to whoever handles it. Calls that wait throw
/// SessionError when another peer is gone, interrupted or silent, when this one is refused, or when
/// a user interrupts it. From `begin` on, where parts are replicated, they throw peer::PeerGone
/// instead in the first three cases (peer::SentAway for a newcomer that may try again), and for a
/// user's interrupt only if leaving takes too long. A connection that sends what no peer would is
/// closed without further effect.
class PeerNetwork final : public SessionNetwork, private rti::TransportListener {
 public:
  PeerNetwork(rti::SocketTransport& sockets, const PeerNetworkSettings& settings,
              double (*now_s)());

  /// Become the first peer, number 0; or ask the peer at `any`, repeatedly for some seconds if none
  /// answers, and learn the members.
  void found(const Terms& terms) { roster_.found(terms); }
  void join(const Place& any);
  /// The members at the time of a newcomer's joining a running game; otherwise empty.
  const std::vector<peer::PeerNumber>& members() const { return roster_.members(); }
  void gather() override;
  void begin() override;
  void note_window() override { leaving_.note_window(now_s_()); }
  /// Closes all connections without a message.
  void abandon() { links_.abandon(); }
  void rest_until(double time_s) override;
  std::optional<std::vector<std::uint8_t>> next_mail(peer::PeerNumber from) override;
  void leave(const Farewell& farewell) override;

  const Terms& terms() const override { return roster_.terms(); }
  peer::PeerNumber number() const override { return roster_.number(); }
  const std::vector<PeerInfo>& peer_infos() const override { return roster_.infos(); }
  /// The number of refused connections, and the bytes of all frames to peers.
  std::uint64_t dismissed() const { return links_.dismissed(); }
  std::uint64_t bytes_sent() const { return links_.bytes_sent(); }
  rti::TransportCounters transported() const { return sockets_.totals(); }
  /// The counters of the connection to another peer; zero if there is none.
  rti::TransportCounters sent_to(peer::PeerNumber peer) const override {
    return links_.counters_of(peer);
  }

  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override {
    return receive_any({&from, 1}).second;
  }
  std::pair<peer::PeerNumber, std::vector<std::uint8_t>> receive_any(
      std::span<const peer::PeerNumber> from) override;
  void part(peer::PeerNumber peer, bool is_lost) override { conversation_.part(peer, is_lost); }
  void rejoin(peer::PeerNumber peer) override { conversation_.rejoin(peer); }
  std::vector<peer::Newcomer> callers() override { return admission_.callers(); }
  void refuse(std::uint64_t token, const std::string& reason, bool may_ask_again) override;
  void expect(const peer::Candidate& candidate, bool has_asked_here,
              const peer::State& state) override;
  bool reaches(peer::PeerNumber candidate) override { return admission_.reaches(candidate); }
  bool has_given_up(peer::PeerNumber candidate) override;
  void admit(peer::PeerNumber candidate, bool is_in) override;
  void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;

  void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) override;

 private:
  void on_open(rti::ConnectionId connection) override;
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override;
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string& detail) override;

  void attend(double wait_s);
  void read_frames(rti::ConnectionId connection);
  bool handle(rti::ConnectionId connection, PeerLink& link, Frame frame);
  void end_bad(rti::ConnectionId connection, PeerLink& link);
  void check_interrupt();
  SessionError too_few_came();

  rti::SocketTransport& sockets_;
  double (*now_s_)();
  double patience_s_, gathering_s_;
  std::function<bool()> must_end_;
  PeerRoster roster_;
  PeerLosses losses_;
  LeavingTime leaving_;
  PeerLinks links_;
  PeerAdmission admission_;
  PeerDialling dialling_;
  PeerConversation conversation_;
  std::optional<Patience> waiting_;  ///< for other things than mail
};

}  // namespace rink::game
