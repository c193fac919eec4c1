// Compares the data of ranks, and gives out bats.
#include "game/net/peer/ranks/rank_words.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <sstream>
#include <utility>

#include "game/net/peer/network/difference.h"
#include "game/peer/protocol.h"

namespace rink::game {

namespace {

/// A collective has places of equal size.
static_assert(rank_words == 1 + peer::Mail::shared_max);

std::string text_of(const RankWords& words) {
  std::ostringstream text;
  text << words.until << " s in windows of " << words.window << " s";
  return text.str();
}

std::optional<std::string> other_terms(const RankWords& theirs, const RankWords& ours) {
  if (theirs.until != ours.until || theirs.window != ours.window)
    return "it is to play " + text_of(theirs) + ", here it is " + text_of(ours);
  if (theirs.balance_windows != ours.balance_windows)
    return "its --balance is " + std::to_string(theirs.balance_windows) + ", here it is " +
           std::to_string(ours.balance_windows);
  return std::nullopt;
}

std::optional<RefusedRank> refused(const std::optional<RankWords>& theirs, const RankWords& ours) {
  if (!theirs) return RefusedRank{.reason = "its data are none of a rank of Rink"};
  if (!theirs->is_of_this_version())
    return RefusedRank{.kind = RefusalKind::wrong_version,
                       .reason = other_version(theirs->version)};
  if (const auto reason = difference(theirs->session_fingerprint, ours.session_fingerprint))
    return RefusedRank{.reason = *reason};
  if (const auto reason = other_terms(*theirs, ours)) return RefusedRank{.reason = *reason};
  return std::nullopt;
}

std::vector<std::optional<RankWords>> words_of_all(std::span<const std::uint8_t> all) {
  std::vector<std::optional<RankWords>> words;
  for (; all.size() >= rank_words; all = all.subspan(rank_words))
    words.push_back(all[0] < rank_words ? message_from<RankWords>(out_of_its_place(all))
                                        : std::nullopt);
  return words;
}

}  // namespace

std::vector<std::uint8_t> in_its_place(std::span<const std::uint8_t> content) {
  assert(content.size() < rank_words);
  std::vector<std::uint8_t> place(rank_words, 0);
  place[0] = static_cast<std::uint8_t>(content.size());
  std::copy(content.begin(), content.end(), place.begin() + 1);
  return place;
}

std::span<const std::uint8_t> out_of_its_place(std::span<const std::uint8_t> place) {
  assert(place.size() >= rank_words);
  return place.subspan(1, std::min<std::size_t>(place[0], rank_words - 1));
}

std::vector<std::uint8_t> spoken(const RankWords& words) { return in_its_place(bytes_of(words)); }

/// If the first rank's data are malformed, ranks that differ from this version are named.
std::vector<RefusedRank> refused_ranks(std::span<const std::uint8_t> all, std::uint32_t bats) {
  const std::vector<std::optional<RankWords>> words = words_of_all(all);
  const RankWords first = words.empty() ? RankWords() : words.front().value_or(RankWords());
  std::vector<RefusedRank> refused_ones;
  std::uint32_t free = bats;
  for (std::uint32_t number = 0; number < words.size(); ++number) {
    std::optional<RefusedRank> one = refused(words[number], first);
    if (!one && words[number]->info.bat_count > free)
      one = RefusedRank{.reason = too_few_bats(words[number]->info.bat_count, bats, free)};
    if (one) one->number = number, refused_ones.push_back(std::move(*one));
    else free -= words[number]->info.bat_count;
  }
  return refused_ones;
}

std::vector<PeerInfo> seated_ranks(std::span<const std::uint8_t> all) {
  std::vector<PeerInfo> infos;
  std::uint32_t first_bat = 0;
  for (const std::optional<RankWords>& words : words_of_all(all)) {
    assert(words);
    infos.push_back(words->info);
    infos.back().first_bat = std::exchange(first_bat, first_bat + words->info.bat_count);
  }
  return infos;
}

}  // namespace rink::game
