// The objects of the management object model: registered while somebody subscribes to them, told
// when asked, when due and when their state changes.
#include "rti/federation/federation_management_objects.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "rti/management/management_values.h"

namespace rink::rti {

bool FederationParts::ManagementObjects::is_heard(const FederationParts& parts) {
  const auto heard = [&parts](ObjectClassHandle each) {
    return each && parts.declarations_.is_heard(each);
  };
  return heard(parts.management_.federation) || heard(parts.management_.federate);
}

FederationParts::ManagementObjects::ManagementObjects(FederationParts& parts)
    : parts_(parts),
      federation_class_(parts.management_.federation),
      federate_class_(parts.management_.federate),
      slot_(parts.federates_.add()) {}

FederationParts::ManagementObjects::Told& FederationParts::ManagementObjects::told_of(
    std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  return federates_[slot];
}

void FederationParts::ManagementObjects::subscribed(std::uint32_t slot) {
  const bool was_heard = std::exchange(is_heard_, is_heard(parts_));
  if (is_heard_ && !was_heard) begin();
  if (!is_heard_ && was_heard) end();
  if (!is_heard_ || !parts_.federates_[slot].is_joined) return;
  const auto hears = [&](ObjectClassHandle each) {
    return !parts_.interest_.subscribed_anywhere(slot, static_cast<std::uint16_t>(each.value))
                .heard.is_empty();
  };
  if (!hears(federation_class_) && !hears(federate_class_)) return;
  federation_.is_due = true;
  for (Told& each : federates_) each.is_due = static_cast<bool>(each.object);
}

void FederationParts::ManagementObjects::begin() {
  add(federation_, federation_class_);
  for (std::uint32_t slot = 0; slot < parts_.federates_.size(); ++slot)
    if (parts_.federates_[slot].is_joined) add(told_of(slot), federate_class_);
}

void FederationParts::ManagementObjects::end() {
  remove(federation_);
  for (Told& each : federates_) remove(each);
}

void FederationParts::ManagementObjects::add(Told& told, ObjectClassHandle object_class) {
  told = {};
  told.object = parts_.object_service_.register_own(slot_, object_class);
  told.is_due = true;
  if (&told != &federation_)
    slots_[told.object.value] = static_cast<std::uint32_t>(&told - federates_.data());
}

void FederationParts::ManagementObjects::remove(Told& told) {
  if (told.object) parts_.object_service_.remove(parts_.objects_.find(told.object));
  slots_.erase(told.object.value);
  told = {};
}

void FederationParts::ManagementObjects::joined(std::uint32_t slot) {
  if (!is_heard_) return;
  add(told_of(slot), federate_class_);
  federation_.is_due = true;
}

void FederationParts::ManagementObjects::left(std::uint32_t slot) {
  if (!is_heard_) return;
  remove(told_of(slot));
  federation_.is_due = true;
}

void FederationParts::ManagementObjects::ask(ObjectHandle object, AttributeSet attributes) {
  const auto slot = slots_.find(object.value);
  Told& told = slot == slots_.end() ? federation_ : federates_[slot->second];
  if (told.object == object) told.asked = told.asked | attributes;
}

void FederationParts::ManagementObjects::tell() {
  for (const UpdateRequests::Asked& each : parts_.update_requests_.take_asked_of_rti())
    ask(each.object, each.attributes);
  if (!is_heard_) return;
  has_counted_ = false;
  if (federation_.is_due || !federation_.asked.is_empty()) tell_federation();
  for (std::uint32_t slot = 0; slot < federates_.size(); ++slot) {
    Told& told = federates_[slot];
    if (!told.object) continue;
    const double period = parts_.federates_[slot].report_period;
    const bool is_time = period > 0.0 && parts_.now_ >= told.due_at;
    if (is_time) told.due_at = parts_.now_ + period;
    if (is_time || told.is_due || !told.asked.is_empty() || told.state != state_of(slot))
      tell_federate(slot, told);
  }
}

unsigned FederationParts::ManagementObjects::state_of(std::uint32_t slot) const {
  const TimeManagement* management = parts_.time_.management();
  if (management == nullptr) return 0;
  return (management->is_constrained(slot) ? 1u : 0u) | (management->is_regulating(slot) ? 2u : 0u);
}

void FederationParts::ManagementObjects::begin_values(ObjectClassHandle object_class) {
  values_.clear();
  const ObjectClassHandle manager = parts_.fom_.at(object_class).parent;
  ends_.assign(parts_.fom_.at(manager).attributes.size(),
               0);  // what a model gives its root is not ours to tell
}

template <class Write>
void FederationParts::ManagementObjects::value(Write write) {
  write(ManagementWriter(values_));
  ends_.push_back(values_.size());
}

/// In the order of the class's attributes (management_classes.cpp).
void FederationParts::ManagementObjects::tell_federation() {
  std::vector<std::uint32_t> joined;
  for (const Federate& each : parts_.federates_)
    if (each.is_joined) joined.push_back(each.handle.value);
  begin_values(federation_class_);
  value([&](ManagementWriter to) { to.text(parts_.settings_.federation); });
  value([&](ManagementWriter to) { to.handles(joined); });
  value([&](ManagementWriter to) { to.text(rti_version()); });
  value([&](ManagementWriter to) { to.text("HLAstandardMIM"); });
  value([&](ManagementWriter to) { to.text(parts_.fom_.name()); });
  value([&](ManagementWriter to) { to.text("HLAfloat64Time"); });
  value(
      [&](ManagementWriter to) { to.count(parts_.update_requests_.is_auto_providing() ? 1 : 0); });
  update(federation_);
}

void FederationParts::ManagementObjects::tell_federate(std::uint32_t slot, Told& told) {
  if (!std::exchange(has_counted_, true)) deletable_ = parts_.count_deletable();
  const Federate& federate = parts_.federates_[slot];
  told.state = state_of(slot);
  const bool is_constrained = (told.state & 1u) != 0, is_regulating = (told.state & 2u) != 0;
  const TimeManagement* time = parts_.time_.management();
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  begin_values(federate_class_);
  value([&](ManagementWriter to) { to.handle(federate.handle.value); });
  value([&](ManagementWriter to) { to.text(federate.name); });
  value([&](ManagementWriter to) { to.text(federate.type); });
  value([&](ManagementWriter to) { to.text(rti_version()); });
  value([&](ManagementWriter to) { to.count(is_constrained ? 1 : 0); });
  value([&](ManagementWriter to) { to.count(is_regulating ? 1 : 0); });
  value([&](ManagementWriter to) {
    to.count(1);
  });  // ActiveFederate: nothing is saved or restored here
  value([&](ManagementWriter to) { to.count(parts_.time_.is_advancing(slot) ? 1 : 0); });
  value([&](ManagementWriter to) {
    to.time(time != nullptr && told.state != 0 ? time->time(slot) : 0.0);
  });
  value([&](ManagementWriter to) { to.time(is_regulating ? parts_.time_.lookahead(slot) : 0.0); });
  value([&](ManagementWriter to) { to.time(time != nullptr ? time->galt(slot) : unbounded); });
  value([&](ManagementWriter to) { to.time(time != nullptr ? time->lits(slot) : unbounded); });
  for (const std::uint64_t count :
       {federate.counts.reflections_received, federate.counts.updates_sent,
        federate.counts.interactions_received, federate.counts.interactions_sent,
        std::uint64_t{deletable_[slot]}, federate.objects_deleted, federate.objects_removed,
        std::uint64_t{parts_.object_service_.registered(slot)}, federate.objects_discovered})
    value([&](ManagementWriter to) { to.count(count); });
  update(told);
}

void FederationParts::ManagementObjects::update(Told& told) {
  const ObjectSlot slot = parts_.objects_.find(told.object);
  const Object& object = parts_.objects_[slot];
  changed_.clear();
  AttributeSet set;
  for (std::uint32_t k = 0; k < ends_.size(); ++k) {
    const std::size_t from = k == 0 ? 0 : ends_[k - 1];
    const Bytes now = Bytes(values_).subspan(from, ends_[k] - from);
    if (now.empty()) continue;
    before_.clear();
    const AttributeSet one{AttributeHandle{k}};
    if (object.valued.contains({k})) parts_.objects_.append(slot, one, before_);
    if (!told.asked.contains({k}) && std::ranges::equal(before_, now)) continue;
    set = set | one;
    changed_.insert(changed_.end(), now.begin(), now.end());
  }
  told.asked = {};
  told.is_due = false;
  if (set.is_empty()) return;
  parts_.objects_.store(slot, set, changed_);
  parts_.buffering_->append(slot_, slot, object, set, Stamp{}, changed_);
  ++parts_.counters_.management_updates;
}

}  // namespace rink::rti
