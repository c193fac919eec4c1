// What sailors of a regatta do: each function calls one service by chance, grouped by subject.
#pragma once

#include <string>
#include <vector>

#include "rti/management/management_values.h"
#include "rti/time/federate_clock.h"
#include "tests/rti/scenes/regatta.h"

namespace rink::rti::testing::at_the_regatta {

inline const ObjectClassHandle yacht = *regatta().object_class("Yacht"),
                               cruiser = *regatta().object_class("Cruiser"),
                               buoy = *regatta().object_class("Buoy");
inline const InteractionClassHandle hailing = *regatta().interaction_class("Hail"),
                                    distress = *regatta().interaction_class("Mayday");

inline ObjectClassHandle any_class(Regatta& all) {
  return std::array{yacht, cruiser, cruiser, buoy}[all.below(4)];
}
inline InteractionClassHandle any_interaction(Regatta& all) {
  return all.one_in(2) ? hailing : distress;
}
inline AttributeSet any_of(Regatta& all, ObjectClassHandle object_class) {
  const AttributeSet whole = regatta().attributes(object_class);
  const AttributeSet some = whole & AttributeSet(static_cast<std::uint32_t>(all.below(8)));
  return some.is_empty() || all.one_in(2) ? whole : some;
}
/// With the privilege to delete now and then.
inline AttributeSet any_owned(Regatta& all, ObjectClassHandle object_class) {
  AttributeSet some = any_of(all, object_class);
  if (all.one_in(3)) some.insert(privilege_to_delete_object);
  return some;
}
inline std::pair<ObjectHandle, ObjectClassHandle> any_object(Regatta& all, Sailor& sailor) {
  if (sailor.objects.empty()) return {ObjectHandle{0}, yacht};
  const auto found = std::next(sailor.objects.begin(),
                               static_cast<std::ptrdiff_t>(all.below(sailor.objects.size())));
  return {ObjectHandle{found->first}, ObjectClassHandle{found->second}};
}
inline RegionHandle any_region(Regatta& all, const Sailor& sailor) {
  return sailor.regions.empty() ? RegionHandle{0}
                                : sailor.regions[all.below(sailor.regions.size())];
}
inline std::vector<std::byte> any_values(Regatta& all, ObjectClassHandle object_class,
                                         AttributeSet set) {
  std::vector<std::byte> values;
  const auto add = [&](const std::vector<std::byte>& more) {
    values.insert(values.end(), more.begin(), more.end());
  };
  set.for_each([&](AttributeHandle each) {
    const std::string& name = regatta().at(object_class).attributes[each.value].name;
    const auto number = static_cast<double>(all.below(100));
    if (name == "place") add(values_of(number));
    if (name == "speed") add(values_of(static_cast<float>(number)));
    if (name == "destination") add(varying(std::string(all.below(12), 'x')));
    if (name == "drift") add(values_of(number, number + 1.0));
  });
  return values;
}

inline void declare(Regatta& all, Sailor& sailor) {
  Ambassador& to = sailor.ambassador;
  const ObjectClassHandle object_class = any_class(all);
  const bool is_active = !all.one_in(4);
  switch (all.below(10)) {
    case 0:
    case 1:
      return to.publish_object_class_attributes(object_class, any_of(all, object_class));
    case 2:
    case 3:
    case 4:
      return to.subscribe_object_class_attributes(object_class, any_of(all, object_class), {},
                                                  is_active);
    case 5:
      if (all.one_in(3)) return to.unpublish_object_class(object_class);
      return to.unsubscribe_object_class(object_class);
    case 6:
      return to.publish_interaction_class(any_interaction(all));
    case 7:
      return to.subscribe_interaction_class(any_interaction(all), is_active);
    case 8:
      if (all.one_in(2)) return to.unpublish_interaction_class(any_interaction(all));
      return to.unsubscribe_interaction_class(any_interaction(all));
    default:
      if (all.one_in(2)) return to.enable_attribute_relevance_advisory_switch();
      return to.disable_attribute_relevance_advisory_switch();
  }
}

inline void stand_by(Regatta&, Sailor&) {}
inline void publish_all(Regatta&, Sailor& sailor) {
  for (const ObjectClassHandle each : {yacht, cruiser, buoy})
    sailor.ambassador.publish_object_class_attributes(each, regatta().attributes(each));
  for (const InteractionClassHandle each : {hailing, distress})
    sailor.ambassador.publish_interaction_class(each);
}
/// What most do first, so that there is something to talk about.
inline void prepare(Regatta& all, Sailor& sailor) {
  publish_all(all, sailor);
  for (const ObjectClassHandle each : {yacht, cruiser, buoy})
    sailor.ambassador.subscribe_object_class_attributes(each, regatta().attributes(each));
  for (const InteractionClassHandle each : {hailing, distress})
    sailor.ambassador.subscribe_interaction_class(each);
}

inline void register_one(Regatta& all, Sailor& sailor) {
  const ObjectClassHandle object_class = any_class(all);
  std::string name;
  if (all.one_in(3)) name = "boat " + std::to_string(all.below(20));
  const ObjectHandle object = sailor.ambassador.register_object_instance(object_class, name);
  if (object) sailor.objects[object.value] = object_class.value;
}

inline void update(Regatta& all, Sailor& sailor) {
  const auto [object, object_class] = any_object(all, sailor);
  const AttributeSet set = any_of(all, object_class);
  sailor.ambassador.update_attribute_values(object, set, any_values(all, object_class, set),
                                            {static_cast<double>(all.below(50)), all.below(3)});
}

inline void say(Regatta& all, Sailor& sailor) {
  const std::vector<std::byte> words = varying(std::string(all.below(30), 'w'));
  if (!all.one_in(3))
    return sailor.ambassador.send_interaction(any_interaction(all), words, {1.0, 2});
  const FederateHandle receiver{static_cast<std::uint32_t>(all.below(all.seat_count()))};
  sailor.ambassador.send_directed_interaction(any_interaction(all), receiver, words, {1.0, 2});
}

inline void delete_one(Regatta& all, Sailor& sailor) {
  const ObjectHandle object = any_object(all, sailor).first;
  if (all.one_in(3)) sailor.ambassador.local_delete_object_instance(object);
  else sailor.ambassador.delete_object_instance(object);
  sailor.objects.erase(object.value);
}

inline void ask(Regatta& all, Sailor& sailor) {
  const auto [object, object_class] = any_object(all, sailor);
  const std::vector<std::byte> tag = bytes_of(std::string(all.below(3), 't'));
  const AttributeSet set = any_of(all, object_class);
  if (all.one_in(2)) sailor.ambassador.request_attribute_value_update(object_class, set, tag);
  else sailor.ambassador.request_attribute_value_update(object, set, tag);
}

inline void name(Regatta& all, Sailor& sailor) {
  const std::string one = "boat " + std::to_string(all.below(20)),
                    other = "boat " + std::to_string(all.below(20));
  const std::vector<std::string_view> both{one, other};
  Ambassador& to = sailor.ambassador;
  switch (all.below(4)) {
    case 0:
      return to.reserve_object_instance_name(one);
    case 1:
      return to.reserve_multiple_object_instance_names(both);
    case 2:
      return to.release_object_instance_name(one);
    default:
      return to.release_multiple_object_instance_names(both);
  }
}

inline void transport(Regatta& all, Sailor& sailor) {
  const auto [object, object_class] = any_object(all, sailor);
  const auto way = all.one_in(2) ? Transportation::reliable : Transportation::best_effort;
  const FederateHandle other{static_cast<std::uint32_t>(all.below(all.seat_count()))};
  Ambassador& to = sailor.ambassador;
  switch (all.below(4)) {
    case 0:
      return to.request_attribute_transportation_type_change(object, any_of(all, object_class),
                                                             way);
    case 1:
      return to.query_attribute_transportation_type(
          object,
          {static_cast<std::uint32_t>(all.below(regatta().attributes(object_class).count()))});
    case 2:
      return to.request_interaction_transportation_type_change(any_interaction(all), way);
    default:
      return to.query_interaction_transportation_type(other, any_interaction(all));
  }
}

inline void trade(Regatta& all, Sailor& sailor) {
  const auto [object, object_class] = any_object(all, sailor);
  const AttributeSet set = any_owned(all, object_class);
  const std::vector<std::byte> tag = bytes_of(std::string(all.below(3), 't'));
  Ambassador& to = sailor.ambassador;
  switch (all.below(11)) {
    case 0:
      return to.unconditional_attribute_ownership_divestiture(object, set);
    case 1:
    case 2:
      return to.negotiated_attribute_ownership_divestiture(object, set, tag);
    case 3:
      return to.confirm_divestiture(object, set, tag);
    case 4:
      return to.cancel_negotiated_attribute_ownership_divestiture(object, set);
    case 5:
      return to.attribute_ownership_release_denied(object, set);
    case 6:
      return to.attribute_ownership_divestiture_if_wanted(object, set);
    case 7:
    case 8:
      return to.attribute_ownership_acquisition(object, set, tag);
    case 9:
      if (all.one_in(2)) return to.cancel_attribute_ownership_acquisition(object, set);
      return to.attribute_ownership_acquisition_if_available(object, set);
    default:
      return to.query_attribute_ownership(object, {static_cast<std::uint32_t>(all.below(2))});
  }
}

inline void commit(Regatta& all, Sailor& sailor, RegionHandle region) {
  const auto x = static_cast<double>(all.below(80)), y = static_cast<double>(all.below(80));
  sailor.ambassador.set_region(region, {x, y, x + 30.0, y + 30.0});
  sailor.ambassador.commit_region_modifications(region);
}

inline void make_region(Regatta& all, Sailor& sailor) {
  const DimensionSet both{DimensionHandle{0}, DimensionHandle{1}}, one{DimensionHandle{0}};
  if (!all.one_in(3)) {
    sailor.regions.push_back(sailor.ambassador.create_region());
    return commit(all, sailor, sailor.regions.back());
  }
  const DimensionSet dimensions = all.one_in(2) ? both : one;
  const RegionHandle region = sailor.ambassador.create_region(dimensions);
  sailor.regions.push_back(region);
  dimensions.for_each([&](DimensionHandle each) {
    const auto low = static_cast<double>(all.below(80));
    sailor.ambassador.set_range_bounds(region, each, {low, low + 40.0});
  });
  sailor.ambassador.commit_region_modifications(region);
}

inline void use_region(Regatta& all, Sailor& sailor) {
  const RegionHandle region = any_region(all, sailor);
  const AttributeRegions pair{AttributeSet{AttributeHandle{0}}, {region}};
  const std::span<const AttributeRegions> pairs(&pair, 1);
  const std::span<const RegionHandle> regions(&region, 1);
  const auto [object, object_class] = any_object(all, sailor);
  const ObjectClassHandle boat = all.one_in(2) ? yacht : cruiser;
  Ambassador& to = sailor.ambassador;
  switch (all.below(12)) {
    case 0:
      return to.associate_regions_for_updates(object, region);
    case 1:
      return to.associate_regions_for_updates(object, pairs);
    case 2:
      return to.unassociate_regions_for_updates(object, pairs);
    case 3:
    case 4:
      return to.subscribe_object_class_attributes_with_regions(boat, pairs);
    case 5:
      return to.unsubscribe_object_class_attributes_with_regions(boat, pairs);
    case 6:
      return to.subscribe_object_class_attributes(boat, any_of(all, boat), region);
    case 7:
      return to.subscribe_interaction_class_with_regions(any_interaction(all), regions);
    case 8:
      if (all.one_in(3)) return to.delete_region(region);
      return to.unsubscribe_interaction_class_with_regions(any_interaction(all), regions);
    case 9:
      return to.send_interaction_with_regions(any_interaction(all), bytes_of("near"), regions, {});
    case 10:
      return to.request_attribute_value_update_with_regions(boat, pairs);
    default:
      return commit(all, sailor, region);
  }
}

inline void keep_time(Regatta& all, Sailor& sailor) {
  Ambassador& to = sailor.ambassador;
  const LogicalTime then(to.clock().time() + 0.25 * static_cast<double>(1 + all.below(8)));
  switch (all.below(10)) {
    case 0:
      return to.enable_time_regulation(sailor.lookahead);
    case 1:
      return to.enable_time_constrained();
    case 2:
      if (all.one_in(4)) return to.disable_time_regulation();
      return to.query_time_bounds();
    case 3:
      if (all.one_in(4)) return to.disable_time_constrained();
      return to.modify_lookahead(0.25 * static_cast<double>(1 + all.below(4)));
    case 4:
      return to.enable_asynchronous_delivery();
    case 5:
      return to.next_message_request(then);
    case 6:
      return to.flush_queue_request(then);
    case 7:
      return to.time_advance_request_available(then);
    default:
      return to.time_advance_request(then);
  }
}

inline void say_in_time(Regatta& all, Sailor& sailor) {
  Ambassador& to = sailor.ambassador;
  const auto [object, object_class] = any_object(all, sailor);
  const LogicalTime then(to.clock().time() + 0.25 * static_cast<double>(1 + all.below(12)));
  const AttributeSet set = any_of(all, object_class);
  switch (all.below(9)) {
    case 0:
      return to.change_interaction_order_type(any_interaction(all), Order::timestamp);
    case 1:
      return to.change_attribute_order_type(object, set, Order::timestamp);
    case 2:
      if (!sailor.sent.empty()) to.retract(sailor.sent[all.below(sailor.sent.size())]);
      return;
    case 3:
      sailor.sent.push_back(to.send_interaction(any_interaction(all), bytes_of("then"), then));
      return;
    case 4:
      if (all.one_in(3)) sailor.sent.push_back(to.delete_object_instance(object, then));
      return;
    default:
      sailor.sent.push_back(to.update_attribute_values(
          object, set, any_values(all, object_class, set), then, all.below(3)));
  }
}

inline void synchronize(Regatta& all, Sailor& sailor) {
  Ambassador& to = sailor.ambassador;
  const FederateHandle one{static_cast<std::uint32_t>(all.below(all.seat_count()))};
  if (all.one_in(2) || sailor.labels.empty())
    return to.register_synchronization_point("mark " + std::to_string(all.below(6)), bytes_of("t"),
                                             std::span(&one, all.below(2)));
  to.synchronization_point_achieved(sailor.labels[all.below(sailor.labels.size())], !all.one_in(4));
}

inline void manage(Regatta& all, Sailor& sailor) {
  Ambassador& to = sailor.ambassador;
  const auto manager = [](const char* name) {
    return *regatta().interaction_class(std::string("HLAinteractionRoot.HLAmanager.") + name);
  };
  const ObjectClassHandle object_class = *regatta().object_class(
      std::string("HLAobjectRoot.HLAmanager.") + (all.one_in(2) ? "HLAfederate" : "HLAfederation"));
  std::vector<std::byte> parameters;
  ManagementWriter writer(parameters);
  const auto tell = [&](const char* name) {
    to.publish_interaction_class(manager(name));
    to.send_interaction(manager(name), parameters, {});
  };
  const auto about = static_cast<std::uint32_t>(all.below(all.seat_count()));
  switch (all.below(11)) {
    case 0:
    case 1:
      return to.subscribe_object_class_attributes(object_class, regatta().attributes(object_class));
    case 2:
      return to.unsubscribe_object_class(object_class);
    case 3:
      return to.query_management();
    case 4:
      writer.handle(about), writer.count(all.below(2));
      return tell("HLAfederate.HLAadjust.HLAsetTiming");
    case 5:
      writer.count(all.below(2));
      return tell("HLAfederation.HLAadjust.HLAsetSwitches");
    case 6:
      writer.handle(about);
      return tell("HLAfederate.HLArequest.HLArequestPublications");
    case 7:
      writer.handle(about);
      return tell("HLAfederate.HLArequest.HLArequestSubscriptions");
    case 8:
      return tell("HLAfederation.HLArequest.HLArequestSynchronizationPoints");
    case 9:
      return to.request_attribute_value_update(object_class, regatta().attributes(object_class));
    default:
      return to.subscribe_interaction_class(manager("HLAfederate.HLAreport"));
  }
}

inline void watch(Regatta&, Sailor& sailor) { sailor.ambassador.watch_federates(); }

}  // namespace rink::rti::testing::at_the_regatta
