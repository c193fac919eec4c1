// Who takes part in a session, as one peer knows: its terms, each peer's number and bats, and who
// is expected.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <variant>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "game/peer/protocol.h"

namespace rink::game {

/// True if others can connect to what a message says of a peer's place.
bool is_reachable(const Place& place);
/// What the session's state says of a peer that others will connect to.
PeerInfo info_of(const peer::Candidate& candidate);

/// Nothing here is of connections: it answers what messages say, and checks them.
class PeerRoster {
 public:
  /// What this peer brings: where it is reached and its number of bats, of `bats` altogether; what
  /// must be equal at all; and, of a first peer, the number of the session.
  PeerRoster(const PeerInfo& self, std::uint32_t bats, const Fingerprint& session_fingerprint,
             std::uint64_t session);

  /// This peer is the first one, number 0.
  void found(const Terms& terms);
  /// This peer is let in.
  void enter(const Welcome& welcome);
  /// The game begins: whoever comes now joins a running game.
  void begin() { is_playing_ = true; }

  bool is_in() const { return is_in_; }
  bool is_playing() const { return is_playing_ || !members_.empty(); }
  const Terms& terms() const { return terms_; }
  peer::PeerNumber number() const { return number_; }
  const Fingerprint& session_fingerprint() const { return session_fingerprint_; }
  const PeerInfo& self() const { return self_; }
  /// The members at the time of a newcomer's joining a running game; otherwise empty.
  const std::vector<peer::PeerNumber>& members() const { return members_; }
  /// By number: peers that the first peer admitted, or that introduced themselves.
  const std::vector<PeerInfo>& infos() const { return infos_; }
  void set_info(peer::PeerNumber number, const PeerInfo& info);

  /// Of the first peer, which assigns the numbers, so that newcomers through different peers get
  /// different ones: a newcomer's number and bats, or why it gets none.
  std::variant<Welcome, Refused> seat(const PeerInfo& info);
  /// How this peer introduces itself to those that it connects to.
  Greeting greeting() const { return {session_, number_, self_}; }
  /// What a candidate that asked here is sent: the members of `state` and the earlier candidates.
  Welcome welcome_of(const peer::Candidate& candidate, const peer::State& state) const;

  /// Candidates and newcomers will connect to this peer.
  void expect(peer::PeerNumber number, const PeerInfo& info) { expected_[number] = info; }
  void expect_no_more(peer::PeerNumber number) { expected_.erase(number); }
  bool is_expected(peer::PeerNumber number) const { return expected_.contains(number); }

  /// Who a greeting may come from. `early`: before the own number was known, or before the peer was
  /// announced. `due`: a peer of a higher number before the game. `unknown`: none of this
  /// session's.
  enum class Standing : std::uint8_t { early, expected, due, unknown };
  Standing standing_of(const Greeting& greeting) const;

 private:
  PeerInfo self_;
  std::uint32_t bats_;
  Fingerprint session_fingerprint_;
  std::uint64_t session_;
  Terms terms_;
  peer::PeerNumber number_ = 0;
  bool is_in_ = false, is_playing_ = false;
  std::vector<peer::PeerNumber> members_;
  std::vector<PeerInfo> infos_;                ///< by number
  std::uint32_t seated_ = 1, bats_taken_ = 0;  ///< of a first peer
  std::map<peer::PeerNumber, PeerInfo> expected_;
};

}  // namespace rink::game
