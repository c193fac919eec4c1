// A federate that stops reading: it is told the newest state when it reads again, its queue stays
// bounded, and nobody else notices.
#include "rti/buffering/newest_state.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

constexpr std::size_t hold_above = 4000, resume_below = 500;

FederationServices small_marks() {
  FederationServices services;
  services.buffering = [] {
    return std::make_unique<NewestState>(NewestStateSettings{hold_above, resume_below});
  };
  return services;
}

/// A harbour master who moves vessels, and a watcher who may stop reading, each in process on an
/// endpoint of its own.
class DozingHarbour {
 public:
  explicit DozingHarbour(FederationServices services = small_marks())
      : execution_(harbour(), {}, services), host_(execution_) {
    server_.listen("rti");
    host_.add(server_);
    master = &join("master"), steady = &join("steady"), dozing = &join("dozing");
    master->ambassador.publish_object_class_attributes(vessel, harbour().attributes(vessel));
    master->ambassador.publish_interaction_class(hail);
    for (Watcher* each : {steady, dozing}) {
      each->ambassador.subscribe_object_class_attributes(vessel, harbour().attributes(vessel));
      each->ambassador.subscribe_interaction_class(hail);
    }
    tick();
    tick();
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
    bool is_reading = true;
  };
  /// All speak, the RTI answers, those who read hear.
  void tick() {
    for (Watcher& each : watchers_) each.links.flush(0.0);
    host_.poll({});
    host_.match();
    host_.flush();
    for (Watcher& each : watchers_)
      if (each.is_reading) each.endpoint.poll({}, each.links);
  }
  /// A new value of both attributes.
  void move(ObjectHandle object, float value) {
    std::vector<std::byte> values = values_of(value, -value, 10.0f * value);
    master->ambassador.update_attribute_values(object, harbour().attributes(vessel), values,
                                               {static_cast<double>(value), 0});
    newest[object.value] = values_of(value, -value);
  }
  /// What the RTI has left to wait for `dozing`: the third connection.
  std::size_t waiting() const { return server_.queued_bytes(2); }
  void expect_newest(const Watcher& watcher) const {
    for (const auto& [object, value] : newest)
      EXPECT_EQ(watcher.heard.objects.at(object).values.at(position.value), value) << object;
  }

