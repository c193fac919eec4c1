// A federate's own regions: their templates, what uses them, and whether they may be used so.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/fom/fom.h"
#include "rti/hla_error.h"
#include "rti/objects/object_map.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Every member but the unchecked ones for bulk changes throws `RtiException` before it changes
/// anything: InvalidRegion for a handle of no region, RegionNotCreatedByThisFederate for another
/// federate's. A handle holds a mark of its federate's name beside the number that the wire
/// carries; two federates have equal marks once in 16,383.
class RegionBook {
 public:
  static constexpr std::uint32_t number_bits = 18;

  explicit RegionBook(const Fom& fom) : fom_(fom) {}
  /// Call it before the first region is made.
  void sign(std::string_view federate_name);

  /// Without dimensions: over the plane of X and Y [m], whether or not the model has them. Empty if
  /// all numbers are in use.
  RegionHandle create(DimensionSet dimensions);
  /// Throws RegionInUseForUpdateOrSubscription if the region is in use; objects for which
  /// `is_own(ObjectHandle)` is false do not count.
  template <class IsOwn>
  void remove(RegionHandle region, IsOwn is_own) {
    const std::uint32_t number = check(region);
    if (entries_[number].use_count > 0) release_lost(number, is_own);
    if (entries_[number].use_count > 0)
      throw RtiException(HlaError::region_in_use_for_update_or_subscription, name(region));
    release(number);
  }

  /// The region's number on the wire.
  std::uint32_t check(RegionHandle region) const;
  /// The number without a check that the region exists, for bulk changes.
  std::uint32_t number(RegionHandle region) const {
    assert(region.value >> number_bits == mark_ && (region.value & number_mask) < entries_.size());
    return region.value & number_mask;
  }
  bool is_planar(RegionHandle region) const { return entries_[check(region)].is_planar; }
  DimensionSet dimensions(RegionHandle region) const;

  /// The region must be planar.
  void set_plane(RegionHandle region, const im::Region& bounds);
  void set_plane_unchecked(std::uint32_t number, const im::Region& bounds) {
    assert(number < entries_.size());
    entries_[number].plane = bounds;
  }
  const im::Region& plane(std::uint32_t number) const { return entries_[number].plane; }
  /// Throws RegionDoesNotContainSpecifiedDimension and InvalidRangeBound. With an upper bound the
  /// range has whole numbers, 0 <= low < high <= bound, and excludes `high`; without one it is
  /// finite, low <= high, and includes both.
  void set_range(RegionHandle region, DimensionHandle dimension, const Range& range);
  /// The range as it was set. A range that was not set is the whole dimension if that has an upper
  /// bound, else InvalidRegion is thrown.
  Range range(RegionHandle region, DimensionHandle dimension) const;
  /// Closed ranges as the wire carries them, one for each dimension in ascending order. Throws
  /// InvalidRegion if a range is needed that was never set.
  void closed_ranges(RegionHandle region, std::vector<Range>& ranges) const;

  /// Throws InvalidRegionContext unless every dimension of the region is one of `available`, which
  /// `of` has.
  void check_context(RegionHandle region, DimensionSet available, std::string_view of) const;

  /// Note what uses which region. The pairs have been checked.
  void subscribe(ObjectClassHandle object_class, AttributeSet attributes, RegionHandle region,
                 bool is_added);
  void replace_subscription(ObjectClassHandle object_class, AttributeSet attributes,
                            RegionHandle region);
  void subscribe(InteractionClassHandle interaction_class, RegionHandle region, bool is_added);
  /// All attributes of the object use the region alone, or none if the handle is empty.
  void associate(ObjectHandle object, RegionHandle region);
  /// `all` are the attributes of the object's class.
  void associate(ObjectHandle object, AttributeSet all, AttributeSet attributes,
                 RegionHandle region, bool is_added);
  void forget(ObjectHandle object);

  std::size_t memory_bytes() const;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, mark_, entries_, free_, templates_, subscriptions_, whole_, partial_) &&
           (!Stream::is_reading || is_sound());
  }

 private:
  static constexpr std::uint32_t number_mask = (1u << number_bits) - 1;
  struct Entry {
    im::Region plane;
    std::uint32_t use_count = 0;  ///< subscriptions and associations
    bool exists = false, is_planar = true;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, plane, use_count, exists, is_planar);
    }
  };
  struct Template {
    DimensionSet dimensions;
    std::vector<std::optional<Range>> ranges;  ///< by rank
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, dimensions, ranges);
    }
  };
  struct Association {
    std::uint32_t region = 0;
    AttributeSet attributes;  ///< all: of the whole object
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, region, attributes);
    }
  };
  /// True if all numbers are those of regions that exist, and free ones of those that do not.
  bool is_sound() const;
  static std::string name(RegionHandle region);
  std::size_t rank(const Template& all, RegionHandle region, DimensionHandle dimension) const;
  void release(std::uint32_t number);
  template <class IsOwn>
  void release_lost(std::uint32_t number, IsOwn is_own) {
    for (const ObjectHandle object : users_of(number))
      if (!is_own(object)) forget(object);
  }
  std::vector<ObjectHandle> users_of(std::uint32_t number) const;
  void set_subscription(std::uint64_t key, AttributeSet attributes);

  const Fom& fom_;
  std::uint32_t mark_ = 0;
  std::vector<Entry> entries_;  ///< by number
  std::vector<std::uint32_t> free_;
  std::unordered_map<std::uint32_t, Template> templates_;  ///< of regions that are not planar
  std::unordered_map<std::uint64_t, AttributeSet>
      subscriptions_;               ///< by kind, class and region; interactions with one bit
  ObjectMap<std::uint32_t> whole_;  ///< the one region of an object
  std::unordered_map<std::uint32_t, std::vector<Association>> partial_;
};

}  // namespace rink::rti
