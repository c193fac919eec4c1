// The services of data distribution management at the federate's side (IEEE 1516.1-2010, clause 9).
#include <algorithm>

#include "rti/federate/ambassador_services.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

/// Gathers the pairs, as many as a message takes at once, in `region_records_`, and calls
/// `tell(count)` for each message.
template <class Tell>
void AmbassadorParts::for_each_message(std::span<const AttributeRegions> pairs, Tell tell) {
  region_records_.clear();
  Writer writer(region_records_);
  std::uint16_t count = 0;
  for (const AttributeRegions& each : pairs)
    for (const RegionHandle region : each.regions) {
      AttributeRegionRecord record{each.attributes.bits, regions_.number(region)};
      exchange(writer, record);
      if (++count < regions_per_message_max) continue;
      tell(count);
      region_records_.clear();
      count = 0;
    }
  if (count > 0) tell(count);
}

RegionHandle AmbassadorServices::create_region() {
  const RegionHandle region = regions_.create({});
  if (region) frames_.enqueue(CreateRegionMessage{regions_.number(region)});
  return region;
}

RegionHandle AmbassadorServices::create_region(DimensionSet dimensions) {
  if (dimensions.is_empty())
    throw RtiException(HlaError::invalid_dimension_handle, "a region needs a dimension");
  dimensions.for_each([this](DimensionHandle each) { check(each); });
  const RegionHandle region = regions_.create(dimensions);
  if (region) frames_.enqueue(CreateRegionOverMessage{regions_.number(region), dimensions.bits});
  return region;
}

void AmbassadorServices::set_region(RegionHandle region, const im::Region& bounds) {
  regions_.set_plane(region, bounds);
}
void AmbassadorServices::set_range_bounds(RegionHandle region, DimensionHandle dimension,
                                          const Range& range) {
  regions_.set_range(region, dimension, range);
}
Range AmbassadorServices::get_range_bounds(RegionHandle region, DimensionHandle dimension) const {
  return regions_.range(region, dimension);
}
DimensionSet AmbassadorServices::get_dimension_handle_set(RegionHandle region) const {
  return regions_.dimensions(region);
}

void AmbassadorServices::commit_region_modifications(RegionHandle region) {
  commit_region_modifications(std::span(&region, 1));
}

void AmbassadorServices::commit_region_modifications(std::span<const RegionHandle> regions) {
  for (const RegionHandle region : regions)
    if (!regions_.is_planar(region))
      regions_.closed_ranges(region, ranges_);  // all are checked before any is said
  for (const RegionHandle region : regions) {
    if (regions_.is_planar(region)) {
      const RegionBounds one{region, regions_.plane(regions_.number(region))};
      commit_region_modifications(std::span(&one, 1));
      continue;
    }
    regions_.closed_ranges(region, ranges_);
    region_records_.clear();
    Writer writer(region_records_);
    for (Range& each : ranges_) exchange(writer, each);
    frames_.enqueue(ModifyRangesMessage{
        regions_.number(region), static_cast<std::uint8_t>(ranges_.size()), region_records_});
  }
}

void AmbassadorServices::commit_region_modifications(std::span<const RegionBounds> regions) {
  while (!regions.empty()) {
    const auto chunk = regions.first(std::min(regions.size(), ModifyRegionsMessage::count_max));
    regions = regions.subspan(chunk.size());
    region_records_.clear();
    Writer writer(region_records_);
    for (RegionBounds each : chunk) {
      assert(each.bounds.low_x <= each.bounds.high_x && each.bounds.low_y <= each.bounds.high_y);
      each.region.value = regions_.number(each.region);
      regions_.set_plane_unchecked(each.region.value, each.bounds);
      exchange(writer, each);
    }
    frames_.enqueue(
        ModifyRegionsMessage{static_cast<std::uint16_t>(chunk.size()), region_records_});
  }
}

