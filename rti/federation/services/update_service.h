// Updates that federates send by their streams: checked once, here, then stored.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rti/baselines/residual_states.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/arrival_orders.h"
#include "rti/federation/delivery/best_effort_sender.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/status.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

class UpdateService {
 public:
  struct Uses {
    const Ownership& ownership;
    const Publications& publications;
    KnownObjects& known;
    NewestStamps& newest;
    ArrivalOrders& arrivals;
    BestEffortSender& sender;
    ResidualStates& residuals;
    DataDistribution& distribution;
  };
  UpdateService(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  Status handle_stamp(std::uint32_t slot, Reader& reader);
  Status handle_updates(std::uint32_t slot, Reader& reader);
  /// The sender keeps newer values back, since nobody subscribed when it was last advised.
  Status handle_spare(std::uint32_t slot, Reader& reader);
  /// Stores values that were checked, by whichever channel they came.
  void store(std::uint32_t slot, ObjectSlot object, AttributeSet attributes, const Stamp& stamp,
             Bytes values);
  /// A stamp holds for its frame only.
  void begin_frame(std::uint32_t slot) { stamps_[slot].reset(); }
  void joined(std::uint32_t slot);

 private:
  Status take(std::uint32_t slot, const UpdatesMessage& message, ObjectHandle handle, Bytes values);

  FederationBasis basis_;
  Uses uses_;
  std::vector<std::optional<Stamp>> stamps_;  ///< by slot: of the updates in the present frame,
                                              ///< once received
};

}  // namespace rink::rti
