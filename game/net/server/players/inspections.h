// Watchers' questions about objects that are not answered yet.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "rti/types.h"

namespace rink::game {

/// At most one question of each federate, its newest, so that frequent questions cost no more.
class Inspections {
 public:
  struct Question {
    rti::FederateHandle federate;
    rti::ObjectHandle object;
  };

  void ask(rti::FederateHandle federate, rti::ObjectHandle object) {
    const auto earlier = std::ranges::find(questions_, federate, &Question::federate);
    if (earlier != questions_.end()) earlier->object = object;
    else questions_.push_back({federate, object});
  }
  /// Takes all questions, in the order in which their federates first asked.
  std::vector<Question> take() { return std::exchange(questions_, {}); }

 private:
  std::vector<Question> questions_;
};

}  // namespace rink::game
