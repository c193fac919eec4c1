// The management service: a federation execution counts little and works out the rest when it is
// asked.
#include "rti/federation/federation_parts.h"
#include "rti/federation_execution.h"
#include "rti/wire/management_messages.h"

namespace rink::rti {

FederationReport FederationExecution::report(const Outlet* outlet) const {
  return parts_->report(outlet);
}

FederationReport FederationParts::report(const Outlet* outlet) const {
  FederationReport report;
  report.federation = settings_.federation;
  report.model = fom_.name();
  report.filter = settings_.filter;
  report.objects = static_cast<std::uint32_t>(objects_.size());
  static_assert(violation_count <= FederationReport::drop_count_max);
  std::copy(counters_.drops.begin(), counters_.drops.end(), report.drops.begin());
  const std::vector<std::uint32_t> owned = count_owned();
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    const Federate& federate = federates_[slot];
    if (!federate.is_joined) continue;
    FederateReport& each = report.federates.emplace_back(
        FederateReport{federate.handle, federate.name, federate.type, federate.counts});
    each.counts.objects_owned = owned[slot];
    interest_.of(slot).in_scope.for_each([&](ObjectSlot) { ++each.counts.objects_in_scope; });
    each.counts.queue_bytes = outlet != nullptr ? outlet->waiting_bytes(federate.connection) : 0;
    if (time_.management() != nullptr) tell_time(slot, each.counts);
    each.counts.silence_s = now_ - connections_[federate.connection].last_heard;
  }
  return report;
}

void FederationParts::tell_time(std::uint32_t slot, FederateCounts& counts) const {
  const TimeManagement& management = *time_.management();
  counts.is_time_regulating = management.is_regulating(slot);
  counts.is_time_constrained = management.is_constrained(slot);
  if (counts.is_time_regulating != 0 || counts.is_time_constrained != 0)
    counts.logical_time = management.time(slot);
  if (counts.is_time_regulating != 0) counts.earliest_stamp = management.earliest(slot);
}

/// By federate slot: objects of which it owns at least one attribute.
std::vector<std::uint32_t> FederationParts::count_owned() const {
  std::vector<std::uint32_t> owned(federates_.size(), 0);
  for (ObjectSlot slot = 0; slot < objects_.slot_count(); ++slot) {
    const Object& object = objects_[slot];
    if (!object.is_alive) continue;
    if (object.owner < owned.size()) {
      ++owned[object.owner];
      continue;
    }
    std::vector<bool> is_counted(federates_.size(), false);
    for (std::uint32_t i = 0; i < fom_.at(ObjectClassHandle{object.object_class}).attributes.size();
         ++i) {
      const std::uint32_t owner = ownership_.owner_of(slot, {i});
      if (owner >= owned.size() || is_counted[owner]) continue;
      is_counted[owner] = true;
      ++owned[owner];
    }
  }
  return owned;
}

/// By federate slot: objects that it may delete.
std::vector<std::uint32_t> FederationParts::count_deletable() const {
  std::vector<std::uint32_t> deletable(federates_.size(), 0);
  for (ObjectSlot slot = 0; slot < objects_.slot_count(); ++slot) {
    if (!objects_[slot].is_alive) continue;
    const std::uint32_t owner = ownership_.owner_of(slot, privilege_to_delete_object);
    if (owner < deletable.size()) ++deletable[owner];
  }
  return deletable;
}

/// One report serves all who asked since the last flush.
void FederationParts::answer_queries(Outlet& outlet) {
  if (management_queries_.empty()) return;
  const FederationReport whole = report(&outlet);
  for (const ConnectionId id : management_queries_) {
    if (id >= connections_.size() || connections_[id].phase == Phase::unknown) continue;
    FrameWriter frame(frame_max_to_federate);
    const auto append = [&frame](auto message) {
      write(frame.begin_message(measure(message)), message);
      frame.appended();
    };
    for_each_message(whole, append);
    append(ReportEndMessage{});
    const Bytes bytes = frame.bytes();
    if (connections_[id].phase != Phase::joined) {
      outlet.send(id, std::span(&bytes, 1));
      continue;
    }
    std::vector<std::byte>& head = federates_[connections_[id].federate].outbox.head();
    head.insert(head.end(), bytes.begin() + frame_header_size, bytes.end());
  }
  management_queries_.clear();
}

}  // namespace rink::rti
