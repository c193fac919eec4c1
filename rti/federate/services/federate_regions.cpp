// Checks regions, notes them in `RegionBook` and sends them, several to a message.
#include "rti/federate/services/federate_regions.h"

#include <algorithm>
#include <cassert>

#include "rti/federate/books/require.h"

namespace rink::rti {

/// Gathers the pairs, as many as a message takes at once, in `records_`, and calls
/// `send(count)` for each message.
template <class Send>
void FederateRegions::for_each_message(std::span<const AttributeRegions> pairs, Send send) {
  records_.clear();
  Writer writer(records_);
  std::uint16_t count = 0;
  const auto add = [&](AttributeSet attributes, RegionHandle region) {
    AttributeRegionRecord record{attributes.bits, uses_.book.number(region)};
    exchange(writer, record);
    if (++count < regions_per_message_max) return;
    send(count);
    records_.clear();
    count = 0;
  };
  for (const AttributeRegions& each : pairs)
    for (const RegionHandle region : each.regions)
      for (unsigned page = 0; page <= AttributeRegionRecord::page_max; ++page)
        if (const AttributeSet part = AttributeRegionRecord::page(each.attributes, page);
            !part.is_empty() || (page == 0 && each.attributes.is_empty()))
          add(part, region);
  if (count > 0) send(count);
}

RegionHandle FederateRegions::create() {
  const RegionHandle region = uses_.book.create({});
  if (region) basis_.frames.enqueue(CreateRegionMessage{uses_.book.number(region)});
  return region;
}

RegionHandle FederateRegions::create(DimensionSet dimensions) {
  if (dimensions.is_empty())
    throw RtiException(HlaError::invalid_dimension_handle, "a region needs a dimension");
  dimensions.for_each([this](DimensionHandle each) {
    if (each.value >= basis_.fom.dimensions().size())
      throw RtiException(HlaError::invalid_dimension_handle,
                         "the model has no dimension " + std::to_string(each.value));
  });
  const RegionHandle region = uses_.book.create(dimensions);
  if (region)
    basis_.frames.enqueue(CreateRegionOverMessage{uses_.book.number(region), dimensions.bits});
  return region;
}

void FederateRegions::commit(std::span<const RegionHandle> regions) {
  for (const RegionHandle region : regions)
    if (!uses_.book.is_planar(region))
      uses_.book.closed_ranges(region, ranges_);  // all are checked before any is sent
  for (const RegionHandle region : regions) {
    if (uses_.book.is_planar(region)) {
      const RegionBounds one{region, uses_.book.plane(uses_.book.number(region))};
      commit(std::span(&one, 1));
      continue;
    }
    uses_.book.closed_ranges(region, ranges_);
    records_.clear();
    Writer writer(records_);
    for (Range& each : ranges_) exchange(writer, each);
    basis_.frames.enqueue(ModifyRangesMessage{uses_.book.number(region),
                                              static_cast<std::uint8_t>(ranges_.size()), records_});
  }
}

void FederateRegions::commit(std::span<const RegionBounds> regions) {
  while (!regions.empty()) {
    const auto chunk = regions.first(std::min(regions.size(), ModifyRegionsMessage::count_max));
    regions = regions.subspan(chunk.size());
    records_.clear();
    Writer writer(records_);
    for (RegionBounds each : chunk) {
      assert(each.bounds.low_x <= each.bounds.high_x && each.bounds.low_y <= each.bounds.high_y);
      each.region.value = uses_.book.number(each.region);
      uses_.book.set_plane_unchecked(each.region.value, each.bounds);
      exchange(writer, each);
    }
    basis_.frames.enqueue(ModifyRegionsMessage{static_cast<std::uint16_t>(chunk.size()), records_});
  }
}

void FederateRegions::remove(RegionHandle region) {
  const std::uint32_t number = uses_.book.check(region);
  uses_.book.remove(
      region, [this](ObjectHandle object) { return !uses_.ownership.owned_of(object).is_empty(); });
  basis_.frames.enqueue(DeleteRegionMessage{number});
}

void FederateRegions::associate(ObjectHandle object, RegionHandle region) {
  require_own(object);
  const std::uint32_t number = region ? uses_.book.check(region) : RegionHandle::none;
  uses_.book.associate(object, region);
  basis_.frames.enqueue(AssociateRegionMessage{object.value, number});
}

void FederateRegions::associate(ObjectHandle object, std::span<const AttributeRegions> pairs,
                                bool is_added) {
  const ObjectClassHandle object_class = require_own(object);
  check(object_class, pairs);
  for (const AttributeRegions& each : pairs)
    for (const RegionHandle region : each.regions)
      uses_.book.associate(object, basis_.fom.attributes(object_class), each.attributes, region,
                           is_added);
  for_each_message(pairs, [&](std::uint16_t count) {
    basis_.frames.enqueue(AssociateRegionsMessage{object.value, is_added, count, records_});
  });
}

ObjectHandle FederateRegions::register_instance(ObjectClassHandle object_class,
                                                std::span<const AttributeRegions> pairs,
                                                std::string_view name) {
  check(object_class, pairs);
  const ObjectHandle object = uses_.registry.register_instance(object_class, name);
  if (object) associate(object, pairs, true);
  return object;
}

void FederateRegions::subscribe(ObjectClassHandle object_class,
                                std::span<const AttributeRegions> pairs, RegionAction action) {
  check(object_class, pairs);
  for (const AttributeRegions& each : pairs)
    for (const RegionHandle region : each.regions)
      uses_.book.subscribe(object_class, each.attributes, region, action != RegionAction::remove);
  send_class(object_class, pairs, action);
}

void FederateRegions::request_update(ObjectClassHandle object_class,
                                     std::span<const AttributeRegions> pairs) {
  check(object_class, pairs);
  send_class(object_class, pairs, RegionAction::request_update);
}

void FederateRegions::send_class(ObjectClassHandle object_class,
                                 std::span<const AttributeRegions> pairs, RegionAction action) {
  for_each_message(pairs, [&](std::uint16_t count) {
    basis_.frames.enqueue(RegionalClassMessage{static_cast<std::uint16_t>(object_class.value),
                                               static_cast<std::uint8_t>(action), count, records_});
  });
}

void FederateRegions::subscribe(InteractionClassHandle interaction_class,
                                std::span<const RegionHandle> regions, Listening listening) {
  check(interaction_class, regions);
  for (const RegionHandle region : regions)
    uses_.book.subscribe(interaction_class, region, listening != Listening::none);
  write_numbers(regions);
  basis_.frames.enqueue(RegionalInteractionMessage{
      static_cast<std::uint16_t>(interaction_class.value), static_cast<std::uint8_t>(listening),
      static_cast<std::uint16_t>(regions.size()), records_});
}

void FederateRegions::send(InteractionClassHandle interaction_class, Bytes parameters,
                           std::span<const RegionHandle> regions, const Stamp& stamp) {
  check(interaction_class, regions);
  if (!uses_.updates.may_send(interaction_class, parameters, stamp)) return;
  write_numbers(regions);
  basis_.frames.enqueue(
      InteractionWithinMessage{static_cast<std::uint16_t>(interaction_class.value), stamp,
                               static_cast<std::uint16_t>(regions.size()), records_, parameters});
  ++basis_.counters.interactions_sent;
}

void FederateRegions::write_numbers(std::span<const RegionHandle> regions) {
  records_.clear();
  Writer writer(records_);
  for (const RegionHandle region : regions) {
    std::uint32_t number = uses_.book.number(region);
    writer.number(number);
  }
}

ObjectClassHandle FederateRegions::require_own(ObjectHandle object) const {
  const KnownObject* known = uses_.objects.find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  if (uses_.ownership.owned_of(object, *known).is_empty())
    throw RtiException(HlaError::attribute_not_owned,
                       "object " + std::to_string(object.value) + " is another federate's");
  return {known->object_class};
}

void FederateRegions::check(ObjectClassHandle object_class,
                            std::span<const AttributeRegions> pairs) const {
  if (object_class.value >= basis_.fom.object_classes().size())
    throw RtiException(HlaError::object_class_not_defined,
                       "object class " + std::to_string(object_class.value));
  const ObjectClass& known = basis_.fom.at(object_class);
  for (const AttributeRegions& each : pairs) {
    if (!basis_.fom.attributes(object_class).includes(each.attributes))
      throw RtiException(HlaError::attribute_not_defined,
                         "class '" + known.name + "' has not all of these attributes");
    for (const RegionHandle region : each.regions) {
      uses_.book.check(region);
      for (const AttributeHandle handle : each.attributes) {
        const Attribute& attribute = known.attributes[handle.value];
        uses_.book.check_context(region, attribute.dimensions,
                                 "attribute '" + attribute.name + "'");
      }
    }
  }
}

void FederateRegions::check(InteractionClassHandle interaction_class,
                            std::span<const RegionHandle> regions) const {
  if (interaction_class.value >= basis_.fom.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       "interaction class " + std::to_string(interaction_class.value));
  if (regions.empty() || regions.size() > regions_per_message_max)
    throw RtiException(HlaError::invalid_region,
                       "1 to " + std::to_string(regions_per_message_max) + " regions are needed");
  const InteractionClass& known = basis_.fom.at(interaction_class);
  for (const RegionHandle region : regions)
    uses_.book.check_context(region, known.dimensions, "interaction class '" + known.name + "'");
}

}  // namespace rink::rti
