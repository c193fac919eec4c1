// Federates that are updated less often than is matched: their turns, what they receive at a turn,
// and what they receive at once.
#include "rti/federation/delivery/update_rates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

TEST(UpdateRates, TurnsComeEvenlyAndNeverDrift) {
  for (const UpdateRate rate : {UpdateRate{1, 3},
                                {5, 12},
                                {25'000, 60'000},
                                {7, 10},
                                {1, 60},
                                {59, 60},
                                {29'970, 60'000}}) {
    UpdateRates rates;
    constexpr std::uint32_t federates = 240;
    for (std::uint32_t k = 0; k < federates; ++k) {
      rates.joined(k);
      rates.set_rate(k, rate);
    }
    EXPECT_EQ(rates.limited_count(), federates);
    const double share = static_cast<double>(rate.turns) / rate.matches;
    std::vector<int> turns(federates), since(federates);
    for (int match = 1; match <= 3'000; ++match) {
      rates.begin_match();
      double due = 0.0;
      for (std::uint32_t k = 0; k < federates; ++k) {
        ++since[k];
        if (!rates.groups()[rates.group_of(k)].is_due) continue;
        ++due;
        if (++turns[k] > 1) {
          EXPECT_GE(since[k], static_cast<int>(1.0 / share));
        }
        EXPECT_LE(since[k], static_cast<int>(std::ceil(1.0 / share - 1e-9)));
        since[k] = 0;
        ASSERT_NEAR(turns[k], match * share, 1.0);
      }
      rates.end_turns();
      if (rate.matches <= UpdateRates::phase_max) {
        ASSERT_NEAR(due, federates * share, 1e-9) << "each match has its part";
      }
    }
  }
}

TEST(UpdateRates, ThatKeepChangingTakeNoMoreRoom) {
  UpdateRates rates;
  rates.joined(0), rates.joined(1);
  rates.set_rate(1, {1, 3});
  for (std::uint32_t matches = 2; matches < 200; ++matches) {
    rates.set_rate(0, {1, matches});
    EXPECT_EQ(rates.groups()[rates.group_of(0)].rate, (UpdateRate{1, matches}));
    EXPECT_EQ(rates.groups()[rates.group_of(1)].rate, (UpdateRate{1, 3}));
    EXPECT_LE(rates.groups().size(), 3 + 2 * UpdateRates::phase_max);
  }
}

TEST(UpdateRates, WithoutATurnOrWithMoreThanMatchesAreRefused) {
  FederationExecution execution(harbour(), {});
  for (const UpdateRate rate : {UpdateRate{0, 0}, {0, 3}, {4, 3}}) {
    FederationSettings settings;
    settings.update_rate = rate;
    EXPECT_THROW(FederationExecution(harbour(), settings), std::invalid_argument);
    EXPECT_THROW(execution.set_update_rate({}, rate), std::invalid_argument);
  }
}

TEST(UpdateRates, WhoLeavesMakesRoomInItsPhase) {
  UpdateRates rates;
  for (std::uint32_t k = 0; k < 9; ++k) {
    rates.joined(k);
    rates.set_rate(k, {1, 3});
  }
  const std::uint32_t group = rates.group_of(4);
  rates.left(4);
  EXPECT_EQ(rates.groups()[group].federates, 2u);
  EXPECT_EQ(rates.limited_count(), 8u);
  rates.joined(4);
  EXPECT_EQ(rates.group_of(4), UpdateRates::every_match);
  rates.set_rate(4, {2, 6});
  EXPECT_EQ(rates.group_of(4), group) << "two of six is one of three";
}

