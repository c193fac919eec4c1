// The state machine of attribute ownership, on sets of attributes.
#include "rti/ownership/ownership.h"

#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"

namespace rink::rti {

namespace {

using Kind = OwnershipEvent::Kind;

template <class Parts>
AttributeSet union_of(const Parts& parts) {
  AttributeSet set;
  for (const auto& each : parts) set = set | each.attributes;
  return set;
}

}  // namespace

AttributeSet Ownership::all(ObjectSlot object) const {
  return fom_.attributes(ObjectClassHandle{objects_[object].object_class}) |
         AttributeSet{privilege_to_delete_object};
}

const Ownership::Record* Ownership::find(ObjectSlot object) const {
  const std::uint32_t record = objects_[object].negotiation;
  assert(record == Object::no_negotiation || records_[record].object == object);
  return record == Object::no_negotiation ? nullptr : &records_[record];
}

AttributeSet Ownership::owned_by(std::uint32_t federate, ObjectSlot object) const {
  assert(federate != no_federate && object < objects_.slot_count());
  if (objects_[object].owner != no_federate)
    return objects_[object].owner == federate ? all(object) : AttributeSet();
  for (const Share& each : find(object)->shares)
    if (each.federate == federate) return each.attributes;
  return {};
}

AttributeSet Ownership::unowned(ObjectSlot object) const {
  if (objects_[object].owner != no_federate) return {};
  assert(find(object) != nullptr);  // the record has the owner of each attribute
  return all(object).without(union_of(find(object)->shares));
}

AttributeSet Ownership::owned_by_others(std::uint32_t federate, ObjectSlot object) const {
  return all(object).without(unowned(object)).without(owned_by(federate, object));
}

std::uint32_t Ownership::owner_of(ObjectSlot object, AttributeHandle attribute) const {
  if (objects_[object].owner != no_federate) return objects_[object].owner;
  for (const Share& each : find(object)->shares)
    if (each.attributes.contains(attribute)) return each.federate;
  return no_federate;
}

AttributeSet Ownership::offered(ObjectSlot object) const {
  const Record* record = find(object);
  return record ? record->offered : AttributeSet();
}

AttributeSet Ownership::confirming(ObjectSlot object) const {
  const Record* record = find(object);
  return record ? record->confirming : AttributeSet();
}

AttributeSet Ownership::sought_by(std::uint32_t federate, ObjectSlot object) const {
  AttributeSet set;
  const Record* record = find(object);
  if (record)
    for (const Claim& each : record->claims)
      if (each.federate == federate) set = set | each.attributes;
  return set;
}

Bytes Ownership::offer_tag(ObjectSlot object) const {
  const Record* record = find(object);
  return record ? Bytes(record->tag) : Bytes();
}

Ownership::Record& Ownership::open(ObjectSlot object) {
  events_.clear();
  Object& opened = objects_[object];
  assert(opened.is_alive);
  if (opened.negotiation != Object::no_negotiation) return records_[opened.negotiation];
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(records_.size()));
    records_.emplace_back();
  }
  opened.negotiation = free_.back();
  free_.pop_back();
  Record& record = records_[opened.negotiation];
  assert(record.object == no_object && record.shares.empty() && record.claims.empty());
  assert(opened.owner != no_federate);
  record.object = object;
  record.shares.push_back(
      {opened.owner, all(object)});  // without a record there is one owner of all
  return record;
}

void Ownership::close_if_settled(Record& record) {
  Object& object = objects_[record.object];
  const bool is_whole =
      record.shares.size() == 1 && record.shares.front().attributes == all(record.object);
  object.owner = is_whole ? record.shares.front().federate : no_federate;
  if constexpr (checks_whole_structures) check(record);
  if (!is_whole || !record.offered.is_empty() || !record.claims.empty()) return;
  forget(record.object);
}

void Ownership::forget(ObjectSlot object) {
  std::uint32_t& negotiation = objects_[object].negotiation;
  if (negotiation == Object::no_negotiation) return;
  Record& record = records_[negotiation];
  record.object = no_object;
  record.shares.clear();
  record.claims.clear();
  record.tag.clear();
  record.offered = record.confirming = {};
  free_.push_back(negotiation);
  negotiation = Object::no_negotiation;
}

