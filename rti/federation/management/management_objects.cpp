// Objects that are registered while a federate subscribes to them, and updated on request, when due
// and when their state changes.
#include "rti/federation/management/management_objects.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rink::rti {

bool ManagementObjects::is_any_subscribed() const {
  const auto is_subscribed = [&](ObjectClassHandle each) {
    return each && uses_.declarations.is_subscribed(each);
  };
  return is_subscribed(federation_class_) || is_subscribed(federate_class_);
}

bool ManagementObjects::receives(std::uint32_t slot) const {
  const auto receives = [&](ObjectClassHandle each) {
    return !uses_.distribution.subscribed_anywhere(slot, static_cast<std::uint16_t>(each.value))
                .subscribed.is_empty();
  };
  return receives(federation_class_) || receives(federate_class_);
}

ManagementObjects::ReportedObject& ManagementObjects::reported_of(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  return federates_[slot];
}

void ManagementObjects::subscribed(std::uint32_t slot) {
  const bool was_subscribed = std::exchange(is_subscribed_, is_any_subscribed());
  if (is_subscribed_ && !was_subscribed) begin();
  if (!is_subscribed_ && was_subscribed) end();
  if (!is_subscribed_ || !basis_.federates[slot].is_joined || !receives(slot)) return;
  federation_.is_due = true;
  for (ReportedObject& each : federates_) each.is_due = static_cast<bool>(each.object);
}

void ManagementObjects::timed(std::uint32_t slot, double period) {
  periods_[slot] = period;
  reported_of(slot).due_at = basis_.now + period;
}

void ManagementObjects::begin() {
  add(federation_, federation_class_);
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined) add(reported_of(slot), federate_class_);
}

void ManagementObjects::end() {
  remove(federation_);
  for (ReportedObject& each : federates_) remove(each);
}

void ManagementObjects::add(ReportedObject& reported, ObjectClassHandle object_class) {
  reported = {};
  if (!slot_ && basis_.federates.has_block()) slot_ = basis_.federates.add();
  if (slot_) reported.object = uses_.objects.register_own(*slot_, object_class);
  if (!reported.object) return;
  reported.is_due = true;
  if (&reported != &federation_)
    slots_[reported.object.value] = static_cast<std::uint32_t>(&reported - federates_.data());
}

void ManagementObjects::remove(ReportedObject& reported) {
  if (reported.object) uses_.objects.remove(basis_.objects.find(reported.object));
  slots_.erase(reported.object.value);
  reported = {};
}

void ManagementObjects::joined(std::uint32_t slot) {
  if (slot >= periods_.size()) periods_.resize(slot + 1);
  periods_[slot] = 0.0;
  if (!is_subscribed_) return;
  add(reported_of(slot), federate_class_);
  federation_.is_due = true;
}

void ManagementObjects::left(std::uint32_t slot) {
  if (!is_subscribed_) return;
  remove(reported_of(slot));
  federation_.is_due = true;
}

void ManagementObjects::ask(ObjectHandle object, AttributeSet attributes) {
  const auto slot = slots_.find(object.value);
  ReportedObject& reported = slot == slots_.end() ? federation_ : federates_[slot->second];
  if (reported.object == object) reported.asked = reported.asked | attributes;
}

void ManagementObjects::notify() {
  for (const UpdateRequests::Asked& each : uses_.requests.take_asked_of_rti())
    ask(each.object, each.attributes);
  if (!is_subscribed_) return;
  has_counted_ = false;
  if (federation_.object && (federation_.is_due || !federation_.asked.is_empty()))
    report_federation();
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    ReportedObject& reported = federates_[slot];
    if (!reported.object) continue;
    const double period = slot < periods_.size() ? periods_[slot] : 0.0;
    const bool is_time = period > 0.0 && basis_.now >= reported.due_at;
    if (is_time) reported.due_at = basis_.now + period;
    if (is_time || reported.is_due || !reported.asked.is_empty() ||
        reported.state != state_of(slot))
      report_federate(slot, reported);
  }
}

unsigned ManagementObjects::state_of(std::uint32_t slot) const {
  const TimeManagement* management = uses_.time.management();
  if (management == nullptr) return 0;
  return (management->is_constrained(slot) ? 1u : 0u) | (management->is_regulating(slot) ? 2u : 0u);
}

void ManagementObjects::begin_values(ObjectClassHandle object_class) {
  values_.clear();
  const ObjectClassHandle manager = basis_.fom.at(object_class).parent;
  ends_.assign(basis_.fom.at(manager).attributes.size(),
               0);  // attributes that a model adds to its root have no value here
}

template <class Write>
void ManagementObjects::value(Write write) {
  if (ends_.size() == privilege_to_delete_object.value) ends_.push_back(values_.size());
  write(ManagementWriter(values_));
  ends_.push_back(values_.size());
}

