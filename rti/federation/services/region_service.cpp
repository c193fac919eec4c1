// Checks messages about regions and passes them to the data distribution.
#include "rti/federation/services/region_service.h"

namespace rink::rti {

namespace {

/// Calls `take(record)` for each record until it returns a violation.
template <class Record, class Take>
Status for_each_record(Bytes bytes, std::size_t count, Take take) {
  Reader reader(bytes);
  for (std::size_t i = 0; i < count; ++i) {
    Record record;
    if (!exchange(reader, record)) return Violation::malformed;
    if (const Status status = take(record)) return status;
  }
  return std::nullopt;
}

}  // namespace

Status RegionService::handle_create(std::uint32_t slot, Reader& reader) {
  CreateRegionMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  return create(slot, {message.region}, {});
}

Status RegionService::handle_delete(std::uint32_t slot, Reader& reader) {
  DeleteRegionMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const RegionHandle region{message.region};
  if (!uses_.distribution.has_region(slot, region)) return Violation::unknown_name;
  if (const Status status = uses_.requests.settle_within(slot, region)) return status;
  uses_.distribution.delete_region(slot, region);
  --basis_.federates[slot].counts.regions;
  return std::nullopt;
}

Status RegionService::handle_create_over(std::uint32_t slot, Reader& reader) {
  CreateRegionOverMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const DimensionSet dimensions{message.dimensions};
  const std::size_t count = basis_.fom.dimensions().size();
  const DimensionSet all{count == dimension_max ? ~std::uint64_t{0}
                                                : (std::uint64_t{1} << count) - 1};
  return all.includes(dimensions) ? create(slot, {message.region}, dimensions)
                                  : Violation::unknown_name;
}

Status RegionService::create(std::uint32_t slot, RegionHandle region, DimensionSet dimensions) {
  if (!uses_.distribution.create_region(slot, region, dimensions)) return Violation::unknown_name;
  ++basis_.federates[slot].counts.regions;
  return std::nullopt;
}

Status RegionService::handle_modify(std::uint32_t slot, Reader& reader) {
  ModifyRegionsMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  return for_each_record<RegionBounds>(
      message.records, message.count, [&](const RegionBounds& record) -> Status {
        return uses_.distribution.modify_region(slot, record.region, record.bounds)
                   ? Status()
                   : Violation::unknown_name;
      });
}

Status RegionService::handle_modify_ranges(std::uint32_t slot, Reader& reader) {
  ModifyRangesMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const RegionHandle region{message.region};
  // A model without X and Y has regions over the plane all the same, but a message with ranges
  // cannot name those.
  if (message.count == 0 || !uses_.distribution.has_region(slot, region) ||
      uses_.distribution.dimensions(slot, region).count() != message.count)
    return Violation::unknown_name;
  ranges_.clear();
  const Status status =
      for_each_record<Range>(message.ranges, message.count, [&](const Range& range) -> Status {
        ranges_.push_back(range);
        return std::nullopt;
      });
  if (!status) uses_.distribution.modify_region(slot, region, ranges_);
  return status;
}

Status RegionService::handle_associate(std::uint32_t slot, Reader& reader) {
  AssociateRegionMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const ObjectSlot object = basis_.objects.find({message.object});
  const RegionHandle region{message.region};
  if (object == no_object && uses_.known.is_late({message.object})) return std::nullopt;
  if (object == no_object || (region && !uses_.distribution.has_region(slot, region)))
    return Violation::unknown_name;
  if (uses_.ownership.owned_by(slot, object).is_empty()) return Violation::not_owned;
  uses_.distribution.associate(slot, object, region);
  return std::nullopt;
}

Status RegionService::handle_associate_parts(std::uint32_t slot, Reader& reader) {
  AssociateRegionsMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const ObjectSlot object = basis_.objects.find({message.object});
  if (object == no_object && uses_.known.is_late({message.object})) return std::nullopt;
  if (object == no_object) return Violation::unknown_name;
  const AttributeSet all =
      basis_.fom.attributes(ObjectClassHandle{basis_.objects[object].object_class});
  return for_each_record<AttributeRegionRecord>(
      message.pairs, message.count, [&](const AttributeRegionRecord& pair) -> Status {
        const AttributeSet attributes{pair.attributes};
        if (!all.includes(attributes) || !uses_.distribution.has_region(slot, {pair.region}))
          return Violation::unknown_name;
        if (message.is_associated == 0)
          return uses_.distribution.disassociate(slot, object, {pair.region}, attributes),
                 std::nullopt;
        if (!uses_.ownership.owned_by(slot, object).includes(attributes))
          return Violation::not_owned;
        uses_.distribution.associate(slot, object, {pair.region}, attributes);
        return std::nullopt;
      });
}

Status RegionService::handle_class(std::uint32_t slot, Reader& reader) {
  RegionalClassMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  if (message.object_class >= basis_.fom.object_classes().size()) return Violation::unknown_name;
  const AttributeSet all = basis_.fom.attributes(ObjectClassHandle{message.object_class});
  return for_each_record<AttributeRegionRecord>(
      message.pairs, message.count, [&](const AttributeRegionRecord& pair) -> Status {
        const AttributeSet attributes{pair.attributes};
        const RegionHandle region{pair.region};
        if (!all.includes(attributes) || !uses_.distribution.has_region(slot, region))
          return Violation::unknown_name;
        if (static_cast<RegionAction>(message.action) == RegionAction::request_update)
          uses_.requests.ask_within(slot, region, message.object_class, attributes);
        else subscribe(slot, message, region, attributes);
        return std::nullopt;
      });
}

void RegionService::subscribe(std::uint32_t slot, const RegionalClassMessage& message,
                              RegionHandle region, AttributeSet attributes) {
  const auto action = static_cast<RegionAction>(message.action);
  Subscription now = uses_.distribution.subscribed(slot, message.object_class, region);
  now.subscribed = action == RegionAction::remove ? now.subscribed.without(attributes)
                                                  : now.subscribed | attributes;
  now.active =
      action == RegionAction::add ? now.active | attributes : now.active.without(attributes);
  uses_.distribution.subscribe(slot, message.object_class, now, region);
}

}  // namespace rink::rti