void Ownership::check() const {
  [[maybe_unused]] std::size_t open_count = 0;
  for (const Record& record : records_) {
    if (record.object == no_object) continue;
    ++open_count;
    assert(&record == find(record.object));
    check(record);
  }
  assert(open_count == record_count());
  for ([[maybe_unused]] const std::uint32_t each : free_)
    assert(records_[each].object == no_object);
}

void Ownership::check(const Record& record) const {
  AttributeSet owned;
  [[maybe_unused]] const AttributeSet wanted = union_of(record.claims);
  for (const Share& each : record.shares) {
    assert(each.federate != no_federate && !each.attributes.is_empty());
    assert((owned & each.attributes).is_empty());  // an attribute has one owner
    owned = owned | each.attributes;
  }
  assert(all(record.object).includes(owned));
  assert(owned.includes(record.offered));  // an unowned attribute is not offered and has no claim
  assert(owned.includes(wanted));
  assert(record.confirming == (record.offered & wanted));
  for ([[maybe_unused]] const Claim& each : record.claims) {
    assert(!each.attributes.is_empty());
    assert((each.attributes & owned_by(each.federate, record.object)).is_empty());
    assert(!each.is_if_available || record.offered.includes(each.attributes));
  }
}

void Ownership::notify(Kind kind, std::uint32_t federate, AttributeSet attributes) {
  if (!attributes.is_empty()) events_.push_back({kind, federate, attributes});
}

void Ownership::notify_owners(Kind kind, const Record& record, AttributeSet attributes) {
  for (const Share& each : record.shares) notify(kind, each.federate, each.attributes & attributes);
}

/// Moves the attributes from their owners to `to`, which may be no_federate. Remaining claims are
/// requests to the new owner.
void Ownership::transfer(Record& record, AttributeSet attributes, std::uint32_t to) {
  for (Share& each : record.shares) each.attributes = each.attributes.without(attributes);
  std::erase_if(record.shares, [](const Share& each) { return each.attributes.is_empty(); });
  record.offered = record.offered.without(attributes);
  record.confirming = record.confirming.without(attributes);
  if (to == no_federate) return;
  const auto share = std::find_if(record.shares.begin(), record.shares.end(),
                                  [to](const Share& each) { return each.federate == to; });
  if (share == record.shares.end()) record.shares.push_back({to, attributes});
  else share->attributes = share->attributes | attributes;
  for (Claim& each : record.claims)
    if (each.federate == to) each.attributes = each.attributes.without(attributes);
  notify(Kind::acquired, to, attributes);
  end_claims(record, attributes, false);
  notify(Kind::release_requested, to, union_of(record.claims) & attributes);
}

/// Gives each of `attributes` to its first claimant. Returns those that were given.
AttributeSet Ownership::give_to_claimants(Record& record, AttributeSet attributes) {
  AttributeSet given;
  for (std::size_t first = 0; first < record.claims.size();) {
    const AttributeSet part = record.claims[first].attributes & attributes.without(given);
    if (part.is_empty()) {
      ++first;
      continue;
    }
    given = given | part;
    transfer(record, part, record.claims[first].federate);
    first = 0;  // claims have gone
  }
  return given;
}

/// Ends the claims to `attributes` without success; regular ones only if `also_regular`.
void Ownership::end_claims(Record& record, AttributeSet attributes, bool also_regular) {
  for (Claim& each : record.claims) {
    if (!also_regular && !each.is_if_available) continue;
    notify(Kind::unavailable, each.federate, each.attributes & attributes);
    each.attributes = each.attributes.without(attributes);
  }
  drop_empty_claims(record);
}

void Ownership::drop_empty_claims(Record& record) {
  std::erase_if(record.claims, [](const Claim& each) { return each.attributes.is_empty(); });
  record.confirming = record.confirming & union_of(record.claims);
}

