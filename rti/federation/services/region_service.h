// Federates' messages about regions: checked once, here, then passed to the data distribution (IEEE
// 1516.1-2010, clause 9).
#pragma once

#include <cstdint>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/update_requests.h"
#include "rti/federation/status.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

class RegionService {
 public:
  struct Uses {
    DataDistribution& distribution;
    const Ownership& ownership;
    KnownObjects& known;
    UpdateRequests& requests;
  };
  RegionService(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  Status handle_create(std::uint32_t slot, Reader& reader);
  Status handle_create_over(std::uint32_t slot, Reader& reader);
  /// Ends the subscriptions with the region too.
  Status handle_delete(std::uint32_t slot, Reader& reader);
  Status handle_modify(std::uint32_t slot, Reader& reader);
  Status handle_modify_ranges(std::uint32_t slot, Reader& reader);
  Status handle_associate(std::uint32_t slot, Reader& reader);
  Status handle_associate_parts(std::uint32_t slot, Reader& reader);
  /// Handles a subscription, its end, or a request for updates.
  Status handle_class(std::uint32_t slot, Reader& reader);

 private:
  Status create(std::uint32_t slot, RegionHandle region, DimensionSet dimensions);
  void subscribe(std::uint32_t slot, const RegionalClassMessage& message, RegionHandle region,
                 AttributeSet attributes);

  FederationBasis basis_;
  Uses uses_;
  std::vector<Range> ranges_;  ///< of one region
};

}  // namespace rink::rti