  Watcher *master = nullptr, *steady = nullptr, *dozing = nullptr;
  std::map<std::uint32_t, std::vector<std::byte>> newest;
  const FederationCounters& counters() const { return execution_.counters(); }

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

TEST(NewestState, HoldsBackAboveOneMarkUntilBelowTheOther) {
  NewestState buffering({.hold_above = 100, .resume_below = 10});
  EXPECT_FALSE(buffering.holds_back(7, 100));
  EXPECT_TRUE(buffering.holds_back(7, 101));
  EXPECT_TRUE(buffering.holds_back(7, 11));
  EXPECT_FALSE(buffering.holds_back(8, 11)) << "each federate for itself";
  EXPECT_FALSE(buffering.holds_back(7, 10));
  EXPECT_FALSE(buffering.holds_back(7, 100));
  EXPECT_TRUE(buffering.holds_back(7, 101));
  buffering.remove_federate(7);
  EXPECT_FALSE(buffering.holds_back(7, 50)) << "a slot's next federate starts anew";
}

TEST(Buffering, OneWhoStoppedReadingForAThousandTicksHearsTheNewestStateOnce) {
  DozingHarbour scene;
  std::vector<ObjectHandle> vessels;
  for (int i = 0; i < 20; ++i)
    vessels.push_back(scene.master->ambassador.register_object_instance(vessel));
  for (const ObjectHandle each : vessels) scene.move(each, 1.0f);
  scene.tick();
  scene.dozing->is_reading = false;
  // 20 vessels of 13 bytes and some 20 of header a tick, one more tick after the mark is passed.
  const std::size_t bound = hold_above + 20 * 13 + 100;
  for (int tick = 2; tick < 1000; ++tick) {
    for (const ObjectHandle each : vessels) scene.move(each, static_cast<float>(tick));
    scene.tick();
    ASSERT_LE(scene.waiting(), bound);
  }
  EXPECT_GT(scene.waiting(), hold_above);
  EXPECT_GT(scene.counters().updates_held_back, 20u * 950u);
  scene.expect_newest(*scene.steady);
  EXPECT_EQ(scene.steady->heard.objects.at(vessels[0].value).updates, 999)
      << "others hear of every update";
  scene.dozing->is_reading = true;
  scene.tick();  // it reads what waited
  const int before = scene.dozing->heard.objects.at(vessels[0].value).updates;
  scene.tick();
  scene.expect_newest(*scene.dozing);
  for (const ObjectHandle each : vessels)
    EXPECT_EQ(scene.dozing->heard.objects.at(each.value).updates, before + 1);
  scene.tick();
  EXPECT_EQ(scene.dozing->heard.objects.at(vessels[0].value).updates, before + 1)
      << "nothing is due any more";
}

TEST(Buffering, InteractionsDiscoveriesAndRemovalsReachOneWhoStoppedReadingInTheirOrder) {
  DozingHarbour scene;
  const ObjectHandle first = scene.master->ambassador.register_object_instance(vessel);
  scene.dozing->is_reading = false;
  std::vector<std::pair<std::uint32_t, std::string>> said;
  ObjectHandle last = first;
  for (int tick = 0; tick < 400; ++tick) {
    scene.move(last, static_cast<float>(tick));
    said.emplace_back(hail.value, "hail " + std::to_string(tick));
    scene.master->ambassador.send_interaction(hail, bytes_of(said.back().second), {});
    if (tick % 100 == 50) {
      scene.master->ambassador.delete_object_instance(last);
      scene.newest.erase(last.value);
      last = scene.master->ambassador.register_object_instance(vessel);
    }
    scene.tick();
  }
  ASSERT_GT(scene.counters().updates_held_back, 0u);
  scene.dozing->is_reading = true;
  scene.tick();
  scene.tick();
  EXPECT_EQ(scene.dozing->heard.interactions, said);
  EXPECT_EQ(scene.dozing->heard.objects.size(), 1u);
  EXPECT_EQ(scene.dozing->heard.discoveries.size(), 5u);
  for (const auto& [object, count] : scene.dozing->heard.discoveries) EXPECT_EQ(count, 1) << object;
  scene.expect_newest(*scene.dozing);
}

TEST(Buffering, RandomReadersAllEndWithTheNewestState) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    DozingHarbour scene;
    std::vector<ObjectHandle> vessels;
    for (int tick = 1; tick <= 200; ++tick) {
      for (auto* each : {scene.steady, scene.dozing}) {
        if (random() % 10 == 0) each->is_reading = !each->is_reading;
      }
      if (vessels.size() < 40 && random() % 2 == 0)
        vessels.push_back(scene.master->ambassador.register_object_instance(vessel));
      if (!vessels.empty() && random() % 8 == 0) {
        const std::size_t victim = random() % vessels.size();
        scene.master->ambassador.delete_object_instance(vessels[victim]);
        scene.newest.erase(vessels[victim].value);
        vessels.erase(vessels.begin() + static_cast<std::ptrdiff_t>(victim));
      }
      for (const ObjectHandle each : vessels) {
        if (random() % 3 != 0) scene.move(each, static_cast<float>(tick));
      }
      scene.tick();
    }
    for (auto* each : {scene.steady, scene.dozing}) each->is_reading = true;
    for (int i = 0; i < 3; ++i) scene.tick();
    for (auto* each : {scene.steady, scene.dozing}) {
      scene.expect_newest(*each);
      EXPECT_EQ(each->heard.objects.size(), vessels.size());
      EXPECT_EQ(each->heard.out_of_scope_updates, 0);
      for (const auto& [object, count] : each->heard.discoveries) EXPECT_EQ(count, 1) << object;
    }
  }
}

/// A user's own: every destination hears of values at every third flush only.
class EveryThird final : public Buffering {
 public:
  void append(const ObjectUpdate& update) override { runs_.append(update); }
  std::span<const UpdateRun> seal() override {
    ++flushes_;
    runs_.seal();
    return runs_.runs();
  }
  void clear() override { runs_.clear(); }
  bool holds_back(std::uint32_t, std::size_t) override { return flushes_ % 3 != 0; }
  void remove_federate(std::uint32_t) override {}

 private:
  UpdateRuns runs_;
  int flushes_ = 0;
};

TEST(Buffering, IsReplaceableByAUsersOwn) {
  FederationServices services;
  services.buffering = [] { return std::make_unique<EveryThird>(); };
  DozingHarbour scene(services);
  const ObjectHandle object = scene.master->ambassador.register_object_instance(vessel);
  for (int tick = 1; tick <= 30; ++tick) {
    scene.move(object, static_cast<float>(tick));
    scene.tick();
  }
  scene.tick();
  scene.tick();
  EXPECT_EQ(scene.steady->heard.objects.at(object.value).updates, 10 + 1)
      << "one of three, and the last";
  scene.expect_newest(*scene.steady);
}

}  // namespace
}  // namespace rink::rti::testing
