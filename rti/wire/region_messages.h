// Messages about regions, and about subscriptions and updates within them.
#pragma once

#include <cstdint>

#include "im/filter.h"
#include "rti/distribution/data_distribution.h"
#include "rti/handles.h"
#include "rti/wire/message.h"

namespace rink::rti {

template <class Stream>
bool exchange(Stream& stream, RegionBounds& record) {
  im::Region& bounds = record.bounds;
  return stream.number(record.region.value) && stream.finite(bounds.low_x) &&
         stream.finite(bounds.low_y) && stream.finite(bounds.high_x) &&
         stream.finite(bounds.high_y) && bounds.low_x <= bounds.high_x &&
         bounds.low_y <= bounds.high_y;
}

/// `records` are, `count` times, a region handle (u32) and its bounds: low x, low y, high x, high y
/// (f64 each).
struct ModifyRegionsMessage {
  static constexpr MessageKind kind = MessageKind::modify_regions;
  static constexpr std::size_t record_size = 4 + 4 * 8;
  static constexpr std::size_t count_max = 1024;
  std::uint16_t count = 0;
  Bytes records;
};
template <class Stream>
bool exchange(Stream& stream, ModifyRegionsMessage& message) {
  return stream.range(message.count, ModifyRegionsMessage::count_max) &&
         stream.rest(message.records, message.count * ModifyRegionsMessage::record_size);
}

struct AssociateRegionMessage {
  static constexpr MessageKind kind = MessageKind::associate_region;
  std::uint32_t object = 0;
  std::uint32_t region = RegionHandle::none;
};
template <class Stream>
bool exchange(Stream& stream, AssociateRegionMessage& message) {
  return stream.number(message.object) && stream.number(message.region);
}

/// A region comes (its handle is free and at most one beyond the greatest ever used) or goes.
template <MessageKind k>
struct RegionMessage {
  static constexpr MessageKind kind = k;
  std::uint32_t region = 0;
};
template <class Stream, MessageKind k>
bool exchange(Stream& stream, RegionMessage<k>& message) {
  return stream.range(message.region, region_max - 1);
}
using CreateRegionMessage = RegionMessage<MessageKind::create_region>;
using DeleteRegionMessage = RegionMessage<MessageKind::delete_region>;

/// Most pairs or regions that one message names.
inline constexpr std::size_t regions_per_message_max = 1024;

/// `create_region` with dimensions: bit k stands for the model's dimension k, at least one.
struct CreateRegionOverMessage {
  static constexpr MessageKind kind = MessageKind::create_region_over;
  std::uint32_t region = 0;
  std::uint64_t dimensions = 0;
};
template <class Stream>
bool exchange(Stream& stream, CreateRegionOverMessage& message) {
  return stream.range(message.region, region_max - 1) && stream.number(message.dimensions) &&
         message.dimensions != 0;
}

template <class Stream>
bool exchange(Stream& stream, Range& range) {
  return stream.finite(range.low) && stream.finite(range.high) && range.low <= range.high;
}

/// Commits a region: `ranges` are low and high (f64 each) for each of its dimensions in ascending
/// order, both ends included; [lower, upper) of a dimension with an upper bound travels as lower
/// and upper - 1, which overlaps the same ranges.
struct ModifyRangesMessage {
  static constexpr MessageKind kind = MessageKind::modify_ranges;
  static constexpr std::size_t range_size = 2 * 8;
  std::uint32_t region = 0;
  std::uint8_t count = 0;
  Bytes ranges;
};
template <class Stream>
bool exchange(Stream& stream, ModifyRangesMessage& message) {
  return stream.range(message.region, region_max - 1) &&
         stream.range(message.count, dimension_max) &&
         stream.rest(message.ranges, message.count * ModifyRangesMessage::range_size);
}

/// Attributes, all of one page of 32, and a region that they are updated or subscribed in. Records
/// have one size, so that what holds many need not be read to find its end.
struct AttributeRegionRecord {
  static constexpr unsigned page_size = 32, page_max = AttributeSet::capacity / page_size - 1;
  AttributeBits attributes = 0;
  std::uint32_t region = 0;