/// In the order of the class's attributes (management_classes.cpp).
void ManagementObjects::report_federation() {
  std::vector<std::uint32_t> joined;
  for (const JoinedFederate& each : basis_.federates)
    if (each.is_joined) joined.push_back(each.handle.value);
  begin_values(federation_class_);
  value([&](ManagementWriter to) { to.text(basis_.settings.federation); });
  value([&](ManagementWriter to) { to.handles(joined); });
  value([&](ManagementWriter to) { to.text(rti_version()); });
  value([&](ManagementWriter to) { to.text("HLAstandardMIM"); });
  value([&](ManagementWriter to) { to.text(basis_.fom.name()); });
  value([&](ManagementWriter to) { to.text("HLAfloat64Time"); });
  value([&](ManagementWriter to) { to.count(uses_.requests.is_auto_providing() ? 1 : 0); });
  update(federation_);
}

void ManagementObjects::report_federate(std::uint32_t slot, ReportedObject& reported) {
  if (!std::exchange(has_counted_, true)) deletable_ = count_deletable();
  const JoinedFederate& federate = basis_.federates[slot];
  reported.state = state_of(slot);
  begin_values(federate_class_);
  value([&](ManagementWriter to) { to.handle(federate.handle.value); });
  value([&](ManagementWriter to) { to.text(federate.name); });
  value([&](ManagementWriter to) { to.text(federate.type); });
  value([&](ManagementWriter to) { to.text(rti_version()); });
  value_times(slot, reported.state);
  value_counts(slot);
  update(reported);
}

void ManagementObjects::value_times(std::uint32_t slot, unsigned state) {
  const bool is_constrained = (state & 1u) != 0, is_regulating = (state & 2u) != 0;
  const TimeManagement* time = uses_.time.management();
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  value([&](ManagementWriter to) { to.count(is_constrained ? 1 : 0); });
  value([&](ManagementWriter to) { to.count(is_regulating ? 1 : 0); });
  value([&](ManagementWriter to) {
    to.count(1);
  });  // ActiveFederate: this RTI does not save or restore
  value([&](ManagementWriter to) { to.count(uses_.time.is_advancing(slot) ? 1 : 0); });
  value([&](ManagementWriter to) {
    to.time(time != nullptr && state != 0 ? time->time(slot) : 0.0);
  });
  value([&](ManagementWriter to) { to.time(is_regulating ? uses_.time.lookahead(slot) : 0.0); });
  value([&](ManagementWriter to) { to.time(time != nullptr ? time->galt(slot) : unbounded); });
  value([&](ManagementWriter to) { to.time(time != nullptr ? time->lits(slot) : unbounded); });
}

void ManagementObjects::value_counts(std::uint32_t slot) {
  const JoinedFederate& federate = basis_.federates[slot];
  for (const std::uint64_t count :
       {federate.counts.reflections_received, federate.counts.updates_sent,
        federate.counts.interactions_received, federate.counts.interactions_sent,
        std::uint64_t{deletable_[slot]}, federate.objects_deleted, federate.objects_removed,
        std::uint64_t{uses_.objects.registered(slot)}, federate.objects_discovered})
    value([&](ManagementWriter to) { to.count(count); });
}

/// By federate slot, the objects that the federate may delete.
std::vector<std::uint32_t> ManagementObjects::count_deletable() const {
  std::vector<std::uint32_t> deletable(basis_.federates.size(), 0);
  for (ObjectSlot slot = 0; slot < basis_.objects.slot_count(); ++slot) {
    if (!basis_.objects[slot].is_alive) continue;
    const std::uint32_t owner = uses_.ownership.owner_of(slot, privilege_to_delete_object);
    if (owner < deletable.size()) ++deletable[owner];
  }
  return deletable;
}

void ManagementObjects::update(ReportedObject& reported) {
  const ObjectSlot slot = basis_.objects.find(reported.object);
  const Object& object = basis_.objects[slot];
  changed_.clear();
  AttributeSet set;
  for (std::uint32_t k = 0; k < ends_.size(); ++k) {
    const std::size_t from = k == 0 ? 0 : ends_[k - 1];
    const Bytes now = Bytes(values_).subspan(from, ends_[k] - from);
    if (now.empty()) continue;
    before_.clear();
    const AttributeSet one{AttributeHandle{k}};
    if (object.valued.contains({k})) basis_.objects.append(slot, one, before_);
    if (!reported.asked.contains({k}) && std::ranges::equal(before_, now)) continue;
    set = set | one;
    changed_.insert(changed_.end(), now.begin(), now.end());
  }
  reported.asked = {};
  reported.is_due = false;
  if (set.is_empty()) return;
  basis_.objects.store(slot, set, changed_);
  uses_.buffering.append({.owner = *slot_,
                          .slot = slot,
                          .object = object,
                          .attributes = set,
                          .stamp = {},
                          .values = changed_});
  ++basis_.counters.management_updates;
}

}  // namespace rink::rti
