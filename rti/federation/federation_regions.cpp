// What federates say of regions: checked once, here; then it is the data distribution's.
#include <algorithm>

#include "rti/federation/federation_parts.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

namespace {

/// Calls `take(record)` for each record until it returns a violation.
template <class Record, class Take>
Outcome for_each_record(Bytes bytes, std::size_t count, Take take) {
  Reader reader(bytes);
  for (std::size_t i = 0; i < count; ++i) {
    Record record;
    if (!exchange(reader, record)) return Violation::malformed;
    if (const Outcome outcome = take(record)) return outcome;
  }
  return std::nullopt;
}

}  // namespace

Outcome FederationParts::create_or_delete_region(std::uint32_t slot, MessageKind kind,
                                                 Reader& reader) {
  CreateRegionMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const RegionHandle region{message.region};
  if (kind == MessageKind::create_region) return create_region(slot, region, {});
  if (!interest_.has_region(slot, region)) return Violation::unknown_name;
  if (const Outcome outcome = update_requests_.settle_within(slot, region)) return outcome;
  interest_.delete_region(slot, region);
  --federates_[slot].counts.regions;
  interactions_.join_groups(slot);
  subscribed(slot);
  return std::nullopt;
}

Outcome FederationParts::create_region_over(std::uint32_t slot, Reader& reader) {
  CreateRegionOverMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const DimensionSet dimensions{message.dimensions};
  const std::size_t count = fom_.dimensions().size();
  const DimensionSet all{count == dimension_max ? ~std::uint64_t{0}
                                                : (std::uint64_t{1} << count) - 1};
  return all.includes(dimensions) ? create_region(slot, {message.region}, dimensions)
                                  : Violation::unknown_name;
}

Outcome FederationParts::create_region(std::uint32_t slot, RegionHandle region,
                                       DimensionSet dimensions) {
  if (!interest_.create_region(slot, region, dimensions)) return Violation::unknown_name;
  ++federates_[slot].counts.regions;
  return std::nullopt;
}

Outcome FederationParts::modify_regions(std::uint32_t slot, Reader& reader) {
  ModifyRegionsMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  return for_each_record<RegionBounds>(
      message.records, message.count, [&](const RegionBounds& record) -> Outcome {
        return interest_.modify_region(slot, record.region, record.bounds)
                   ? Outcome()
                   : Violation::unknown_name;
      });
}

Outcome FederationParts::modify_ranges(std::uint32_t slot, Reader& reader) {
  ModifyRangesMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const RegionHandle region{message.region};
  // A model without X and Y has regions over the plane all the same, whose ranges have no
  // dimensions to go by.
  if (message.count == 0 || !interest_.has_region(slot, region) ||
      interest_.dimensions(slot, region).count() != message.count)
    return Violation::unknown_name;
  ranges_.clear();
  const Outcome outcome =
      for_each_record<Range>(message.ranges, message.count, [&](const Range& range) -> Outcome {
        ranges_.push_back(range);
        return std::nullopt;
      });
  if (!outcome) interest_.modify_region(slot, region, ranges_);
  return outcome;
}

Outcome FederationParts::associate_region(std::uint32_t slot, Reader& reader) {
  AssociateRegionMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const ObjectSlot object = objects_.find({message.object});
  const RegionHandle region{message.region};
  if (object == no_object && known_.is_late({message.object})) return std::nullopt;
  if (object == no_object || (region && !interest_.has_region(slot, region)))
    return Violation::unknown_name;
  if (ownership_.owned_by(slot, object).is_empty()) return Violation::not_owned;
  interest_.associate(slot, object, region);
  return std::nullopt;
}

Outcome FederationParts::associate_regions(std::uint32_t slot, Reader& reader) {
  AssociateRegionsMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const ObjectSlot object = objects_.find({message.object});
  if (object == no_object && known_.is_late({message.object})) return std::nullopt;
  if (object == no_object) return Violation::unknown_name;
  const AttributeSet all = fom_.attributes(ObjectClassHandle{objects_[object].object_class});
  return for_each_record<AttributeRegionRecord>(
      message.pairs, message.count, [&](const AttributeRegionRecord& pair) -> Outcome {
        const AttributeSet attributes{pair.attributes};
        if (!all.includes(attributes) || !interest_.has_region(slot, {pair.region}))
          return Violation::unknown_name;
        if (message.is_associated == 0)
          return interest_.disassociate(slot, object, {pair.region}, attributes), std::nullopt;
        if (!ownership_.owned_by(slot, object).includes(attributes)) return Violation::not_owned;
        interest_.associate(slot, object, {pair.region}, attributes);
        return std::nullopt;
      });
}

Outcome FederationParts::take_regional_class(std::uint32_t slot, Reader& reader) {
  RegionalClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= fom_.object_classes().size()) return Violation::unknown_name;
  const AttributeSet all = fom_.attributes(ObjectClassHandle{message.object_class});
  const Outcome outcome = for_each_record<AttributeRegionRecord>(
      message.pairs, message.count, [&](const AttributeRegionRecord& pair) -> Outcome {
        const AttributeSet attributes{pair.attributes};
        const RegionHandle region{pair.region};
        if (!all.includes(attributes) || !interest_.has_region(slot, region))
          return Violation::unknown_name;
        const auto action = static_cast<RegionAction>(message.action);
        if (action == RegionAction::request_update) {
          update_requests_.ask_within(slot, region, message.object_class, attributes);
          return std::nullopt;
        }
        Subscription now = interest_.subscribed(slot, message.object_class, region);
        now.heard =
            action == RegionAction::remove ? now.heard.without(attributes) : now.heard | attributes;
        now.active =
            action == RegionAction::add ? now.active | attributes : now.active.without(attributes);
        interest_.subscribe(slot, message.object_class, now, region);
        return std::nullopt;
      });
  if (!outcome) subscribed(slot);
  return outcome;
}

}  // namespace rink::rti
