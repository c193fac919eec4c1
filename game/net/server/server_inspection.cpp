// The part of a server that who watches may ask what interest management decided; no tick of it
// costs anything before somebody asks.
#include <algorithm>

#include "game/net/interest_codec.h"
#include "game/net/server/server.h"

namespace rink::game {

void Server::note_inspection(rti::FederateHandle sender, rti::Bytes parameters) {
  Inspection wanted;
  if (flow_ || seat_of(sender) != nullptr || !decode(parameters, wanted)) return;
  const auto earlier = std::ranges::find(inspections_, sender, &Inspecting::federate);
  if (earlier != inspections_.end()) earlier->object = rti::ObjectHandle{wanted.object};
  else inspections_.push_back({sender, rti::ObjectHandle{wanted.object}});
}

void Server::tell_interest(rti::FederateHandle federate, InterestSeen seen) {
  std::vector<std::byte> bytes;
  rti::Writer writer(bytes);
  exchange(writer, seen);
  ambassador_.send_directed_interaction(model_.interest, federate, bytes,
                                        {.time = game_.now(), .tag = 0});
  ++counters_.inspections_answered;
}

rti::ObjectHandle Server::bat_of(rti::FederateHandle federate) const {
  if (federate.value >= seats_.size() || !seats_[federate.value]) return {};
  const std::optional<EntityId> bat = game_.bat(seats_[federate.value]->player);
  return bat ? publisher_->object(*bat) : rti::ObjectHandle{};
}

}  // namespace rink::game