void AmbassadorServices::delete_region(RegionHandle region) {
  const std::uint32_t number = regions_.check(region);
  regions_.remove(region, [this](ObjectHandle object) {
    return objects_.find(object) != nullptr && !owned_of(object, *objects_.find(object)).is_empty();
  });
  frames_.enqueue(DeleteRegionMessage{number});
}

void AmbassadorServices::associate_regions_for_updates(ObjectHandle object, RegionHandle region) {
  own_class(object);
  const std::uint32_t number = region ? regions_.check(region) : RegionHandle::none;
  regions_.associate(object, region);
  frames_.enqueue(AssociateRegionMessage{object.value, number});
}

void AmbassadorServices::associate_regions_for_updates(ObjectHandle object,
                                                       std::span<const AttributeRegions> pairs) {
  associate_regions(object, pairs, true);
}
void AmbassadorServices::unassociate_regions_for_updates(ObjectHandle object,
                                                         std::span<const AttributeRegions> pairs) {
  associate_regions(object, pairs, false);
}

void AmbassadorParts::associate_regions(ObjectHandle object,
                                        std::span<const AttributeRegions> pairs, bool is_added) {
  const ObjectClassHandle object_class = own_class(object);
  check(object_class, pairs);
  for (const AttributeRegions& each : pairs)
    for (const RegionHandle region : each.regions)
      regions_.associate(object, fom_.attributes(object_class), each.attributes, region, is_added);
  for_each_message(pairs, [&](std::uint16_t count) {
    frames_.enqueue(AssociateRegionsMessage{object.value, is_added, count, region_records_});
  });
}

ObjectHandle AmbassadorServices::register_object_instance_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs,
    std::string_view name) {
  check(object_class, pairs);
  const ObjectHandle object = register_object_instance(object_class, name);
  if (object) associate_regions(object, pairs, true);
  return object;
}

void AmbassadorServices::subscribe_object_class_attributes_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs, bool is_active) {
  subscribe_with_regions(object_class, pairs,
                         is_active ? RegionAction::add : RegionAction::add_passively);
}
void AmbassadorServices::unsubscribe_object_class_attributes_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) {
  subscribe_with_regions(object_class, pairs, RegionAction::remove);
}

void AmbassadorParts::subscribe_with_regions(ObjectClassHandle object_class,
                                             std::span<const AttributeRegions> pairs,
                                             RegionAction action) {
  check(object_class, pairs);
  for (const AttributeRegions& each : pairs)
    for (const RegionHandle region : each.regions)
      regions_.subscribe(object_class, each.attributes, region, action != RegionAction::remove);
  say_regional_class(object_class, pairs, action);
}

void AmbassadorServices::request_attribute_value_update_with_regions(
    ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) {
  check(object_class, pairs);
  say_regional_class(object_class, pairs, RegionAction::request_update);
}

bool AmbassadorParts::take_provide_update(Reader& reader) {
  ProvideUpdateMessage message;
  if (!exchange(reader, message)) return false;
  const KnownObject* known = objects_.find({message.object});
  const AttributeSet attributes{message.attributes};
  if (known == nullptr) return objects_.is_gone({message.object});
  if (!fom_.attributes(ObjectClassHandle{known->object_class}).includes(attributes)) return false;
  callbacks_.provide_attribute_value_update({message.object}, attributes, message.tag);
  return true;
}

void AmbassadorParts::say_regional_class(ObjectClassHandle object_class,
                                         std::span<const AttributeRegions> pairs,
                                         RegionAction action) {
  for_each_message(pairs, [&](std::uint16_t count) {
    frames_.enqueue(RegionalClassMessage{static_cast<std::uint16_t>(object_class.value),
                                         static_cast<std::uint8_t>(action), count,
                                         region_records_});
  });
}

