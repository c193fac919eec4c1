// The server's decisions about the thing that a watcher points at.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "game/net/client/interest_questions.h"

namespace rink::game {

/// Asks ten times a second while a thing is inspected, and shows the answer as long.
class InspectedInterest {
 public:
  static constexpr double question_period = 0.1;  ///< s

  /// Inspects the thing until the next show().
  void inspect(std::uint32_t thing) { wanted_ = thing; }
  /// Replaces `seen` by a newer answer, or by nothing if nothing is inspected; asks again at real
  /// time `now_s` if `may_be_asked`.
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
