// The mail between peers that are ranks of MPI, and the check at the start that they can play
// together.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "game/net/peer/network/greetings.h"
#include "game/net/peer/network/session_error.h"
#include "game/peer/protocol.h"
#include "rti/transport/mpi/ranks.h"

namespace rink::game {

/// A rank's first data to all others. What follows `version` is of that version; all versions use
/// `rank_words` bytes.
struct RankWords {
  std::array<std::uint8_t, 8> magic{'R', 'i', 'n', 'k', 'R', 'a', 'n', 'k'};
  std::uint32_t version = peer_protocol_version;
  Fingerprint session_fingerprint;
  double until = 0.0, window = 0.0;  ///< s
  bool is_of_this_version() const { return version == peer_protocol_version; }
};
inline constexpr std::size_t rank_words = 128;  ///< bytes: the length (1), the data, zeros

template <class Stream>
bool exchange(Stream& stream, RankWords& words) {
  for (std::uint8_t& byte : words.magic)
    if (!stream.number(byte)) return false;
  if (words.magic != RankWords().magic || !stream.number(words.version)) return false;
  Fingerprint& session_fingerprint = words.session_fingerprint;
  return !words.is_of_this_version() ||
         stream.numbers(session_fingerprint.self_test, session_fingerprint.scene,
                        session_fingerprint.keys, words.until, words.window);
}

/// A refused rank, and the reason.
struct RefusedRank {
  std::uint32_t number = 0;
  RefusalKind kind = RefusalKind::other;
  std::string reason;
};

std::vector<std::uint8_t> spoken(const RankWords& words);
/// The ranks that cannot play with the first one, by the data of all, one after the other.
std::vector<RefusedRank> refused_ranks(std::span<const std::uint8_t> all);

/// Calls that wait throw SessionError when a rank is silent for too long, or a user interrupts this
/// one.
class RankMail final : public peer::Mail {
 public:
  /// `wait` is called between two looks, with the number of consecutive looks that found nothing.
  RankMail(rti::Ranks& ranks, double patience_s, double (*now_s)(),
           void (*wait)(std::uint32_t looks));

  /// Checks that all ranks can play `terms` together with the same fingerprint. Throws SessionError
  /// at all if not; the first one names the others' ranks.
  void agree(const Fingerprint& session_fingerprint, const Terms& terms);

  peer::PeerNumber number() const { return ranks_.number(); }
  const Terms& terms() const { return terms_; }
  std::uint64_t bytes_sent() const { return bytes_sent_; }
  std::uint64_t dismissed() const { return 0; }  ///< there are no other connections
  std::uint64_t collectives() const { return collectives_; }

  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override;
  std::vector<std::vector<std::uint8_t>> share(peer::PeerNumber own, peer::PeerNumber peer_count,
                                               std::vector<std::uint8_t> bytes) override;
  /// Waits until all bytes are sent.
  void flush();

 private:
  std::span<const std::uint8_t> gather(std::span<const std::uint8_t> own);
  void await(const std::string& what, const std::function<bool()>& is_there);

  rti::Ranks& ranks_;
  double patience_s_;
  double (*now_s_)();
  void (*wait_)(std::uint32_t looks);
  Terms terms_;
  std::uint64_t bytes_sent_ = 0, collectives_ = 0;
};

}  // namespace rink::game