void AmbassadorServices::subscribe_interaction_class_with_regions(
    InteractionClassHandle interaction_class, std::span<const RegionHandle> regions,
    bool is_active) {
  subscribe_with_regions(interaction_class, regions,
                         is_active ? Listening::active : Listening::passive);
}
void AmbassadorServices::unsubscribe_interaction_class_with_regions(
    InteractionClassHandle interaction_class, std::span<const RegionHandle> regions) {
  subscribe_with_regions(interaction_class, regions, Listening::none);
}

void AmbassadorParts::subscribe_with_regions(InteractionClassHandle interaction_class,
                                             std::span<const RegionHandle> regions,
                                             Listening listening) {
  check(interaction_class, regions);
  for (const RegionHandle region : regions)
    regions_.subscribe(interaction_class, region, listening != Listening::none);
  write_numbers(regions);
  frames_.enqueue(RegionalInteractionMessage{
      static_cast<std::uint16_t>(interaction_class.value), static_cast<std::uint8_t>(listening),
      static_cast<std::uint16_t>(regions.size()), region_records_});
}

void AmbassadorServices::send_interaction_with_regions(InteractionClassHandle interaction_class,
                                                       Bytes parameters,
                                                       std::span<const RegionHandle> regions,
                                                       const Stamp& stamp) {
  check(interaction_class, regions);
  require_published(interaction_class);
  require_parameters(parameters);
  require_stamp(stamp);
  if (spares_interaction(interaction_class)) return;
  write_numbers(regions);
  frames_.enqueue(InteractionWithinMessage{static_cast<std::uint16_t>(interaction_class.value),
                                           stamp, static_cast<std::uint16_t>(regions.size()),
                                           region_records_, parameters});
  ++counters_.interactions_sent;
}

void AmbassadorParts::write_numbers(std::span<const RegionHandle> regions) {
  region_records_.clear();
  Writer writer(region_records_);
  for (const RegionHandle region : regions) {
    std::uint32_t number = regions_.number(region);
    writer.number(number);
  }
}

ObjectClassHandle AmbassadorParts::own_class(ObjectHandle object) {
  const KnownObject* known = objects_.find(object);
  if (known == nullptr)
    throw RtiException(HlaError::object_instance_not_known,
                       "object " + std::to_string(object.value));
  if (owned_of(object, *known).is_empty())
    throw RtiException(HlaError::attribute_not_owned,
                       "object " + std::to_string(object.value) + " is another federate's");
  return {known->object_class};
}

void AmbassadorParts::check(ObjectClassHandle object_class,
                            std::span<const AttributeRegions> pairs) const {
  if (object_class.value >= fom_.object_classes().size())
    throw RtiException(HlaError::object_class_not_defined,
                       "object class " + std::to_string(object_class.value));
  const ObjectClass& known = fom_.at(object_class);
  for (const AttributeRegions& each : pairs) {
    if (!fom_.attributes(object_class).includes(each.attributes))
      throw RtiException(HlaError::attribute_not_defined,
                         "class '" + known.name + "' has not all of these attributes");
    for (const RegionHandle region : each.regions) {
      regions_.check(region);
      for (std::uint32_t bits = each.attributes.bits; bits != 0; bits &= bits - 1) {
        const Attribute& attribute =
            known.attributes[static_cast<std::size_t>(std::countr_zero(bits))];
        regions_.check_context(region, attribute.dimensions, "attribute '" + attribute.name + "'");
      }
    }
  }
}

void AmbassadorParts::check(InteractionClassHandle interaction_class,
                            std::span<const RegionHandle> regions) const {
  if (interaction_class.value >= fom_.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       "interaction class " + std::to_string(interaction_class.value));
  if (regions.empty() || regions.size() > regions_per_message_max)
    throw RtiException(HlaError::invalid_region,
                       "1 to " + std::to_string(regions_per_message_max) + " regions are needed");
  const InteractionClass& known = fom_.at(interaction_class);
  for (const RegionHandle region : regions)
    regions_.check_context(region, known.dimensions, "interaction class '" + known.name + "'");
}

}  // namespace rink::rti
