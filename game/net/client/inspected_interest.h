// What the server's interest management decides of the thing that somebody who watches points at.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "game/net/client/interest_questions.h"

namespace rink::game {

/// Asks ten times a second while there is something to ask, and shows the answer for as long.
class InspectedInterest {
 public:
  static constexpr double question_period = 0.1;  ///< s

  /// Until the next show().
  void inspect(std::uint32_t thing) { wanted_ = thing; }
  /// Replaces `seen` by a newer answer, or by nothing where nothing is inspected; asks again if
  /// that `may_be_asked` at real time `now_s`.
  void show(InterestQuestions& questions, bool may_be_asked, double now_s,
            std::optional<InterestSeen>& seen) {
    if (auto answer = questions.take(); answer && wanted_) seen = std::move(answer);
    const std::optional<std::uint32_t> wanted = std::exchange(wanted_, std::nullopt);
    if (!wanted) seen.reset();
    if (!wanted || !may_be_asked || now_s < asked_s_ + question_period) return;
    questions.ask(rti::ObjectHandle{*wanted});
    asked_s_ = now_s;
  }

 private:
  std::optional<std::uint32_t> wanted_;  ///< since the last show()
  double asked_s_ = 0.0;
};

}  // namespace rink::game
