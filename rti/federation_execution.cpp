// Forwards each call of `FederationExecution` to its parts.
#include "rti/federation_execution.h"

#include <cassert>
#include <stdexcept>
#include <string>
#include <utility>

#include "rti/federation/federation_parts.h"
#include "rti/save/kept_federation.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

namespace {

std::unique_ptr<im::Filter> filter_called(const FederationSettings& settings) {
  if (const auto complaint = im::complaint_about(settings.filter, settings.filter_settings))
    throw std::invalid_argument("filter '" + settings.filter + "': " + *complaint);
  require_valid(settings.update_rate);
  auto filter = im::make_filter(settings.filter, settings.filter_settings);
  filter->share_with(settings.match_worker);
  return filter;
}

}  // namespace

FederationExecution::FederationExecution(const Fom& fom, const FederationSettings& settings,
                                         const FederationServices& services)
    : parts_(make(fom, settings, services)) {}
FederationExecution::~FederationExecution() = default;

/// The parts that a save brings back are made like the first, and can be saved again.
std::unique_ptr<FederationParts> FederationExecution::make(const Fom& fom,
                                                           const FederationSettings& settings,
                                                           const FederationServices& services) {
  auto parts = std::make_unique<FederationParts>(fom, settings, services, filter_called(settings));
  FederationParts& made = *parts;
  parts->saves.keep_by([&made](std::vector<std::byte>& state) { return write_state(made, state); },
                       [this, &made, services](const SavedFederation& saved) {
                         prepared_ = make(made.ground.fom, made.ground.settings, services);
                         prepared_->ground.now = made.ground.now;
                         return read_state(*prepared_, saved.state) &&
                                are_those_of(*prepared_, saved.federates);
                       });
  return parts;
}

void FederationExecution::connect(ConnectionId connection) {
  parts_->connections.connect(connection);
}
void FederationExecution::receive(ConnectionId connection, Bytes bytes) {
  parts_->connections.receive(connection, bytes);
}
void FederationExecution::receive_datagram(ConnectionId connection, Bytes datagram) {
  parts_->connections.receive_datagram(connection, datagram);
}
void FederationExecution::disconnect(ConnectionId connection, std::string_view) {
  parts_->connections.disconnect(connection);
}
std::optional<ConnectionId> FederationExecution::oldest_stranger(const ConnectionTest& test) const {
  return parts_->connections.oldest_stranger(test);
}
void FederationExecution::advance_clock(double now, bool is_behind) {
  parts_->advance_clock(now, is_behind);
}

void FederationExecution::match() { parts_->match(); }

void FederationExecution::set_object_role(ObjectHandle object, const im::Role& role) {
  const ObjectSlot slot = parts_->ground.objects.find(object);
  if (slot != no_object) parts_->ground.distribution->set_role(slot, role);
}

void FederationExecution::set_federate_role(FederateHandle federate, const im::Role& role) {
  if (const auto slot = parts_->ground.federates.joined(federate))
    parts_->ground.distribution->set_federate_role(*slot, role);
}

void FederationExecution::set_federate_heading(FederateHandle federate,
                                               const im::Heading& heading) {
  if (const auto slot = parts_->ground.federates.joined(federate))
    parts_->ground.distribution->set_federate_heading(*slot, heading);
}

void FederationExecution::set_object_flight(ObjectHandle object, const im::Flight& flight) {
  const ObjectSlot slot = parts_->ground.objects.find(object);
  if (slot != no_object) parts_->ground.distribution->set_flight(slot, flight);
}

void FederationExecution::set_object_facts(ObjectHandle object, const im::Facts& facts) {
  const ObjectSlot slot = parts_->ground.objects.find(object);
  if (slot != no_object) parts_->ground.distribution->set_facts(slot, facts);
}

void FederationExecution::set_federate_facts(FederateHandle federate, const im::Facts& facts) {
  if (const auto slot = parts_->ground.federates.joined(federate))
    parts_->ground.distribution->set_federate_facts(*slot, facts);
}

void FederationExecution::set_time(double now) { parts_->ground.distribution->set_time(now); }

/// A restored federation begins between two ticks, so that nobody is in the midst of the former.
void FederationExecution::flush(Outlet& outlet) {
  if (parts_->saves.is_restored()) {
    prepared_->take_over(*parts_);
    parts_ = std::move(prepared_);
  }
  parts_->flush(outlet);
  if (parts_->ground.save_phase != SavePhase::restoring) prepared_.reset();
}
FederationReport FederationExecution::report(const Outlet* outlet) const {
  return parts_->connections.report(outlet);
}
const std::string& FederationExecution::name() const { return parts_->ground.settings.federation; }
const Fom& FederationExecution::fom() const { return parts_->ground.fom; }
std::size_t FederationExecution::federate_count() const {
  return parts_->ground.federates.joined_count();
}
std::size_t FederationExecution::object_count() const { return parts_->ground.objects.size(); }
const FederationCounters& FederationExecution::counters() const { return parts_->ground.counters; }
const BaselineCounters& FederationExecution::baseline_counters() const {
  return parts_->periodic.counters();
}
const im::Filter& FederationExecution::filter() const {
  return parts_->ground.distribution->filter();
}
const DataDistribution& FederationExecution::distribution() const {
  return *parts_->ground.distribution;
}

