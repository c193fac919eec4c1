// Ownership over whole federations: random requests that cross each other on their way, federates
// that join, resign and die.
#include <gtest/gtest.h>

#include <random>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// A sea on which ships change hands without end. Requests are sent before what they cross has
/// arrived.
class Traders {
 public:
  explicit Traders(unsigned seed) : random_(seed) {
    for (int i = 0; i < 4; ++i) enlist();
    for (Station* each : crew_) add_ship(*each);
  }
  void step() {
    const std::uint64_t chance = random_() % 100;
    if (chance < 2 && crew_.size() < 7) return enlist();
    if (chance < 4 && crew_.size() > 3) return dismiss();
    Station& station = *crew_[random_() % crew_.size()];
    if (chance < 8 || ships_.empty()) return add_ship(station);
    const ObjectHandle ship = ships_[random_() % ships_.size()];
    const AttributeSet set = AttributeSet(static_cast<std::uint32_t>(random_())) & whole_vessel;
    const std::uint64_t operation = random_() % 11;
    try {
      act(station, ship, set, operation);
    } catch (const RtiException&) {
      ++refused;  // and nothing was sent or changed
    }
    if (random_() % 3 == 0) rig.round();
  }
  /// What every federate believes, what the RTI answers, and what was promised must agree.
  void check() {
    rig.settle();
    for (const std::uint64_t drops : rig.execution().counters().drops)
      ASSERT_EQ(drops, 0u) << "an honest federate was dropped";
    for (const ObjectHandle ship : ships_)
      for (const AttributeHandle attribute : {position, speed, privilege_to_delete_object})
        ASSERT_NO_FATAL_FAILURE(check(ship, attribute));
  }
  /// Everybody lets go of everything until nobody waits; then no wish may be left.
  void release_all() {
    for (int i = 0; i < 40; ++i) {
      for (Station* each : crew_)
        for (const ObjectHandle ship : ships_)
          if (knows(*each, ship))
            each->ambassador.unconditional_attribute_ownership_divestiture(ship,
                                                                           owned(*each, ship));
      rig.settle();
    }
    for (Station* each : crew_)
      ASSERT_TRUE(each->heard.pending.empty()) << "an acquisition was lost";
  }

  Rig rig{Carrier::in_process};
  int refused = 0;

