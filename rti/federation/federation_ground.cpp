// Makes the RTI's own parts where the user gives none.
#include "rti/federation/federation_ground.h"

#include <utility>

#include "rti/buffering/newest_state.h"
#include "rti/distribution/interest.h"
#include "rti/groups/member_lists.h"

namespace rink::rti {

namespace {

std::unique_ptr<GroupCommunication> groups_of(const FederationServices& services) {
  if (services.group_communication) return services.group_communication();
  return std::make_unique<MemberLists>();
}

std::unique_ptr<Buffering> buffering_of(const FederationServices& services) {
  if (services.buffering) return services.buffering();
  return std::make_unique<NewestState>();
}

}  // namespace

FederationGround::FederationGround(const Fom& model, const FederationSettings& wanted,
                                   const FederationServices& services,
                                   std::unique_ptr<im::Filter> filter)
    : fom(model),
      settings(wanted),
      objects(model),
      ownership(model, objects),
      distribution(services.data_distribution
                       ? services.data_distribution(model, objects, ownership, std::move(filter))
                       : std::make_unique<Interest>(model, objects, ownership, std::move(filter),
                                                    settings.newcomer_pairs_per_match_max)),
      buffering(buffering_of(services)),
      groups(groups_of(services)) {}

}  // namespace rink::rti
