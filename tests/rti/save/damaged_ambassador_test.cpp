// An ambassador's state that was changed since it was saved, or made by somebody else.
#include "rti/save/saved_federation.h"
#include "tests/rti/save/saved_fleet.h"

namespace rink::rti::testing {
namespace {

/// What a federate may do by all its books, as far as it gets.
void use(Ambassador& rti) {
  const auto attempt = [](const auto& service) {
    try {
      service();
    } catch (const RtiException&) {
      return;  // what it knows may be wrong, not what it does with it
    }
  };
  RegionHandle region;
  attempt([&] { region = rti.create_region(); });
  attempt([&] { rti.set_region(region, {0.0f, 0.0f, 1.0f, 1.0f}); });
  attempt([&] { rti.subscribe_object_class_attributes(vessel, motion); });
  attempt([&] { rti.register_object_instance(vessel); });
  attempt([&] { rti.change_interaction_order_type(hail, Order::timestamp); });
  attempt([&] { rti.publish_interaction_class(hail); });
  attempt([&] { rti.send_interaction(hail, varying("ahoy"), {1.0, 1}); });
  attempt([&] { rti.resign(); });
}

TEST(DamagedAmbassador, IsRefusedOrDoesNoHarm) {
  SavedFleet fleet;
  SavedFleet::Member* pilot = nullptr;
  const auto crew = [&] {
    pilot = &fleet.join("pilot");
    fleet.join("coast", "guard");
  };
  crew();
  pilot->ambassador->publish_object_class_attributes(vessel, motion);
  pilot->ambassador->register_object_instance(vessel, "Pequod");
  const RegionHandle first = pilot->ambassador->create_region();
  pilot->ambassador->create_region();
  pilot->ambassador->delete_region(first);
  pilot->ambassador->publish_interaction_class(hail);
  pilot->ambassador->change_interaction_order_type(hail, Order::timestamp);
  pilot->ambassador->request_federation_save("noon");
  ASSERT_EQ(fleet.told(*pilot), (ToldWords{"save noon", "saved"}));
  const std::vector<std::byte> whole = fleet.store->saves.at("noon");
  SavedFederation saved;
  ASSERT_EQ(decode(whole, saved), "");
  std::vector<std::byte>& state = saved.federates[0].ambassador;
  int refused = 0;
  fleet.has_damaged_states = true;
  for (std::size_t at = 0; at < state.size(); ++at)
    for (const std::byte flip : {std::byte{1}, std::byte{2}, std::byte{0x80}}) {
      state[at] ^= flip;
      fleet.store->saves["noon"] = encoded(saved);
      fleet.begin();
      crew();
      pilot->ambassador->request_federation_restore("noon");
      fleet.tick();
      refused += pilot->dropped.empty() ? 0 : 1;
      if (pilot->dropped.empty()) use(*pilot->ambassador);
      fleet.tick(1);
      state[at] ^= flip;
    }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace rink::rti::testing