 private:
  void enlist() {
    Station& station = rig.join("pilot " + std::to_string(++enlisted_));
    station.ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
    station.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position, speed});
    if (random_() % 2 == 0)
      station.ambassador.set_automatic_resign_directive(
          ResignAction::unconditionally_divest_attributes);
    crew_.push_back(&station);
    rig.settle();
  }
  void dismiss() {
    std::swap(crew_[random_() % crew_.size()], crew_.back());
    if (random_() % 2 == 0) crew_.back()->ambassador.resign();
    else crew_.back()->link->close();
    crew_.pop_back();
    rig.settle();
    std::erase_if(ships_, [this](ObjectHandle ship) {
      return std::none_of(crew_.begin(), crew_.end(),
                          [&](Station* each) { return knows(*each, ship); });
    });
  }
  void add_ship(Station& station) {
    if (ships_.size() > 12) return;
    ships_.push_back(station.ambassador.register_object_instance(vessel));
    station.ambassador.update_attribute_values(ships_.back(), AttributeSet{position, speed},
                                               values_of(0.0f, 0.0f, 0.0f), {});
  }
  bool knows(Station& station, ObjectHandle ship) {
    try {
      station.ambassador.is_attribute_owned_by_federate(ship, position);
      return true;
    } catch (const RtiException&) {
      return false;
    }
  }
  AttributeSet owned(Station& station, ObjectHandle ship) {
    AttributeSet set;
    for (const AttributeHandle attribute : {position, speed, privilege_to_delete_object})
      if (station.ambassador.is_attribute_owned_by_federate(ship, attribute)) set.insert(attribute);
    return set;
  }
  void note_pending(Station& station, ObjectHandle ship, AttributeSet set) {
    for (std::uint32_t i = 0; i < attribute_max; ++i)
      if (set.contains({i})) station.heard.pending.insert({ship.value, i});
  }
  void act(Station& station, ObjectHandle ship, AttributeSet set, std::uint64_t operation) {
    Ambassador& federate = station.ambassador;
    switch (operation) {
      case 0:
      case 1:
        federate.attribute_ownership_acquisition(ship, set);
        return note_pending(station, ship, set);
      case 2:
        federate.attribute_ownership_acquisition_if_available(ship, set);
        return note_pending(station, ship, set);
      case 3:
        return federate.cancel_attribute_ownership_acquisition(ship, set);
      case 4:
        return federate.unconditional_attribute_ownership_divestiture(ship,
                                                                      set & owned(station, ship));
      case 5:
      case 6:
        return federate.negotiated_attribute_ownership_divestiture(ship,
                                                                   set & owned(station, ship));
      case 7:
        return federate.confirm_divestiture(ship, set & owned(station, ship));
      case 8:
        return federate.cancel_negotiated_attribute_ownership_divestiture(
            ship, set & owned(station, ship));
      case 9:
        return federate.attribute_ownership_release_denied(ship, set & owned(station, ship));
      default:
        return federate.attribute_ownership_divestiture_if_wanted(ship, set & owned(station, ship));
    }
  }
  void check(ObjectHandle ship, AttributeHandle attribute) {
    Station* asker = nullptr;
    std::uint32_t owner = FederateHandle::none;
    for (Station* each : crew_) {
      if (!knows(*each, ship)) continue;
      asker = each;
      if (!each->ambassador.is_attribute_owned_by_federate(ship, attribute)) continue;
      ASSERT_EQ(owner, FederateHandle::none) << "two federates think they own it";
      owner = each->ambassador.federate().value;
      ASSERT_FALSE(each->heard.pending.contains({ship.value, attribute.value}))
          << "nobody waits for what it owns";
    }
    if (asker == nullptr) return;
    asker->ambassador.query_attribute_ownership(ship, attribute);
    rig.settle(1);
    ASSERT_EQ(asker->heard.owners.at({ship.value, attribute.value}), owner)
        << "what its owner was told is what the RTI holds";
    if (owner != FederateHandle::none) return;
    for (Station* each : crew_)
      ASSERT_FALSE(each->heard.pending.contains({ship.value, attribute.value}))
          << "nobody waits for what is free";
  }

  std::mt19937 random_;
  std::vector<Station*> crew_;
  std::vector<ObjectHandle> ships_;
  int enlisted_ = 0;
};

TEST(HandOver, LeavesOneOwnerOrNoneAndLosesNoWishWhateverCrossesWhat) {
  for (unsigned seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Traders traders(seed);
    for (int i = 0; i < 400; ++i) {
      ASSERT_NO_FATAL_FAILURE(traders.step());
      if (i % 20 != 19) continue;
      ASSERT_NO_FATAL_FAILURE(traders.check());
    }
    ASSERT_NO_FATAL_FAILURE(traders.release_all());
    EXPECT_GT(traders.refused, 0);
  }
}

TEST(HandOver, OfAThousandBodiesTakesABlockEachWay) {
  Rig rig(Carrier::in_process);
  Station& giver = rig.join("giver");
  Station& taker = rig.join("taker");
  for (Station* each : {&giver, &taker}) {
    each->ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
    each->ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position, speed});
  }
  std::vector<ObjectHandle> bodies;
  for (int i = 0; i < 1000; ++i)
    bodies.push_back(giver.ambassador.register_object_instance(vessel));
  rig.settle();
  const auto settle_bytes = [&rig] {
    const std::uint64_t before =
        rig.execution().counters().bytes_sent + rig.execution().counters().bytes_received;
    rig.settle();
    return rig.execution().counters().bytes_sent + rig.execution().counters().bytes_received -
           before;
  };
  for (const ObjectHandle body : bodies)
    giver.ambassador.negotiated_attribute_ownership_divestiture(body, whole_vessel);
  EXPECT_LE(settle_bytes(), 2u * (1000 + 64));  // to the RTI and on, a byte each
  for (const ObjectHandle body : bodies)
    taker.ambassador.attribute_ownership_acquisition(body, whole_vessel);
  EXPECT_LE(settle_bytes(), 2u * (1000 + 64));
  for (const ObjectHandle body : bodies) giver.ambassador.confirm_divestiture(body, whole_vessel);
  rig.settle();
  for (const ObjectHandle body : bodies)
    ASSERT_TRUE(taker.ambassador.is_attribute_owned_by_federate(body, position));
  EXPECT_EQ(rig.execution().counters().ownership_notices_sent, 3000u);
}

}  // namespace
}  // namespace rink::rti::testing
