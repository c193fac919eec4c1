// Compares the data of ranks, and waits with a timeout.
#include "game/net/peer/network/rank_mail.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <sstream>
#include <utility>

#include "game/net/interrupt.h"
#include "game/net/peer/network/difference.h"

namespace rink::game {

namespace {

/// A collective has places of equal size.
constexpr std::size_t place_size = 1 + peer::Mail::shared_max;
static_assert(place_size == rank_words);

std::vector<std::uint8_t> in_its_place(std::span<const std::uint8_t> content) {
  assert(content.size() < place_size);
  std::vector<std::uint8_t> place(place_size, 0);
  place[0] = static_cast<std::uint8_t>(content.size());
  std::memcpy(place.data() + 1, content.data(), content.size());
  return place;
}

std::string text_of(double until, double window) {
  std::ostringstream text;
  text << until << " s in windows of " << window << " s";
  return text.str();
}

std::optional<RefusedRank> refused(const std::optional<RankWords>& theirs, const RankWords& ours) {
  if (!theirs) return RefusedRank{.reason = "its data are none of a rank of Rink"};
  if (!theirs->is_of_this_version())
    return RefusedRank{.kind = RefusalKind::wrong_version,
                       .reason = other_version(theirs->version)};
  if (const auto reason = difference(theirs->session_fingerprint, ours.session_fingerprint))
    return RefusedRank{.reason = *reason};
  if (theirs->until != ours.until || theirs->window != ours.window)
    return RefusedRank{.reason = "it is to play " + text_of(theirs->until, theirs->window) +
                                 ", here it is " + text_of(ours.until, ours.window)};
  return std::nullopt;
}

}  // namespace

std::vector<std::uint8_t> spoken(const RankWords& words) { return in_its_place(bytes_of(words)); }

/// If the first rank's data are malformed, ranks that differ from this version are named.
std::vector<RefusedRank> refused_ranks(std::span<const std::uint8_t> all) {
  std::vector<std::optional<RankWords>> words;
  for (; all.size() >= rank_words; all = all.subspan(rank_words)) {
    const std::size_t size = all[0];
    words.push_back(size < rank_words ? message_from<RankWords>(all.subspan(1, size))
                                      : std::nullopt);
  }
  const RankWords first = words.empty() ? RankWords() : words.front().value_or(RankWords());
  std::vector<RefusedRank> refused_ones;
  for (std::uint32_t number = 0; number < words.size(); ++number) {
    auto one = refused(words[number], first);
    if (one) one->number = number, refused_ones.push_back(std::move(*one));
  }
  return refused_ones;
}

RankMail::RankMail(rti::Ranks& ranks, double patience_s, double (*now_s)(),
                   void (*wait)(std::uint32_t))
    : ranks_(ranks), patience_s_(patience_s), now_s_(now_s), wait_(wait) {}

void RankMail::agree(const Fingerprint& session_fingerprint, const Terms& terms) {
  terms_ = terms;
  RankWords words;
  words.session_fingerprint = session_fingerprint, words.until = terms.until,
  words.window = terms.window;
  const std::vector<RefusedRank> refused = refused_ranks(gather(spoken(words)));
  if (refused.empty()) return;
  std::string text;
  for (const RefusedRank& rank : refused)
    text += (text.empty() ? "" : "; ") + ("rank " + std::to_string(rank.number)) +
            " cannot play with rank 0: " + rank.reason;
  const bool is_version = std::all_of(refused.begin(), refused.end(), [](const RefusedRank& rank) {
    return rank.kind == RefusalKind::wrong_version;
  });
  throw SessionError(is_version ? ExitStatus::wrong_version : ExitStatus::not_admitted, text);
}

void RankMail::await(const std::string& what, const std::function<bool()>& is_there) {
  const double give_up_s = now_s_() + patience_s_;
  for (std::uint32_t looks = 0; !is_there(); ++looks) {
    if (is_interrupted) throw SessionError(ExitStatus::interrupted, "interrupted");
    if (now_s_() > give_up_s)
      throw SessionError(ExitStatus::connection_lost,
                         what + " for " + std::to_string(static_cast<int>(patience_s_)) + " s");
    wait_(looks);
  }
}

std::span<const std::uint8_t> RankMail::gather(std::span<const std::uint8_t> own) {
  ++collectives_;
  ranks_.begin_gathering(own);
  std::optional<std::span<const std::uint8_t>> all;
  await("some rank has not sent its part of a collective",
        [&] { return (all = ranks_.gathered()).has_value(); });
  return *all;
}

void RankMail::send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  bytes_sent_ += bytes.size();
  ranks_.send(to, std::move(bytes));
}

std::vector<std::uint8_t> RankMail::receive(peer::PeerNumber from) {
  std::optional<std::vector<std::uint8_t>> bytes;
  await("rank " + std::to_string(from) + " was silent",
        [&] { return (bytes = ranks_.receive(from)).has_value(); });
  return std::move(*bytes);
}

/// Places have equal size, each with its length first. Bytes count as sent to each other rank,
/// however the collective carries them.
std::vector<std::vector<std::uint8_t>> RankMail::share(peer::PeerNumber,
                                                       peer::PeerNumber peer_count,
                                                       std::vector<std::uint8_t> bytes) {
  bytes_sent_ += bytes.size() * (peer_count - 1);
  const std::span<const std::uint8_t> received = gather(in_its_place(bytes));
  std::vector<std::vector<std::uint8_t>> all;
  for (peer::PeerNumber from = 0; from < peer_count; ++from) {
    const auto place = received.subspan(from * place_size, place_size);
    const auto part = place.subspan(1, std::min<std::size_t>(place[0], place_size - 1));
    all.emplace_back(part.begin(), part.end());
  }
  return all;
}

void RankMail::flush() {
  await("some rank has not taken what was sent to it", [&] { return ranks_.unsent() == 0; });
}

}  // namespace rink::game
