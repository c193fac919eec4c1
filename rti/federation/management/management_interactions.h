// The interactions of the management object model: federates' adjustments and requests, and the
// RTI's reports (IEEE 1516.1-2010, clause 11).
#pragma once

#include <cstdint>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/management/management_objects.h"
#include "rti/federation/services/interactions.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/services/synchronization.h"
#include "rti/federation/services/update_requests.h"
#include "rti/federation/status.h"
#include "rti/management/management_handles.h"

namespace rink::rti {

class ManagementInteractions {
 public:
  struct Uses {
    const DataDistribution& distribution;
    const Publications& publications;
    const Synchronization& synchronization;
    Interactions& interactions;
    UpdateRequests& requests;
    ManagementObjects& objects;
  };
  ManagementInteractions(const FederationBasis& basis, const Uses& uses,
                         const ManagementHandles& handles)
      : basis_(basis), uses_(uses), handles_(handles) {}

  /// Handles an interaction whose receiver is the RTI; others may subscribe to it too.
  Status take(std::uint32_t slot, const InteractionMessage& message);

 private:
  template <class SetOf, class Write>
  void report_classes(std::uint32_t asking, std::uint32_t about, InteractionClassHandle report,
                      SetOf set_of, Write write);
  template <class IsNamed>
  void report_interactions(std::uint32_t asking, std::uint32_t about, InteractionClassHandle report,
                           IsNamed is_named);
  void report_publications(std::uint32_t asking, std::uint32_t about);
  void report_subscriptions(std::uint32_t asking, std::uint32_t about);
  void report_points(std::uint32_t asking);

  FederationBasis basis_;
  Uses uses_;
  ManagementHandles handles_;
};

}  // namespace rink::rti