  /// The part of a set that one record holds.
  static AttributeSet page(AttributeSet attributes, unsigned page) {
    return attributes & AttributeSet(AttributeBits{0xffffffffu} << page_size * page);
  }
};
template <class Stream>
bool exchange(Stream& stream, AttributeRegionRecord& record) {
  constexpr unsigned page_size = AttributeRegionRecord::page_size;
  std::uint32_t page = record.attributes == 0 ? 0 : lowest_bit(record.attributes) / page_size;
  auto word = static_cast<std::uint32_t>(record.attributes >> page_size * page);
  assert(Stream::is_reading || AttributeBits{word} << page_size * page == record.attributes);
  std::uint32_t place = page * region_max + record.region;
  if (!stream.number(word) ||
      !stream.range(place, (AttributeRegionRecord::page_max + 1) * region_max - 1))
    return false;
  if constexpr (Stream::is_reading) {
    page = place / region_max;
    record.region = place % region_max;
    record.attributes = AttributeBits{word} << page_size * page;
  }
  return record.attributes >> attribute_max == 0;
}

/// `pairs` are, `count` times, an AttributeRegionRecord.
struct RegionalClassMessage {
  static constexpr MessageKind kind = MessageKind::regional_class;
  static constexpr std::size_t pair_size = 4 + 4;
  std::uint16_t object_class = 0;
  std::uint8_t action = 0;  ///< RegionAction
  std::uint16_t count = 0;
  Bytes pairs;
};
template <class Stream>
bool exchange(Stream& stream, RegionalClassMessage& message) {
  return stream.number(message.object_class) &&
         stream.range(message.action, static_cast<std::uint64_t>(RegionAction::add_passively)) &&
         stream.range(message.count, regions_per_message_max) &&
         stream.rest(message.pairs, message.count * RegionalClassMessage::pair_size);
}

/// Subscribes to an interaction class within each of the regions (u32 each), or no longer.
struct RegionalInteractionMessage {
  static constexpr MessageKind kind = MessageKind::regional_interaction;
  std::uint16_t interaction_class = 0;
  std::uint8_t is_subscribed = 1;  ///< a Listening
  std::uint16_t count = 0;
  Bytes regions;
};
template <class Stream>
bool exchange(Stream& stream, RegionalInteractionMessage& message) {
  return stream.number(message.interaction_class) && stream.range(message.is_subscribed, 2) &&
         stream.range(message.count, regions_per_message_max) &&
         stream.rest(message.regions, message.count * sizeof(std::uint32_t));
}

/// Adds each pair's region to those that its attributes are updated in, or takes it away.
struct AssociateRegionsMessage {
  static constexpr MessageKind kind = MessageKind::associate_regions;
  std::uint32_t object = 0;
  std::uint8_t is_associated = 1;
  std::uint16_t count = 0;
  Bytes pairs;
};
template <class Stream>
bool exchange(Stream& stream, AssociateRegionsMessage& message) {
  return stream.number(message.object) && stream.range(message.is_associated, 1) &&
         stream.range(message.count, regions_per_message_max) &&
         stream.rest(message.pairs, message.count * RegionalClassMessage::pair_size);
}

/// Asks an owner for attributes of its object.
struct ProvideUpdateMessage {
  static constexpr MessageKind kind = MessageKind::provide_update;
  std::uint32_t object = 0;
  AttributeBits attributes = 0;
  Bytes tag;
};
template <class Stream>
bool exchange(Stream& stream, ProvideUpdateMessage& message) {
  return stream.varint(message.object) && attribute_bits(stream, message.attributes) &&
         stream.template bytes<std::uint16_t>(message.tag, 1024);
}

/// An interaction for those who subscribe without a region, or with one that overlaps one of
/// `regions` (u32 each).
struct InteractionWithinMessage {
  static constexpr MessageKind kind = MessageKind::interaction_within;
  std::uint16_t interaction_class = 0;
  Stamp stamp;
  std::uint16_t count = 0;
  Bytes regions;
  Bytes parameters;
};
template <class Stream>
bool exchange(Stream& stream, InteractionWithinMessage& message) {
  return stream.number(message.interaction_class) && exchange(stream, message.stamp) &&
         stream.range(message.count, regions_per_message_max) &&
         stream.rest(message.regions, message.count * sizeof(std::uint32_t)) &&
         stream.template bytes<std::uint16_t>(message.parameters, parameters_max);
}

/// The handles that a message names one after the other.
inline std::vector<RegionHandle> regions_of(Bytes bytes) {
  std::vector<RegionHandle> regions(bytes.size() / sizeof(std::uint32_t));
  Reader reader(bytes);
  for (RegionHandle& each : regions) reader.number(each.value);
  return regions;
}

}  // namespace rink::rti
