// Objects that are registered while somebody subscribes to them, told when asked, when due and when
// their state changes.
#include "rti/federation/management/management_objects.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rink::rti {

bool ManagementObjects::is_any_heard() const {
  const auto is_heard = [&](ObjectClassHandle each) {
    return each && uses_.declarations.is_heard(each);
  };
  return is_heard(federation_class_) || is_heard(federate_class_);
}

bool ManagementObjects::hears(std::uint32_t slot) const {
  const auto hears = [&](ObjectClassHandle each) {
    return !uses_.distribution.subscribed_anywhere(slot, static_cast<std::uint16_t>(each.value))
                .heard.is_empty();
  };
  return hears(federation_class_) || hears(federate_class_);
}

ManagementObjects::Told& ManagementObjects::told_of(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  return federates_[slot];
}

void ManagementObjects::subscribed(std::uint32_t slot) {
  const bool was_heard = std::exchange(is_heard_, is_any_heard());
  if (is_heard_ && !was_heard) begin();
  if (!is_heard_ && was_heard) end();
  if (!is_heard_ || !basis_.federates[slot].is_joined || !hears(slot)) return;
  federation_.is_due = true;
  for (Told& each : federates_) each.is_due = static_cast<bool>(each.object);
}

void ManagementObjects::timed(std::uint32_t slot, double period) {
  periods_[slot] = period;
  told_of(slot).due_at = basis_.now + period;
}

void ManagementObjects::begin() {
  if (!slot_) slot_ = basis_.federates.add();
  add(federation_, federation_class_);
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined) add(told_of(slot), federate_class_);
}

void ManagementObjects::end() {
  remove(federation_);
  for (Told& each : federates_) remove(each);
}

void ManagementObjects::add(Told& told, ObjectClassHandle object_class) {
  told = {};
  told.object = uses_.objects.register_own(*slot_, object_class);
  told.is_due = true;
  if (&told != &federation_)
    slots_[told.object.value] = static_cast<std::uint32_t>(&told - federates_.data());
}

void ManagementObjects::remove(Told& told) {
  if (told.object) uses_.objects.remove(basis_.objects.find(told.object));
  slots_.erase(told.object.value);
  told = {};
}

void ManagementObjects::joined(std::uint32_t slot) {
  if (slot >= periods_.size()) periods_.resize(slot + 1);
  periods_[slot] = 0.0;
  if (!is_heard_) return;
  add(told_of(slot), federate_class_);
  federation_.is_due = true;
}

void ManagementObjects::left(std::uint32_t slot) {
  if (!is_heard_) return;
  remove(told_of(slot));
  federation_.is_due = true;
}

void ManagementObjects::ask(ObjectHandle object, AttributeSet attributes) {
  const auto slot = slots_.find(object.value);
  Told& told = slot == slots_.end() ? federation_ : federates_[slot->second];
  if (told.object == object) told.asked = told.asked | attributes;
}

void ManagementObjects::tell() {
  for (const UpdateRequests::Asked& each : uses_.requests.take_asked_of_rti())
    ask(each.object, each.attributes);
  if (!is_heard_) return;
  has_counted_ = false;
  if (federation_.is_due || !federation_.asked.is_empty()) tell_federation();
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    Told& told = federates_[slot];
    if (!told.object) continue;
    const double period = slot < periods_.size() ? periods_[slot] : 0.0;
    const bool is_time = period > 0.0 && basis_.now >= told.due_at;
    if (is_time) told.due_at = basis_.now + period;
    if (is_time || told.is_due || !told.asked.is_empty() || told.state != state_of(slot))
      tell_federate(slot, told);
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
               0);  // what a model gives its root is not ours to tell
}

template <class Write>
void ManagementObjects::value(Write write) {
  write(ManagementWriter(values_));
  ends_.push_back(values_.size());
}

/// In the order of the class's attributes (management_classes.cpp).
void ManagementObjects::tell_federation() {
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

void ManagementObjects::tell_federate(std::uint32_t slot, Told& told) {
  if (!std::exchange(has_counted_, true)) deletable_ = count_deletable();
  const JoinedFederate& federate = basis_.federates[slot];
  told.state = state_of(slot);
  begin_values(federate_class_);
  value([&](ManagementWriter to) { to.handle(federate.handle.value); });
  value([&](ManagementWriter to) { to.text(federate.name); });
  value([&](ManagementWriter to) { to.text(federate.type); });
  value([&](ManagementWriter to) { to.text(rti_version()); });
  value_times(slot, told.state);
  value_counts(slot);
  update(told);
}

void ManagementObjects::value_times(std::uint32_t slot, unsigned state) {
  const bool is_constrained = (state & 1u) != 0, is_regulating = (state & 2u) != 0;
  const TimeManagement* time = uses_.time.management();
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  value([&](ManagementWriter to) { to.count(is_constrained ? 1 : 0); });
  value([&](ManagementWriter to) { to.count(is_regulating ? 1 : 0); });
  value([&](ManagementWriter to) {
    to.count(1);
  });  // ActiveFederate: nothing is saved or restored here
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

/// By federate slot: objects that it may delete.
std::vector<std::uint32_t> ManagementObjects::count_deletable() const {
  std::vector<std::uint32_t> deletable(basis_.federates.size(), 0);
  for (ObjectSlot slot = 0; slot < basis_.objects.slot_count(); ++slot) {
    if (!basis_.objects[slot].is_alive) continue;
    const std::uint32_t owner = uses_.ownership.owner_of(slot, privilege_to_delete_object);
    if (owner < deletable.size()) ++deletable[owner];
  }
  return deletable;
}

void ManagementObjects::update(Told& told) {
  const ObjectSlot slot = basis_.objects.find(told.object);
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
    if (!told.asked.contains({k}) && std::ranges::equal(before_, now)) continue;
    set = set | one;
    changed_.insert(changed_.end(), now.begin(), now.end());
  }
  told.asked = {};
  told.is_due = false;
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
