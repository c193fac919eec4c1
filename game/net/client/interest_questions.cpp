// Only watchers publish questions: players may see only what their filter lets through.
#include "game/net/client/interest_questions.h"

#include <vector>

#include "game/net/interest_codec.h"
#include "game/replication/attributes.h"

namespace rink::game {

InterestQuestions::InterestQuestions(rti::Ambassador& ambassador, const ObjectModel& model)
    : ambassador_(ambassador), model_(model) {
  ambassador.publish_interaction_class(model.inspect);
  ambassador.subscribe_interaction_class(model.interest);
}

void InterestQuestions::ask(rti::ObjectHandle object) {
  const Inspection inspection{object.value};
  std::vector<std::byte> bytes;
  ambassador_.send_interaction(model_.inspect, encode(bytes, inspection), {});
}

void InterestQuestions::receive(rti::Bytes answer) {
  InterestSeen seen;
  if (decode(answer, seen)) answer_ = std::move(seen);
}

}  // namespace rink::game