/// A master who moves vessels, one watcher who is updated at every match and one at one in three,
/// and one who always listens, so that no update is spared.
class SlowHarbour {
 public:
  SlowHarbour() : execution_(harbour(), {}), host_(execution_) {
    server_.listen("rti");
    host_.add(server_);
    master = &join("master"), steady = &join("steady"), seldom = &join("seldom");
    Watcher& anchor = join("anchor");
    execution_.set_update_rate(seldom->ambassador.federate(), {1, 3});
    master->ambassador.publish_object_class_attributes(vessel, harbour().attributes(vessel));
    master->ambassador.publish_interaction_class(hail);
    for (Watcher* each : {steady, seldom, &anchor}) {
      each->ambassador.subscribe_object_class_attributes(vessel, motion);
      each->ambassador.subscribe_interaction_class(hail);
    }
    for (int k = 0; k < 4; ++k) tick();
  }
  struct Watcher {
    explicit Watcher(InProcessNetwork& network)
        : endpoint(network), link(ambassador, endpoint, endpoint.connect("rti")) {
      links.add(link);
    }
    Recorder heard;
    Ambassador ambassador{harbour(), heard};
    InProcessEndpoint endpoint;
    FederateLink link;
    FederateLinks links;
  };
  void tick() {
    for (Watcher& each : watchers_) each.links.flush(0.0);
    host_.poll({});
    const std::uint64_t frames = execution_.counters().frames_sent;
    host_.match();
    host_.flush();
    last_frames = execution_.counters().frames_sent - frames;
    for (Watcher& each : watchers_) each.endpoint.poll({}, each.links);
  }
  void move(ObjectHandle object, AttributeSet attributes, float value) {
    std::vector<std::byte> values;
    if (attributes.contains(position)) values = values_of(value, -value);
    if (attributes.contains(speed)) {
      const std::vector<std::byte> more = values_of(value);
      values.insert(values.end(), more.begin(), more.end());
    }
    master->ambassador.update_attribute_values(object, attributes, values,
                                               {static_cast<double>(value), 0});
  }
  int updates(ObjectHandle object) const { return seldom->heard.objects.at(object.value).updates; }
  bool agree() const {
    const auto& a = steady->heard.objects;
    const auto& b = seldom->heard.objects;
    return std::ranges::equal(a, b, [](const auto& one, const auto& other) {
      return one.first == other.first && one.second.is_in_scope == other.second.is_in_scope &&
             (!one.second.is_in_scope || one.second.values == other.second.values);
    });
  }

  Watcher *master = nullptr, *steady = nullptr, *seldom = nullptr;
  std::uint64_t last_frames = 0;
  FederationExecution& execution() { return execution_; }

 private:
  Watcher& join(const std::string& name) {
    Watcher& watcher = watchers_.emplace_back(network_);
    watcher.ambassador.join("rink", name, "tester");
    tick();
    tick();
    return watcher;
  }
  FederationExecution execution_;
  FederationHost host_;
  InProcessNetwork network_;
  InProcessEndpoint server_{network_};
  std::deque<Watcher> watchers_;
};

TEST(UpdateRates, OneOfThreeMatchesBringsTheNewestValueOnce) {
  SlowHarbour scene;
  const ObjectHandle moving = scene.master->ambassador.register_object_instance(vessel),
                     still = scene.master->ambassador.register_object_instance(vessel);
  scene.move(moving, motion, 1.0f);
  scene.move(still, motion, 1.0f);
  for (int k = 0; k < 6; ++k) scene.tick();
  ASSERT_TRUE(scene.agree());
  const int before = scene.updates(moving), still_before = scene.updates(still);
  int agreed = 0;
  for (int tick = 2; tick <= 31; ++tick) {
    scene.move(moving, {position}, static_cast<float>(tick));
    scene.tick();
    agreed += scene.agree() ? 1 : 0;
    if (scene.agree()) {
      EXPECT_EQ(scene.seldom->heard.objects.at(moving.value).stamp.time, tick);
    }
  }
  EXPECT_EQ(agreed, 10);
  EXPECT_EQ(scene.updates(moving) - before, 10);
  EXPECT_EQ(scene.updates(still), still_before);
}

TEST(UpdateRates, AttributesKeepTheStampsOfTheirOwnUpdates) {
  SlowHarbour scene;
  const ObjectHandle object = scene.master->ambassador.register_object_instance(vessel);
  scene.move(object, motion, 1.0f);
  for (int k = 0; k < 6; ++k) scene.tick();
  int turns = 0;
  for (int round = 0; round < 9; ++round) {
    const int before = scene.updates(object);
    scene.move(object, motion, 10.0f + static_cast<float>(round));
    scene.tick();
    if (scene.updates(object) == before) continue;
    ++turns;
    scene.move(object, {speed}, 30.0f), scene.tick();
    scene.move(object, {position}, 31.0f), scene.tick();
    scene.tick();
    EXPECT_EQ(scene.updates(object) - before, 3) << "speed of 30, position of 31";
    EXPECT_EQ(scene.seldom->heard.objects.at(object.value).stamp.time, 31.0);
    EXPECT_TRUE(scene.agree());
  }
  EXPECT_GT(turns, 0);
}

TEST(UpdateRates, AllElseIsSentAtOnce) {
  SlowHarbour scene;
  const ObjectHandle object = scene.master->ambassador.register_object_instance(vessel);
  scene.move(object, motion, 1.0f);
  for (int k = 0; k < 6; ++k) scene.tick();
  for (int k = 0; k < 5; ++k) {
    scene.master->ambassador.send_interaction(hail, varying("ahoy"), {});
    scene.tick();
    ASSERT_EQ(scene.seldom->heard.interactions.size(), static_cast<std::size_t>(k) + 1);
  }
  scene.master->ambassador.delete_object_instance(object);
  scene.tick();
  EXPECT_TRUE(scene.seldom->heard.objects.empty());
}

