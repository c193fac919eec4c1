// What the referee of a match has said beside the rounds, numbered, so that those that are left
// know what some of them have not heard of one that is lost.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "game/node/match/match_words.h"
#include "game/node/seat_table.h"
#include "game/peer/messages.h"

namespace rink::game {

/// Words are counted from 1, whoever is the referee.
template <class Word>
struct Numbered {
  std::uint64_t number = 0;
  Word word{};
};

template <class Stream, class Word>
bool exchange(Stream& stream, Numbered<Word>& numbered) {
  return stream.number(numbered.number) && exchange(stream, numbered.word);
}

/// The last words, up to number `count`.
struct RefereeWords {
  std::uint64_t count = 0;
  std::vector<Numbered<SeatDecision>> decisions{};
  Numbered<MatchNews> news{};  ///< the last, if its number is not 0
};

template <class Stream>
bool exchange(Stream& stream, RefereeWords& words) {
  return stream.number(words.count) && peer::exchange_list(stream, words.decisions) &&
         exchange(stream, words.news);
}

/// Nobody is more than a round behind another, so decisions are kept for two rounds.
class RefereeLog {
 public:
  /// The number of the next word, which the referee says now.
  std::uint64_t next() const { return words_.count + 1; }
  /// True if the word has been heard already. One that leaves a gap is nobody's: see may_follow.
  bool has(std::uint64_t number) const { return number <= words_.count; }
  bool may_follow(std::uint64_t number) const { return number == words_.count + 1; }

  void note(std::uint64_t number, const std::vector<SeatDecision>& decisions) {
    assert(may_follow(number));
    words_.count = number;
    for (const SeatDecision& decision : decisions) words_.decisions.push_back({number, decision});
  }
  void note(std::uint64_t number, const MatchNews& news) {
    assert(may_follow(number));
    words_.count = number;
    words_.news = {number, news};
  }
  /// Of several words that another has heard; then adopt() its count.
  void add(const Numbered<SeatDecision>& decision) { words_.decisions.push_back(decision); }
  void add(const Numbered<MatchNews>& news) { words_.news = news; }
  void adopt(std::uint64_t count) { words_.count = std::max(words_.count, count); }
  /// A round is over.
  void finish_round() {
    std::erase_if(words_.decisions,
                  [this](const Numbered<SeatDecision>& each) { return each.number <= before_; });
    before_ = now_, now_ = words_.count;
  }
  const RefereeWords& words() const { return words_; }

 private:
  RefereeWords words_;
  std::uint64_t before_ = 0, now_ = 0;  ///< counts at the ends of the last two rounds
};

}  // namespace rink::game
