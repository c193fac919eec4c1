// Keeps requests until the flush, since each look through all objects is expensive.
#include "rti/federation/services/update_requests.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "rti/wire/region_messages.h"

namespace rink::rti {

namespace {

std::string as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
Bytes as_bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

}  // namespace

void UpdateRequests::joined(std::uint32_t slot) {
  if (slot >= looked_at_.size()) looked_at_.resize(slot + 1);
  looked_at_[slot] = 0;
}

void UpdateRequests::flushed() { std::ranges::fill(looked_at_, 0u); }

Status UpdateRequests::handle(std::uint32_t slot, Reader& reader) {
  RequestUpdateMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const AttributeSet attributes{message.attributes};
  if (message.is_class == 0) {
    ObjectSlot object = no_object;
    if (const Status status = known_.find_known(slot, {message.number}, object);
        status || object == no_object)
      return status;
    if (!ownership_.all(object).includes(attributes)) return Violation::unknown_name;
    ask(slot, object, attributes, message.tag);
    return std::nullopt;
  }
  if (message.number >= basis_.fom.object_classes().size() ||
      !basis_.fom.attributes(ObjectClassHandle{message.number}).includes(attributes))
    return Violation::unknown_name;
  AttributeSet& asked =
      requests_[{slot, RegionHandle{}.value, static_cast<std::uint16_t>(message.number),
                 as_text(message.tag)}];
  asked = asked | attributes;
  return std::nullopt;
}

void UpdateRequests::ask_within(std::uint32_t slot, RegionHandle region, std::uint16_t object_class,
                                AttributeSet attributes) {
  assert(distribution_.has_region(slot, region));
  AttributeSet& asked = requests_[{slot, region.value, object_class, std::string()}];
  asked = asked | attributes;
}

/// A federate is not asked for its own attributes.
void UpdateRequests::ask(std::uint32_t slot, ObjectSlot object, AttributeSet attributes,
                         Bytes tag) {
  if (attributes.is_empty()) return;
  const Object& asked = basis_.objects[object];
  const AttributeSet named = basis_.fom.attributes(ObjectClassHandle{asked.object_class});
  if (asked.owner != no_federate && !basis_.federates[asked.owner].is_joined)
    return asked_of_rti_.push_back({asked.handle, attributes & named});
  const auto ask_owner = [&](std::uint32_t owner) {
    const AttributeSet owned =
        owner == slot ? AttributeSet() : attributes & ownership_.owned_by(owner, object) & named;
    if (owned.is_empty()) return;
    AttributeSet& discovered_set = to_provide_[{owner, asked.handle.value, as_text(tag)}];
    discovered_set = discovered_set | owned;
  };
  if (asked.owner != no_federate) ask_owner(asked.owner);
  else ownership_.for_each_owner(object, ask_owner);
}

/// Looks at every object: such requests are rare, and overlaps are not stored.
void UpdateRequests::find_owners(std::uint32_t slot, ObjectClassHandle object_class,
                                 AttributeSet attributes, RegionHandle region, Bytes tag) {
  const ObjectSlot count = basis_.objects.slot_count();
  looked_at_[slot] += count;
  for (ObjectSlot object = 0; object < count; ++object) {
    const Object& asked = basis_.objects[object];
    if (!asked.is_alive || !basis_.fom.is_a(ObjectClassHandle{asked.object_class}, object_class))
      continue;
    ask(slot, object,
        region ? distribution_.overlapping(slot, region, object, attributes) : attributes, tag);
  }
}

void UpdateRequests::settle() {
  for (auto each = requests_.begin(); each != requests_.end();) {
    const auto& [slot, region, object_class, tag] = each->first;
    if (looked_at_[slot] >= looked_at_max) {
      each = requests_.lower_bound({slot + 1, 0, 0, {}});
      continue;
    }
    find_owners(slot, {object_class}, each->second, {region}, as_bytes_of(tag));
    each = requests_.erase(each);
  }
  for (const auto& [whom, attributes] : to_provide_) {
    const auto& [owner, object, tag] = whom;
    assert(basis_.federates[owner].is_joined && !attributes.is_empty());
    basis_.federates[owner].outbox.after_updates(
        ProvideUpdateMessage{object, attributes.bits, as_bytes_of(tag)});
  }
  to_provide_.clear();
}

Status UpdateRequests::settle_within(std::uint32_t slot, RegionHandle region) {
  for (auto each = requests_.lower_bound({slot, region.value, 0, {}}); each != requests_.end();) {
    const auto& [asking, within, object_class, tag] = each->first;
    if (asking != slot || within != region.value) break;
    if (looked_at_[slot] >= looked_at_max) return Violation::over_limit;
    find_owners(slot, {object_class}, each->second, region, as_bytes_of(tag));
    each = requests_.erase(each);
  }
  return std::nullopt;
}

void UpdateRequests::left(std::uint32_t slot) {
  requests_.erase(requests_.lower_bound({slot, 0, 0, {}}),
                  requests_.lower_bound({slot + 1, 0, 0, {}}));
  to_provide_.erase(to_provide_.lower_bound({slot, 0, {}}),
                    to_provide_.lower_bound({slot + 1, 0, {}}));
  looked_at_[slot] = 0;
}

}  // namespace rink::rti