TEST(UpdateRates, AMatchBetweenTurnsSendsNothing) {
  SlowHarbour scene;
  const ObjectHandle object = scene.master->ambassador.register_object_instance(vessel);
  for (int k = 0; k < 6; ++k) scene.tick();
  std::uint64_t frames = 0;
  for (int tick = 1; tick <= 30; ++tick) {
    scene.move(object, motion, static_cast<float>(tick));
    scene.tick();
    frames += scene.last_frames;
  }
  EXPECT_EQ(frames, 30u + 30u + 10u);
}

TEST(UpdateRates, AnObjectOfItsOwnIsSentAtOnceAndNotAgain) {
  SlowHarbour scene;
  const ObjectHandle own = scene.master->ambassador.register_object_instance(vessel),
                     other = scene.master->ambassador.register_object_instance(vessel);
  for (const ObjectHandle each : {own, other}) scene.move(each, motion, 1.0f);
  for (int k = 0; k < 6; ++k) scene.tick();
  scene.execution().send_at_once(scene.seldom->ambassador.federate(), own, {position});
  const int before = scene.updates(own), other_before = scene.updates(other);
  for (int tick = 2; tick <= 31; ++tick) {
    for (const ObjectHandle each : {own, other})
      scene.move(each, {position}, static_cast<float>(tick));
    scene.tick();
    ASSERT_EQ(scene.seldom->heard.objects.at(own.value).values,
              scene.steady->heard.objects.at(own.value).values);
  }
  EXPECT_EQ(scene.updates(own) - before, 30);
  EXPECT_EQ(scene.updates(other) - other_before, 10);
  for (int tick = 32; tick <= 61; ++tick) {  // an attribute that may wait
    scene.move(own, {speed}, static_cast<float>(tick));
    scene.tick();
  }
  EXPECT_EQ(scene.updates(own) - before, 40);
}

TEST(UpdateRates, ARateMayChangeAtAnyTime) {
  SlowHarbour scene;
  std::mt19937 random(3);
  std::vector<ObjectHandle> fleet;
  for (int k = 0; k < 20; ++k)
    fleet.push_back(scene.master->ambassador.register_object_instance(vessel));
  for (const ObjectHandle each : fleet) scene.move(each, motion, 0.5f);
  for (int round = 0; round < 60; ++round) {
    const auto matches = static_cast<std::uint32_t>(1 + random() % 7),
               turns = static_cast<std::uint32_t>(1 + random() % matches);
    scene.execution().set_update_rate(scene.seldom->ambassador.federate(), {turns, matches});
    for (int tick = 0; tick < 5; ++tick) {
      scene.move(fleet[random() % 20], motion, static_cast<float>(round * 5 + tick));
      scene.tick();
    }
    scene.execution().set_update_rate(scene.seldom->ambassador.federate(), {});
    scene.tick();
    ASSERT_TRUE(scene.agree()) << round;
  }
}

/// Objects come, go, move and change scope at random; at a turn the slow watcher knows what the
/// other one does.
TEST(UpdateRates, NothingIsLostWhateverHappensBetweenTurns) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SlowHarbour scene;
    std::mt19937 random(seed);
    std::vector<ObjectHandle> fleet;
    const AttributeSet sets[] = {{position}, {speed}, motion};
    int agreed = 0;
    for (int tick = 1; tick <= 150; ++tick) {
      if (random() % 3 == 0)
        fleet.push_back(scene.master->ambassador.register_object_instance(vessel));
      if (fleet.size() > 10 || (!fleet.empty() && random() % 8 == 0)) {
        const std::size_t k = random() % fleet.size();
        scene.master->ambassador.delete_object_instance(fleet[k]);
        fleet.erase(fleet.begin() + static_cast<std::ptrdiff_t>(k));
      }
      for (const ObjectHandle each : fleet)
        if (random() % 2 == 0) scene.move(each, sets[random() % 3], static_cast<float>(tick));
      if (random() % 6 == 0)
        for (SlowHarbour::Watcher* each : {scene.steady, scene.seldom})
          each->ambassador.unsubscribe_object_class(vessel);
      else
        for (SlowHarbour::Watcher* each : {scene.steady, scene.seldom})
          each->ambassador.subscribe_object_class_attributes(vessel, motion);
      scene.tick();
      agreed += scene.agree() ? 1 : 0;
      if (tick % 3 == 0) {
        ASSERT_GE(agreed, tick / 3) << "seed " << seed << ", tick " << tick;
      }
    }
    EXPECT_EQ(scene.seldom->heard.out_of_scope_updates, 0);
    EXPECT_EQ(scene.seldom->heard.lost, "");
  }
}

}  // namespace
}  // namespace rink::rti::testing