Ownership::Events Ownership::divest([[maybe_unused]] std::uint32_t federate, ObjectSlot object,
                                    AttributeSet attributes) {
  assert(owned_by(federate, object).includes(attributes));
  Record& record = open(object);
  const AttributeSet rest = attributes.without(give_to_claimants(record, attributes));
  transfer(record, rest, no_federate);
  notify(Kind::offered, no_federate, rest);
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::offer(std::uint32_t federate, ObjectSlot object,
                                   AttributeSet attributes, Bytes tag) {
  assert(owned_by(federate, object).includes(attributes));
  Record& record = open(object);
  record.offered = record.offered | attributes;
  record.tag.assign(tag.begin(), tag.end());
  const AttributeSet wanted = attributes & union_of(record.claims);
  record.confirming = record.confirming | wanted;
  notify(Kind::confirmation_requested, federate, wanted);
  notify(Kind::offered, no_federate, attributes.without(wanted));
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::withdraw_offer(std::uint32_t federate, ObjectSlot object,
                                            AttributeSet attributes) {
  assert(owned_by(federate, object).includes(attributes));
  Record& record = open(object);
  record.offered = record.offered.without(attributes);
  end_claims(record, attributes, false);
  record.confirming = record.confirming.without(attributes);
  notify(Kind::release_requested, federate, attributes & union_of(record.claims));
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::deny_release([[maybe_unused]] std::uint32_t federate,
                                          ObjectSlot object, AttributeSet attributes) {
  assert(owned_by(federate, object).includes(attributes));
  Record& record = open(object);
  end_claims(record, attributes, true);
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::give([[maybe_unused]] std::uint32_t federate, ObjectSlot object,
                                  AttributeSet attributes) {
  assert(owned_by(federate, object).includes(attributes));
  Record& record = open(object);
  give_to_claimants(record, attributes);
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::acquire(std::uint32_t federate, ObjectSlot object,
                                     AttributeSet attributes) {
  assert(all(object).includes(attributes));
  Record& record = open(object);
  attributes = attributes.without(owned_by(federate, object));
  for (Claim& each : record.claims) {
    if (each.federate != federate) continue;
    // A regular claim replaces one if available; a repeated request counts once.
    if (each.is_if_available) each.attributes = each.attributes.without(attributes);
    else attributes = attributes.without(each.attributes);
  }
  const AttributeSet free = attributes & unowned(object), taken = attributes.without(free);
  if (!free.is_empty()) transfer(record, free, federate);
  if (!taken.is_empty()) record.claims.push_back({federate, taken, false});
  const AttributeSet confirmable = taken & record.offered.without(record.confirming);
  drop_empty_claims(record);
  record.confirming = record.confirming | confirmable;
  notify_owners(Kind::confirmation_requested, record, confirmable);
  notify_owners(Kind::release_requested, record, taken.without(record.offered));
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::acquire_if_available(std::uint32_t federate, ObjectSlot object,
                                                  AttributeSet attributes) {
  assert(all(object).includes(attributes));
  Record& record = open(object);
  attributes = attributes.without(owned_by(federate, object)).without(sought_by(federate, object));
  const AttributeSet free = attributes & unowned(object), waiting = attributes & record.offered;
  if (!free.is_empty()) transfer(record, free, federate);
  if (!waiting.is_empty()) record.claims.push_back({federate, waiting, true});
  const AttributeSet confirmable = waiting.without(record.confirming);
  record.confirming = record.confirming | waiting;
  notify_owners(Kind::confirmation_requested, record, confirmable);
  notify(Kind::unavailable, federate, attributes.without(free).without(waiting));
  close_if_settled(record);
  return events_;
}

Ownership::Events Ownership::cancel(std::uint32_t federate, ObjectSlot object,
                                    AttributeSet attributes) {
  Record& record = open(object);
  for (Claim& each : record.claims) {
    if (each.federate != federate || each.is_if_available) continue;
    notify(Kind::cancelled, federate, each.attributes & attributes);
    each.attributes = each.attributes.without(attributes);
  }
  drop_empty_claims(record);
  close_if_settled(record);
  return events_;
}

void Ownership::forget_claims(std::uint32_t federate) {
  events_.clear();
  for (Record& record : records_) {
    if (record.object == no_object) continue;
    std::erase_if(record.claims,
                  [federate](const Claim& each) { return each.federate == federate; });
    drop_empty_claims(record);
    close_if_settled(record);
  }
  if constexpr (checks_whole_structures) check();
}

}  // namespace rink::rti
