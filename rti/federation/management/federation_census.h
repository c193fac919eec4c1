// Counts of a federation execution that are computed when a report asks for them.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/central_component.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/time/time_service.h"
#include "rti/management/federation_report.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

class FederationCensus {
 public:
  FederationCensus(const FederationBasis& basis, const DataDistribution& distribution,
                   const Ownership& ownership, const TimeService& time)
      : basis_(basis), distribution_(distribution), ownership_(ownership), time_(time) {}

  /// A report of all joined federates, in the order of slots; with the outlet's queues if there is
  /// one. How long each has been silent is left open.
  FederationReport report(const Outlet* outlet) const;

 private:
  FederateReport report_of(std::uint32_t slot, const Outlet* outlet) const;
  void report_time(std::uint32_t slot, FederateCounts& counts) const;
  std::vector<std::uint32_t> count_owned() const;
  void count_owners(ObjectSlot object, std::vector<std::uint32_t>& owned) const;

  FederationBasis basis_;
  const DataDistribution& distribution_;
  const Ownership& ownership_;
  const TimeService& time_;
};

}  // namespace rink::rti
