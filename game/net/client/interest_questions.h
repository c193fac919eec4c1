// A watcher's questions to the server's interest management, and the answers.
#pragma once

#include <optional>
#include <utility>

#include "game/match/interest_seen.h"
#include "game/replication/object_model.h"
#include "rti/ambassador.h"
#include "rti/wire/bytes.h"

namespace rink::game {

class InterestQuestions {
 public:
  /// Declares questions and answers. Both must outlive this.
  InterestQuestions(rti::Ambassador& ambassador, const ObjectModel& model);

  /// Asks for the server's decisions about `object`.
  void ask(rti::ObjectHandle object);
  /// Receives an answer; a malformed one is dropped.
  void receive(rti::Bytes answer);
  /// Returns the newest answer, once.
  std::optional<InterestSeen> take() { return std::exchange(answer_, std::nullopt); }

 private:
  rti::Ambassador& ambassador_;
  const ObjectModel& model_;
  std::optional<InterestSeen> answer_;
};

}  // namespace rink::game
