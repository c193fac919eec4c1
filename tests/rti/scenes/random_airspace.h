// Pilots who move, subscribe and register at random, against the standard's definition of overlap
// applied to every pair of their regions.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "tests/rti/scenes/airspace.h"

namespace rink::rti::testing {

/// What a region is to the test: dimensions, and ranges as they were handed in and last committed.
struct Area {
  RegionHandle handle;
  DimensionSet dimensions;
  std::map<std::uint32_t, Range> set, committed;
};

/// IEEE 1516.1-2010, 9.1: two regions overlap if they have a dimension in common, and their ranges
/// overlap in each such. [low, high) of whole numbers for the channel.
inline bool overlap(const Area& a, const Area& b) {
  const DimensionSet common = a.dimensions & b.dimensions;
  if (common.is_empty() || a.committed.empty() || b.committed.empty()) return false;
  bool all = true;
  common.for_each([&](DimensionHandle each) {
    const Range &p = a.committed.at(each.value), &q = b.committed.at(each.value);
    all = all &&
          (each == channel ? p.low < q.high && q.low < p.high : p.low <= q.high && q.low <= p.high);
  });
  return all;
}

/// A pilot and what it did, as far as overlap depends on it.
struct Planner : Pilot {
  std::deque<Area> areas;
  std::map<std::uint32_t, std::map<std::uint32_t, AttributeSet>>
      updates;  ///< by object: attributes by the index of their area
  std::vector<ObjectHandle> objects;
  std::map<std::uint32_t, AttributeSet> subscriptions;  ///< by the index of the area
  std::vector<std::uint32_t> calls;                     ///< areas in which it listens
  AttributeSet everywhere;
};

/// Pilots who move, subscribe and register at random.
class Airspace : public Flights<Planner> {
 public:
  Airspace(unsigned seed, int pilots) : Flights(pilots), random_(seed) {}
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool by_chance(int in_ten) { return below(10) < in_ten; }