bool FederationExecution::is_in_scope(FederateHandle federate, ObjectHandle object) const {
  const ObjectSlot slot = parts_->ground.objects.find(object);
  const auto federate_slot = parts_->ground.federates.joined(federate);
  return slot != no_object && federate_slot &&
         parts_->ground.distribution->of(*federate_slot).in_scope.contains(slot);
}

void FederationExecution::list_scope(FederateHandle federate,
                                     std::vector<ObjectHandle>& objects) const {
  const auto federate_slot = parts_->ground.federates.joined(federate);
  if (!federate_slot) return;
  parts_->ground.distribution->of(*federate_slot).in_scope.for_each([&](ObjectSlot slot) {
    objects.push_back(parts_->ground.objects[slot].handle);
  });
}

void FederationExecution::send_host_message(FederateHandle federate, Bytes content) {
  assert(content.size() <= HostMessage::size_max);
  if (const auto slot = parts_->ground.federates.joined(federate))
    parts_->ground.federates[*slot].outbox.after_updates(HostMessage{content});
}

void FederationExecution::set_update_rate(FederateHandle federate, UpdateRate rate) {
  require_valid(rate);
  if (const auto slot = parts_->ground.federates.joined(federate))
    parts_->set_update_rate(*slot, rate);
}

void FederationExecution::send_at_once(FederateHandle federate, ObjectHandle object,
                                       AttributeSet attributes) {
  const auto slot = parts_->ground.federates.joined(federate);
  const ObjectSlot object_slot = parts_->ground.objects.find(object);
  if (slot && object_slot != no_object)
    parts_->rates.send_at_once(*slot, object_slot, object, attributes);
}

bool FederationExecution::take_notice(FederateHandle federate) {
  const auto slot = parts_->ground.federates.joined(federate);
  return slot && std::exchange(parts_->ground.federates[*slot].has_notice, false);
}

void FederationExecution::serve_by_host(FederateHandle federate, ObjectClassHandle object_class) {
  const auto slot = parts_->ground.federates.joined(federate);
  if (!slot) return;
  FederateInterest& interest = parts_->ground.distribution->of(*slot);
  const std::uint16_t former = interest.host_served;
  interest.host_served =
      object_class ? static_cast<std::uint16_t>(object_class.value) : FederateInterest::no_class;
  if (former == interest.host_served) return;
  interest.holds_static.clear();  // it may have dropped what it was told before
  interest.holds_former.clear();
  const ObjectTable& objects = parts_->ground.objects;
  interest.in_scope.for_each([&](ObjectSlot each) {
    if (objects[each].object_class == interest.host_served) interest.unannounced.erase(each);
    if (objects[each].object_class != former) return;
    interest.unannounced.insert(each);
    interest.has_unannounced = true;
    interest.needs_full_state.insert(each);
    interest.needs_any_full_state = true;
  });
}

std::uint64_t FederationExecution::times_updated(FederateHandle federate) const {
  const auto slot = parts_->ground.federates.joined(federate);
  return slot ? parts_->ground.federates[*slot].times_updated : 0;
}

const Bitmap* FederationExecution::scope(FederateHandle federate) const {
  const auto slot = parts_->ground.federates.joined(federate);
  return slot ? &parts_->ground.distribution->of(*slot).in_scope : nullptr;
}

ObjectSlot FederationExecution::slot_of(ObjectHandle object) const {
  return parts_->ground.objects.find(object);
}

void FederationExecution::list_subscribers(ObjectClassHandle object_class,
                                           AttributeHandle attribute,
                                           std::vector<FederateHandle>& federates) const {
  const DataDistribution& distribution = *parts_->ground.distribution;
  for (std::uint32_t slot = 0; slot < parts_->ground.federates.size(); ++slot)
    if (parts_->ground.federates[slot].is_joined &&
        distribution.subscribed_anywhere(slot, static_cast<std::uint16_t>(object_class.value))
            .subscribed.contains(attribute))
      federates.push_back(parts_->ground.federates[slot].handle);
}

void FederationExecution::list_subscribed_regions(std::vector<SubscribedRegion>& regions) const {
  std::vector<RegionOfInterest> found;
  parts_->ground.distribution->list_regions_of_interest(found);
  for (const RegionOfInterest& each : found)
    regions.push_back({parts_->ground.federates[each.federate].handle, each.bounds});
}

}  // namespace rink::rti
