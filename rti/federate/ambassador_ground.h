// The state that an ambassador's services share: the stream, the gate before callbacks, and the
// records of classes, objects and ownership.
#pragma once

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/declared_classes.h"
#include "rti/federate/books/ownership_book.h"
#include "rti/federate/delivery/callback_gate.h"
#include "rti/federate/delivery/link_watch.h"
#include "rti/federate/delivery/postponed_messages.h"
#include "rti/federate/delivery/residual_reader.h"
#include "rti/federate/delivery/sent_updates.h"
#include "rti/federate/delivery/update_arrivals.h"

namespace rink::rti {

/// Each member sees only those above it.
struct AmbassadorGround {
  AmbassadorGround(const Fom& model, FederateAmbassador& callbacks, const Timeouts& timeouts,
                   CallbackModel callback_model)
      : fom(model),
        gate(callbacks, callback_model),
        frames(phase),
        watch(timeouts),
        regions(fom),
        classes(fom),
        sent(fom),
        arrivals(fom),
        ownership(basis(), objects, regions),
        residuals(basis(), objects, arrivals),
        postponed(fom) {}
  AmbassadorGround(const AmbassadorGround&) = delete;
  AmbassadorGround& operator=(const AmbassadorGround&) = delete;

  AmbassadorBasis basis() { return {fom, gate.callbacks(), phase, frames, counters}; }

  const Fom& fom;
  CallbackGate gate;
  JoinPhase phase;
  FrameOutbox frames;
  AmbassadorCounters counters;
  LinkWatch watch;
  ObjectBook objects;
  RegionBook regions;
  DeclaredClasses classes;
  SentUpdates sent;
  UpdateArrivals arrivals;
  OwnershipBook ownership;
  ResidualReader residuals;
  PostponedMessages postponed;
  FrameReader incoming;
};

}  // namespace rink::rti
