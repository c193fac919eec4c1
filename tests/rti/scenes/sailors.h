// Sailors who declare, say, hand over, leave and die at random, in as many seas at once as a test
// compares.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "tests/rti/rig.h"

namespace rink::rti::testing {

/// Keeps every value that was heard, attribute by attribute, in its order.
struct Historian : Recorder {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::vector<std::byte>>> history;
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp& stamp) override {
    Recorder::reflect_attribute_values(object, set, values, stamp);
    for (std::uint32_t i = 0; i < attribute_max; ++i)
      if (set.contains({i}))
        history[{object.value, i}].push_back(objects.at(object.value).values.at(i));
  }
};

/// One federate through all its lives: who left joins again by another name.
struct Sailor {
  std::unique_ptr<Historian> heard = std::make_unique<Historian>();
  std::unique_ptr<Ambassador> ambassador = std::make_unique<Ambassador>(harbour(), *heard);
  ConnectionId connection = 0;
  std::array<RegionHandle, 2> regions;
  std::vector<ObjectHandle> objects;
  bool is_quiet = false;  ///< its callbacks are disabled
};

/// An execution and its sailors, whose bytes are carried by hand.
class Sea final : public Outlet {
 public:
  Sea(int sailors, bool has_ear) : execution_(harbour(), settings()) {
    for (int i = 0; i < sailors; ++i) join(all.emplace_back());
    if (!has_ear) return;
    Sailor& ear = all.emplace_back();
    join(ear);
    for (const ObjectClassHandle each : {vessel, ferry})
      ear.ambassador->subscribe_object_class_attributes(each, harbour().attributes(each), {},
                                                        false);
    ear.ambassador->subscribe_interaction_class(hail, false);
    settle();
  }
  void join(Sailor& sailor) {
    sailor.connection = next_connection_++;
    execution_.connect(sailor.connection);
    sailor.ambassador->join("rink", "sailor " + std::to_string(sailor.connection), "tester");
    settle();
    for (RegionHandle& region : sailor.regions) region = sailor.ambassador->create_region();
    for (const ObjectClassHandle each : {vessel, ferry}) {
      sailor.ambassador->publish_object_class_attributes(each, harbour().attributes(each));
      sailor.objects.push_back(sailor.ambassador->register_object_instance(each));
    }
    sailor.ambassador->publish_interaction_class(hail);
    settle();
  }
  /// Ends as if its process had died, or by its own word, and begins anew.
  void replace(Sailor& sailor, bool resigns) {
    if (resigns) {
      if (sailor.is_quiet) sailor.ambassador->enable_callbacks();
      sailor.ambassador->resign();
      execution_.receive(sailor.connection, sailor.ambassador->outgoing());
    } else {
      execution_.disconnect(sailor.connection, "died");
    }
    sailor = Sailor();
    join(sailor);
  }
  void round() {
    for (Sailor& sailor : all) {
      execution_.receive(sailor.connection, sailor.ambassador->outgoing());
      sailor.ambassador->clear_outgoing();
    }
    execution_.match();
    execution_.flush(*this);
  }
  void settle() {
    for (int i = 0; i < 4; ++i) round();
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    const auto receiver = std::ranges::find(all, connection, &Sailor::connection);
    for (const Bytes part : parts) EXPECT_TRUE(receiver->ambassador->receive(part));
  }
  void drop(ConnectionId, std::string_view) override {}
  std::uint64_t violations() const {
    const auto& drops = execution_.counters().drops;
    return std::accumulate(drops.begin(), drops.end(), std::uint64_t{0});
  }
  std::uint64_t updates_received() const { return execution_.counters().updates_received; }
  std::uint64_t updates_spared() const {
    std::uint64_t sum = 0;
    for (const Sailor& sailor : all) sum += sailor.ambassador->counters().updates_spared;
    return sum;
  }
  std::uint64_t interactions_spared() const {
    std::uint64_t sum = 0;
    for (const Sailor& sailor : all) sum += sailor.ambassador->counters().interactions_spared;
    return sum;
  }

