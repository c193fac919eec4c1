// The network between members of a session that are ranks of MPI, which check at the start that
// they can play together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/network/deferred_asides.h"
#include "game/net/peer/network/session_error.h"
#include "game/net/peer/network/session_network.h"
#include "game/net/peer/ranks/rank_words.h"
#include "rti/transport/mpi/ranks.h"
#include "rti/transport/transport.h"

namespace rink::game {

/// What a rank's messages are about. A farewell is the last one of a network, and an ending that of
/// a process.
enum class RankChannel : std::uint8_t { mail, aside, farewell, ending };

/// Some ranks cannot play with the first one: thrown at all.
class RanksDiffer : public SessionError {
 public:
  using SessionError::SessionError;
};

/// Calls that wait throw SessionError when a rank is silent for too long or ends, or a user
/// interrupts this one: no rank plays on without the others.
class RankNetwork final : public SessionNetwork {
 public:
  /// `ranks` must outlive it.
  RankNetwork(rti::Ranks& ranks, const PeerNetworkSettings& settings, double (*now_s)());

  /// Checks that all ranks can play `terms`, of so many peers as there are ranks, with the same
  /// fingerprint, and gives them their bats. Throws RanksDiffer if not, with the others' names.
  void agree(const Terms& terms);

  const Terms& terms() const override { return terms_; }
  peer::PeerNumber number() const override { return ranks_.number(); }
  const std::vector<PeerInfo>& peer_infos() const override { return infos_; }
  std::uint64_t bytes_sent() const { return bytes_sent_; }
  std::uint64_t dismissed() const { return 0; }  ///< there are no other connections
  std::uint64_t collectives() const { return collectives_; }

  void gather() override {}
  void begin() override {}
  void note_window() override {}
  void rest_until(double time_s) override;
  void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) override {
    deferred_.keep(from, std::move(bytes));
  }
  void leave(const Farewell& farewell) override;

  rti::TransportCounters sent_to(peer::PeerNumber member) const override {
    return others_[member].sent;
  }

  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
  void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override;
  std::vector<std::vector<std::uint8_t>> share(peer::PeerNumber own, peer::PeerNumber peer_count,
                                               std::vector<std::uint8_t> bytes) override;

 private:
  struct Other {
    std::deque<std::vector<std::uint8_t>> inbox;
    rti::TransportCounters sent;  ///< without MPI's own headers; of mail and side messages
    bool has_left = false;
  };

  void pass(peer::PeerNumber to, RankChannel channel, std::vector<std::uint8_t> bytes);
  std::span<const std::uint8_t> collect(std::span<const std::uint8_t> own);
  void attend();
  void await(const std::string& what, const std::function<bool()>& is_there);
  void read(peer::PeerNumber from);
  void read_all();
  void take(peer::PeerNumber from, rti::RankMessage message);
  void take_farewell(peer::PeerNumber from, const std::vector<std::uint8_t>& bytes);
  void deliver_deferred();
  void lose(peer::PeerNumber peer, ExitStatus status, const std::string& what);
  void check() const;
  bool have_all_left() const;

  rti::Ranks& ranks_;
  PeerNetworkSettings settings_;
  double (*now_s_)();
  Terms terms_;
  std::vector<PeerInfo> infos_;
  std::vector<Other> others_;  ///< by rank; the own one has left from the start
  DeferredAsides deferred_;
  std::optional<SessionError> error_;  ///< the first loss, after which the session cannot go on
  double attend_s_ = 0.0;              ///< when before_wait is due again
  std::uint64_t bytes_sent_ = 0, collectives_ = 0;
};

}  // namespace rink::game
