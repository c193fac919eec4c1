// The services that take objects and their values from federates, each above those that it uses.
#pragma once

#include <cstdint>

#include "rti/baselines/residual_states.h"
#include "rti/federation/delivery/arrival_orders.h"
#include "rti/federation/delivery/best_effort_receiver.h"
#include "rti/federation/delivery/best_effort_sender.h"
#include "rti/federation/federation_ground.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/object_names.h"
#include "rti/federation/services/object_service.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/services/transportation_types.h"
#include "rti/federation/services/update_requests.h"
#include "rti/federation/services/update_service.h"

namespace rink::rti {

struct ObjectServices {
  explicit ObjectServices(FederationGround& ground)
      : publications(ground.fom),
        names(ground.federates, 2 * std::size_t{ground.settings.object_max}),
        known(ground.objects, ground.ownership, *ground.distribution, ground.counters),
        newest(ground.objects, ground.ownership),
        arrivals(ground.fom),
        types(ground.basis(), ground.ownership, publications, known),
        residuals(ground.fom),
        sender(ground.basis(), types, *ground.buffering),
        updates(ground.basis(), {ground.ownership, publications, known, newest, arrivals, sender,
                                 residuals, *ground.distribution}),
        receiver(ground.basis(),
                 {types, ground.ownership, known, newest, arrivals, sender, updates}),
        objects(ground.basis(), {ground.ownership, *ground.distribution, publications, known, names,
                                 newest, arrivals, types}),
        requests(ground.basis(), ground.ownership, *ground.distribution, known) {}
  ObjectServices(const ObjectServices&) = delete;
  ObjectServices& operator=(const ObjectServices&) = delete;

  void joined(std::uint32_t slot) {
    publications.joined(slot);
    newest.joined(slot);
    arrivals.joined(slot);
    types.joined(slot);
    updates.joined(slot);
    receiver.joined(slot);
    objects.joined(slot);
    requests.joined(slot);
  }
  /// Steps of a federate's leaving that no other federate notices; names, requests and objects come
  /// before, each in its place.
  void left(std::uint32_t slot) {
    publications.left(slot);
    newest.left(slot);
    arrivals.left(slot);
    types.left(slot);
    receiver.left(slot);
  }

  Publications publications;
  ObjectNames names;
  KnownObjects known;
  NewestStamps newest;
  ArrivalOrders arrivals;
  TransportationTypes types;
  ResidualStates residuals;
  BestEffortSender sender;
  UpdateService updates;
  BestEffortReceiver receiver;
  ObjectService objects;
  UpdateRequests requests;
};

}  // namespace rink::rti