  std::uint32_t add_area(Planner& pilot) {
    Area area;
    const std::uint64_t bits = 1 + random_() % 15;
    area.dimensions = DimensionSet(by_chance(4) ? DimensionSet{x, y}.bits : bits);
    area.handle = pilot.ambassador.create_region(area.dimensions);
    pilot.areas.push_back(area);
    if (by_chance(9)) move(pilot, pilot.areas.back());
    return static_cast<std::uint32_t>(pilot.areas.size() - 1);
  }
  /// Small whole numbers, so that ranges often touch.
  void move(Planner& pilot, Area& area) {
    area.dimensions.for_each([&](DimensionHandle each) {
      if (area.set.contains(each.value) && by_chance(4)) return;
      Range range{static_cast<double>(below(5)), 0.0};
      const int size = below(3);
      range.high = range.low + size;
      if (each == channel) range.high = std::min(6.0, range.high + 1.0);
      area.set[each.value] = range;
      pilot.ambassador.set_range_bounds(area.handle, each, range);
    });
    area.committed = area.set;
    pilot.ambassador.commit_region_modifications(area.handle);
  }
  AttributeSet some_attributes() {
    const AttributeSet set(static_cast<std::uint32_t>(1 + below(3)));
    return set;  // position, radio or both
  }
  void change_subscription(Planner& pilot) {
    const std::uint32_t area =
        pilot.areas.empty() || by_chance(3)
            ? add_area(pilot)
            : static_cast<std::uint32_t>(below(static_cast<int>(pilot.areas.size())));
    const AttributeSet set = some_attributes();
    const AttributeRegions pair{set, {pilot.areas[area].handle}};
    AttributeSet& now = pilot.subscriptions[area];
    if (by_chance(6)) {
      pilot.ambassador.subscribe_object_class_attributes_with_regions(aircraft,
                                                                      std::span(&pair, 1));
      now = now | set;
    } else {
      pilot.ambassador.unsubscribe_object_class_attributes_with_regions(aircraft,
                                                                        std::span(&pair, 1));
      now = now.without(set);
    }
  }
  void change_listening(Planner& pilot) {
    const std::uint32_t area =
        pilot.areas.empty() || by_chance(3)
            ? add_area(pilot)
            : static_cast<std::uint32_t>(below(static_cast<int>(pilot.areas.size())));
    const auto found = std::ranges::find(pilot.calls, area);
    if (found == pilot.calls.end()) {
      pilot.ambassador.subscribe_interaction_class_with_regions(
          call, std::span(&pilot.areas[area].handle, 1));
      pilot.calls.push_back(area);
    } else {
      pilot.ambassador.unsubscribe_interaction_class_with_regions(
          call, std::span(&pilot.areas[area].handle, 1));
      pilot.calls.erase(found);
    }
  }
  void change_objects(Planner& pilot) {
    if (pilot.objects.empty() || by_chance(4)) {
      const std::uint32_t area = add_area(pilot);
      const AttributeSet set = some_attributes();
      const AttributeRegions pair{set, {pilot.areas[area].handle}};
      const ObjectHandle object =
          pilot.ambassador.register_object_instance_with_regions(aircraft, std::span(&pair, 1));
      pilot.objects.push_back(object);
      pilot.updates[object.value][area] = set;
      return;
    }
    const std::size_t at = static_cast<std::size_t>(below(static_cast<int>(pilot.objects.size())));
    const ObjectHandle object = pilot.objects[at];
    if (by_chance(2)) {
      pilot.ambassador.delete_object_instance(object);
      pilot.updates.erase(object.value);
      pilot.objects.erase(pilot.objects.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    }
    const std::uint32_t area =
        static_cast<std::uint32_t>(below(static_cast<int>(pilot.areas.size())));
    const AttributeSet set = some_attributes();
    const AttributeRegions pair{set, {pilot.areas[area].handle}};
    AttributeSet& now = pilot.updates[object.value][area];
    if (by_chance(6)) {
      pilot.ambassador.associate_regions_for_updates(object, std::span(&pair, 1));
      now = now | set;
    } else {
      pilot.ambassador.unassociate_regions_for_updates(object, std::span(&pair, 1));
      now = now.without(set);
    }
  }
  void change(Planner& pilot) {
    for (Area& area : pilot.areas)
      if (by_chance(4)) move(pilot, area);
    if (by_chance(5)) change_subscription(pilot);
    if (by_chance(4)) change_listening(pilot);
    if (by_chance(5)) change_objects(pilot);
    if (by_chance(1)) {
      pilot.everywhere = by_chance(5) ? AttributeSet{weight} : AttributeSet{};
      pilot.ambassador.subscribe_object_class_attributes(aircraft, pilot.everywhere);
    }
  }

  /// The standard's answer: which attributes of `object` are in scope for `pilot`.
  static AttributeSet due(const Planner& owner, ObjectHandle object, const Planner& pilot) {
    AttributeSet set = pilot.everywhere;
    for (const AttributeHandle attribute : {where, radio, weight}) {
      bool has_region = false, is_inside = false;
      for (const auto& [area, attributes] : owner.updates.at(object.value)) {
        if (!attributes.contains(attribute)) continue;
        has_region = true;
        for (const auto& [wanted, subscribed] : pilot.subscriptions)
          is_inside |=
              subscribed.contains(attribute) && overlap(owner.areas[area], pilot.areas[wanted]);
      }
      if (!has_region)
        for (const auto& [wanted, subscribed] : pilot.subscriptions)
          is_inside |= subscribed.contains(attribute);
      if (is_inside) set.insert(attribute);
    }
    return set;
  }
  void expect_scope_is_due() {
    for (const Planner& owner : pilots())
      for (const ObjectHandle object : owner.objects)
        for (const Planner& pilot : pilots()) {
          if (&pilot == &owner) continue;
          const auto known = pilot.heard.objects.find(object.value);
          const bool is_in_scope = known != pilot.heard.objects.end() && known->second.is_in_scope;
          ASSERT_EQ(is_in_scope, !due(owner, object, pilot).is_empty())
              << "object " << object.value;
        }
  }
  /// Each owner says all of each object; each pilot must hear exactly the attributes that are due.
  void expect_updates_are_due(float value) {
    for (Planner& owner : pilots())
      for (const ObjectHandle object : owner.objects)
        owner.ambassador.update_attribute_values(
            object, AttributeSet{where, radio, weight},
            values_of(double{value}, double{value}, double{value}), {});
    for (Planner& pilot : pilots())
      for (auto& [object, known] : pilot.heard.objects) known.values.clear();
    tick();
    for (const Planner& owner : pilots())
      for (const ObjectHandle object : owner.objects)
        for (const Planner& pilot : pilots()) {
          if (&pilot == &owner) continue;
          AttributeSet heard;
          const auto known = pilot.heard.objects.find(object.value);
          if (known != pilot.heard.objects.end())
            for (const auto& [attribute, bytes] : known->second.values) heard.insert({attribute});
          ASSERT_EQ(heard.bits, due(owner, object, pilot).bits) << "object " << object.value;
        }
  }
  void expect_calls_are_due() {
    for (Planner& sender : pilots()) {
      if (sender.areas.empty()) continue;
      std::vector<std::uint32_t> areas{
          static_cast<std::uint32_t>(below(static_cast<int>(sender.areas.size())))};
      if (by_chance(5))
        areas.push_back(static_cast<std::uint32_t>(below(static_cast<int>(sender.areas.size()))));
      std::vector<RegionHandle> regions;
      for (const std::uint32_t area : areas) regions.push_back(sender.areas[area].handle);
      for (Planner& pilot : pilots()) pilot.heard.interactions.clear();
      sender.ambassador.send_interaction_with_regions(call, values_of(std::uint8_t{1}), regions,
                                                      {});
      tick();
      for (const Planner& pilot : pilots()) {
        bool is_due = false;
        for (const std::uint32_t area : areas)
          for (const std::uint32_t listened : pilot.calls)
            is_due |= overlap(sender.areas[area], pilot.areas[listened]);
        ASSERT_EQ(!pilot.heard.interactions.empty(), is_due && &pilot != &sender);
      }
    }
  }
  void step() {
    for (Planner& pilot : pilots()) change(pilot);
    tick();
  }

 private:
  std::mt19937 random_;
};

}  // namespace rink::rti::testing
