// Counts objects and scopes one by one for a report.
#include "rti/federation/management/federation_census.h"

#include <algorithm>

namespace rink::rti {

FederationReport FederationCensus::report(const Outlet* outlet) const {
  FederationReport report;
  report.federation = basis_.settings.federation;
  report.model = basis_.fom.name();
  report.filter = basis_.settings.filter;
  report.objects = static_cast<std::uint32_t>(basis_.objects.size());
  static_assert(violation_count <= FederationReport::drop_count_max);
  std::ranges::copy(basis_.counters.drops, report.drops.begin());
  const std::vector<std::uint32_t> owned = count_owned();
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot) {
    if (!basis_.federates[slot].is_joined) continue;
    report.federates.push_back(report_of(slot, outlet));
    report.federates.back().counts.objects_owned = owned[slot];
  }
  return report;
}

FederateReport FederationCensus::report_of(std::uint32_t slot, const Outlet* outlet) const {
  const JoinedFederate& federate = basis_.federates[slot];
  FederateReport report{federate.handle, federate.name, federate.type, federate.counts};
  distribution_.of(slot).in_scope.for_each([&](ObjectSlot) { ++report.counts.objects_in_scope; });
  report.counts.queue_bytes = outlet != nullptr ? outlet->waiting_bytes(federate.connection) : 0;
  if (time_.management() != nullptr) report_time(slot, report.counts);
  return report;
}

void FederationCensus::report_time(std::uint32_t slot, FederateCounts& counts) const {
  const TimeManagement& management = *time_.management();
  counts.is_time_regulating = management.is_regulating(slot);
  counts.is_time_constrained = management.is_constrained(slot);
  if (counts.is_time_regulating != 0 || counts.is_time_constrained != 0)
    counts.logical_time = management.time(slot);
  if (counts.is_time_regulating != 0) counts.earliest_stamp = management.earliest(slot);
}

/// By federate slot, the objects of which the federate owns at least one attribute.
std::vector<std::uint32_t> FederationCensus::count_owned() const {
  std::vector<std::uint32_t> owned(basis_.federates.size(), 0);
  for (ObjectSlot object = 0; object < basis_.objects.slot_count(); ++object) {
    if (!basis_.objects[object].is_alive) continue;
    const std::uint32_t owner = basis_.objects[object].owner;
    if (owner < owned.size()) ++owned[owner];
    else count_owners(object, owned);
  }
  return owned;
}

void FederationCensus::count_owners(ObjectSlot object, std::vector<std::uint32_t>& owned) const {
  std::vector<bool> is_counted(owned.size(), false);
  const ObjectClassHandle object_class{basis_.objects[object].object_class};
  for (const AttributeHandle each : basis_.fom.attributes(object_class)) {
    const std::uint32_t owner = ownership_.owner_of(object, each);
    if (owner >= owned.size() || is_counted[owner]) continue;
    is_counted[owner] = true;
    ++owned[owner];
  }
}

}  // namespace rink::rti
