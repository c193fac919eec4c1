// What who only watches asks of the server's interest management, and what it answers.
#pragma once

#include <optional>
#include <utility>

#include "game/match/interest_seen.h"
#include "game/replication/object_model.h"
#include "rti/ambassador.h"

namespace rink::game {

class InterestQuestions {
 public:
  /// Declares questions and answers. Both must outlive this.
  InterestQuestions(rti::Ambassador& ambassador, const ObjectModel& model);

  /// Asks what the server's filter decides of `object`.
  void ask(rti::ObjectHandle object);
  /// An answer as it came; what is none is not kept.
  void receive(rti::Bytes answer);
  /// The newest answer; given once.
  std::optional<InterestSeen> take() { return std::exchange(answer_, std::nullopt); }

 private:
  rti::Ambassador& ambassador_;
  const ObjectModel& model_;
  std::optional<InterestSeen> answer_;
};

}  // namespace rink::game