  std::deque<Sailor> all;

 private:
  static FederationSettings settings() {
    FederationSettings settings;
    settings.filter = "region";
    settings.filter_settings.world = {0.0, 0.0, 10.0, 10.0};
    return settings;
  }
  FederationExecution execution_;
  ConnectionId next_connection_ = 0;
};

inline std::vector<std::byte> values_of(ObjectClassHandle object_class, AttributeSet set,
                                        float number) {
  std::vector<std::byte> bytes;
  const auto append = [&bytes](const std::vector<std::byte>& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  if (set.contains(position)) append(testing::values_of(number, -number));
  if (set.contains(speed)) append(testing::values_of(number + 0.5f));
  if (object_class == ferry && set.contains(destination)) append(varying(std::to_string(number)));
  return bytes;
}

/// Random things that sailors do. Each is drawn once and done in every sea; what can't be done is
/// left out.
class Weather {
 public:
  explicit Weather(unsigned seed) : random_(seed) {}
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() % count); }

  std::function<void(Sea&)> draw(std::size_t sailors, bool may_die) {
    const std::size_t who = below(static_cast<std::uint32_t>(sailors));
    const ObjectClassHandle object_class = below(2) == 0 ? vessel : ferry;
    const AttributeSet set(below(8) & harbour().attributes(object_class).bits);
    const std::uint32_t choice = below(20), number = below(1000);
    const bool flag = below(2) == 0;
    const float value = static_cast<float>(++said_);
    const auto by = [who](auto action) {
      return [who, action](Sea& sea) { action(sea, sea.all[who], *sea.all[who].ambassador); };
    };
    if (choice < 7)
      return by([=](Sea&, Sailor& sailor, Ambassador& ambassador) {
        update(sailor, ambassador, number, set, value);
      });
    if (choice < 9)
      return by([=](Sea&, Sailor&, Ambassador& ambassador) {
        ambassador.publish_object_class_attributes(
            object_class, number % 8 == 0 ? set : harbour().attributes(object_class));
      });
    if (choice < 12)
      return by([=](Sea&, Sailor& sailor, Ambassador& ambassador) {
        const RegionHandle region = number % 3 == 2 ? RegionHandle{} : sailor.regions[number % 3];
        ambassador.subscribe_object_class_attributes(
            object_class, number % 5 < 3 ? AttributeSet() : set, region, flag);
      });
    if (choice == 12)
      return by(
          [=](Sea&, Sailor& sailor, Ambassador& ambassador) { move(sailor, ambassador, number); });
    if (choice == 13)
      return by([=](Sea&, Sailor& sailor, Ambassador& ambassador) {
        add(sailor, ambassador, object_class, number);
      });
    if (choice == 14)
      return by([=](Sea&, Sailor& sailor, Ambassador& ambassador) {
        if (sailor.objects.empty() || number % 3 != 0) return;
        const ObjectHandle object = sailor.objects[number % sailor.objects.size()];
        if (owned(ambassador, object, AttributeSet{privilege_to_delete_object}).is_empty()) return;
        std::erase(sailor.objects, object);
        ambassador.delete_object_instance(object);
      });
    if (choice == 15)
      return by([=](Sea&, Sailor&, Ambassador& ambassador) {
        if (flag) ambassador.publish_interaction_class(number % 2 == 0 ? hail : mayday);
        else if (number % 3 == 0)
          ambassador.unsubscribe_interaction_class(number % 2 == 0 ? hail : mayday);
        else
          ambassador.subscribe_interaction_class(number % 2 == 0 ? hail : mayday, number % 5 != 0);
      });
    if (choice == 16)
      return by([=](Sea&, Sailor&, Ambassador& ambassador) {
        const InteractionClassHandle interaction_class = flag ? hail : mayday;
        if (number % 2 == 0) ambassador.publish_interaction_class(interaction_class);
        else if (!flag) return;
        ambassador.send_interaction(interaction_class, bytes_of(std::to_string(value)), {});
      });
    if (choice == 17)
      return by([=](Sea& sea, Sailor&, Ambassador& ambassador) {
        hand_over(sea, ambassador, number, set);
      });
    if (choice == 18)
      return by([=](Sea&, Sailor& sailor, Ambassador& ambassador) {
        if (number % 2 == 0)
          return ambassador.set_automatic_resign_directive(
              number % 8 == 0 ? ResignAction::unconditionally_divest_attributes
                              : ResignAction::delete_objects_then_divest);
        sailor.is_quiet = flag;
        if (flag) ambassador.disable_callbacks();
        else ambassador.enable_callbacks();
      });
    return by([=](Sea& sea, Sailor& sailor, Ambassador&) {
      if (may_die && number % 3 == 0) sea.replace(sailor, flag);
    });
  }

  static void update(Sailor& sailor, Ambassador& ambassador, std::uint32_t number, AttributeSet set,
                     float value) {
    if (sailor.objects.empty()) return;
    const ObjectHandle object = sailor.objects[number % sailor.objects.size()];
    const ObjectClassHandle object_class = ambassador.get_known_object_class_handle(object);
    set = owned(ambassador, object, set & harbour().attributes(object_class));
    if (!set.is_empty())
      ambassador.update_attribute_values(object, set, values_of(object_class, set, value),
                                         {static_cast<double>(value), 1});
  }

 private:
  static AttributeSet owned(Ambassador& ambassador, ObjectHandle object, AttributeSet set) {
    AttributeSet found;
    for (std::uint32_t i = 0; i < attribute_max; ++i)
      if (set.contains({i}) && ambassador.is_attribute_owned_by_federate(object, {i}))
        found.insert({i});
    return found;
  }
  static void move(Sailor& sailor, Ambassador& ambassador, std::uint32_t number) {
    const double x = number % 10, y = number / 10 % 10;
    ambassador.set_region(sailor.regions[number % 2], {x, y, x + 4.0, y + 4.0});
    ambassador.commit_region_modifications(sailor.regions[number % 2]);
  }
  static void add(Sailor& sailor, Ambassador& ambassador, ObjectClassHandle object_class,
                  std::uint32_t number) {
    ambassador.publish_object_class_attributes(object_class, harbour().attributes(object_class));
    sailor.objects.push_back(ambassador.register_object_instance(object_class));
    if (number % 2 == 0)
      ambassador.associate_regions_for_updates(sailor.objects.back(),
                                               sailor.regions[number / 2 % 2]);
  }
  /// Gives something up, which another one takes if it knows the object and may.
  static void hand_over(Sea& sea, Ambassador& ambassador, std::uint32_t number, AttributeSet set) {
    Sailor& sailor = *std::ranges::find_if(
        sea.all, [&](const Sailor& each) { return each.ambassador.get() == &ambassador; });
    if (sailor.objects.empty()) return;
    const ObjectHandle object = sailor.objects[number % sailor.objects.size()];
    const ObjectClassHandle object_class = ambassador.get_known_object_class_handle(object);
    set = owned(ambassador, object, set & harbour().attributes(object_class));
    if (set.is_empty()) return;
    ambassador.unconditional_attribute_ownership_divestiture(object, set);
    sea.settle();
    for (Sailor& other : sea.all) {
      if (&other == &sailor || other.is_quiet || !other.heard->objects.contains(object.value) ||
          &other == &sea.all.back())
        continue;
      other.ambassador->publish_object_class_attributes(object_class,
                                                        harbour().attributes(object_class));
      other.ambassador->attribute_ownership_acquisition_if_available(object, set);
      return;
    }
  }
  std::mt19937 random_;
  int said_ = 0;
};

}  // namespace rink::rti::testing
