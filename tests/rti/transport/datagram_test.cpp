// Best-effort updates by datagrams that are lost, doubled, late and early: who hears of an object
// knows its newest state in the end, and never goes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/rti/scenes/strait.h"

namespace rink::rti::testing {
namespace {

using namespace over_the_strait;

/// What the air does to datagrams.
struct Air {
  double loss = 0.0, doubling = 0.0,
         delay = 0.0;       ///< probabilities; a delayed one stays for up to eight polls
  bool is_blocked = false;  ///< nothing gets through
  std::size_t size_max = 1191;
};

/// An in-process end that also carries datagrams, badly.
class StormyEndpoint final : public Transport, private TransportListener {
 public:
  StormyEndpoint(InProcessNetwork& network, Air& weather, std::mt19937& random)
      : stream_(network), weather_(weather), random_(random) {}
  InProcessEndpoint& stream() { return stream_; }
  /// Where this end's datagrams of `connection` come out.
  void lead(ConnectionId connection, StormyEndpoint& other, ConnectionId there) {
    if (connection >= leads_.size()) leads_.resize(connection + 1);
    leads_[connection] = {&other, there};
  }
  void poll(std::chrono::nanoseconds wait, TransportListener& listener) override {
    listener_ = &listener;
    std::vector<Arrival> here;
    std::erase_if(arrivals_, [&](Arrival& each) {
      return --each.polls < 0 ? (here.push_back(std::move(each)), true) : false;
    });
    // Before or after what the stream brings, as it happens.
    const bool is_first = random_() % 2 == 0;
    if (!is_first) stream_.poll(wait, *this);
    for (const Arrival& each : here)
      if (is_open_.contains(each.connection)) listener.on_datagram(each.connection, each.bytes);
    if (is_first) stream_.poll(wait, *this);
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    stream_.send(connection, parts);
  }
  void close(ConnectionId connection) override { stream_.close(connection); }
  TransportCounters counters(ConnectionId connection) const override {
    return stream_.counters(connection);
  }
  std::size_t datagram_max(ConnectionId) const override { return weather_.size_max; }
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override {
    for (const Datagram& each : datagrams) {
      ++sent;
      EXPECT_LE(each.head.size() + each.body.size(), weather_.size_max);
      if (weather_.is_blocked || chance() < weather_.loss || connection >= leads_.size()) continue;
      for (int copies = chance() < weather_.doubling ? 2 : 1; copies > 0; --copies) {
        Arrival arrival{leads_[connection].second,
                        {each.head.begin(), each.head.end()},
                        chance() < weather_.delay ? static_cast<int>(random_() % 8) : 0};
        arrival.bytes.insert(arrival.bytes.end(), each.body.begin(), each.body.end());
        leads_[connection].first->arrivals_.push_back(std::move(arrival));
      }
    }
  }
  int sent = 0;

 private:
  struct Arrival {
    ConnectionId connection;
    std::vector<std::byte> bytes;
    int polls;
  };
  double chance() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  void on_open(ConnectionId connection) override {
    is_open_.insert(connection), listener_->on_open(connection);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    listener_->on_bytes(connection, bytes);
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override {
    is_open_.erase(connection), listener_->on_close(connection, reason, detail);
  }

  InProcessEndpoint stream_;
  Air& weather_;
  std::mt19937& random_;
  TransportListener* listener_ = nullptr;
  std::vector<std::pair<StormyEndpoint*, ConnectionId>> leads_;
  std::vector<Arrival> arrivals_;
  std::set<ConnectionId> is_open_;
};

/// Keeps each attribute's value and counts every step back: values only grow.
struct BuoyWatcher : FederateAmbassador {
  Ambassador ambassador;
  std::unique_ptr<FederateLink> link;
  BuoyWatcher() : ambassador(strait(), *this) {}
  struct Known {
    bool is_in_scope = false;
    double height = -1.0;
    float heading = -1.0f;
  };
  std::map<std::uint32_t, Known> known;
  int went_back = 0, unknown = 0;
  void discover_object_instance(ObjectHandle object, ObjectClassHandle, std::string_view) override {
    known[object.value] = {};
  }
  void remove_object_instance(ObjectHandle object) override { known.erase(object.value); }
  void attributes_in_scope(ObjectHandle object) override { known[object.value].is_in_scope = true; }
  void attributes_out_of_scope(ObjectHandle object) override {
    known[object.value].is_in_scope = false;
  }
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp&) override {
    if (!known.contains(object.value) || !known[object.value].is_in_scope) ++unknown;
    Known& one = known[object.value];
    if (set.includes(height))
      read(strait().value(buoy, set, *strait().attribute(buoy, "height"), values), one.height);
    if (set.includes(heading))
      read(strait().value(buoy, set, *strait().attribute(buoy, "heading"), values), one.heading);
  }
  template <class Number>
  void read(Bytes bytes, Number& value) {
    Number is = 0;
    std::memcpy(&is, bytes.data(), sizeof is);
    went_back += is < value ? 1 : 0;
    value = is;
  }
};

/// A publisher beside the RTI, and watchers behind the weather.
class StormySea {
 public:
  explicit StormySea(unsigned seed, int watchers = 2) : random_(seed) {
    near_.listen("near");
    far_.stream().listen("far");
    host_.add(near_);
    host_.add(far_);
    publisher.link =
        std::make_unique<FederateLink>(publisher.ambassador, own_, own_.connect("near"));
    own_links_.add(*publisher.link);
    publisher.ambassador.join("rink", "publisher", "");
    publisher.ambassador.publish_object_class_attributes(buoy, number | height | heading);
    for (int i = 0; i < watchers; ++i) add_watcher();
    rounds(10);
  }
  BuoyWatcher& add_watcher() {
    BuoyWatcher& watcher = watchers.emplace_back();
    const ConnectionId here = clients_.stream().connect("far"), there = next_there_++;
    watcher.link = std::make_unique<FederateLink>(watcher.ambassador, clients_, here);
    links_.add(*watcher.link);
    clients_.lead(here, far_, there);
    far_.lead(there, clients_, here);
    watcher.ambassador.join("rink", "watcher " + std::to_string(there), "");
    watcher.ambassador.subscribe_object_class_attributes(buoy, number | height | heading);
    return watcher;
  }
  void round(double seconds = 1.0 / 60.0) {
    now += seconds;
    own_links_.flush(now);
    links_.flush(now);
    host_.poll({});
    host_.advance_clock(now);
    host_.match();
    host_.flush();
    clients_.poll({}, links_);
    own_.poll({}, own_links_);
  }
  void rounds(int count) {
    for (int i = 0; i < count; ++i) round();
  }
  ObjectHandle place_buoy() {
    buoys.push_back(publisher.ambassador.register_object_instance(buoy));
    truth[buoys.back().value] = {};
    return buoys.back();
  }
  void update(ObjectHandle object, AttributeSet set) {
    std::vector<std::byte> values;
    if (set.includes(number)) values = values_of(std::int32_t{1});
    if (set.includes(height)) append(values, values_of(truth[object.value].height += 1.0));
    if (set.includes(heading)) append(values, values_of(truth[object.value].heading += 1.0f));
    publisher.ambassador.update_attribute_values(object, set, values, {now, 0});
  }
  /// Everybody's mirror against what was last said; nobody ever went back or heard of what he did
  /// not see.
  void expect_truth() {
    for (const BuoyWatcher& watcher : watchers) {
      EXPECT_EQ(watcher.went_back, 0);
      EXPECT_EQ(watcher.unknown, 0);
      EXPECT_EQ(watcher.known.size(), buoys.size());
      for (const auto& [handle, is] : watcher.known) {
        if (!is.is_in_scope) continue;
        EXPECT_EQ(is.height, truth[handle].height) << "object " << handle;
        EXPECT_EQ(is.heading, truth[handle].heading) << "object " << handle;
      }
    }
  }
  static void append(std::vector<std::byte>& bytes, const std::vector<std::byte>& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  const FederationCounters& counters() const { return execution_.counters(); }
  FederationExecution& execution() { return execution_; }
  StormyEndpoint& far() { return far_; }
  StormyEndpoint& clients() { return clients_; }

  double now = 0.0;
  Air weather;
  BuoyWatcher publisher;
  std::deque<BuoyWatcher> watchers;
  std::vector<ObjectHandle> buoys;
  std::map<std::uint32_t, BuoyWatcher::Known> truth;

 private:
  std::mt19937 random_;
  InProcessNetwork network_;
  InProcessEndpoint near_{network_}, own_{network_};
  StormyEndpoint far_{network_, weather, random_}, clients_{network_, weather, random_};
  FederationExecution execution_{strait(), {}};
  FederationHost host_{execution_};
  FederateLinks own_links_, links_;
  ConnectionId next_there_ = 0;
};

TEST(Datagrams, BestEffortUpdatesTakeThemAndReliableOnesDoNot) {
  StormySea sea(1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, number | height | heading);
  sea.rounds(5);
  sea.expect_truth();
  const int before = sea.far().sent;
  sea.update(object, number);
  sea.rounds(1);
  EXPECT_EQ(sea.far().sent, before);
  sea.update(object, height);
  sea.rounds(1);
  EXPECT_EQ(sea.far().sent, before + 2) << "one for each watcher";
  sea.update(object, number | heading);
  sea.rounds(1);
  EXPECT_EQ(sea.far().sent, before + 4) << "an update of both kinds is told apart";
  sea.rounds(3);
  sea.expect_truth();
  EXPECT_EQ(sea.counters().updates_repaired, 0u);
}

TEST(Datagrams, CostNothingWhereNothingIsBestEffort) {
  Rig rig(Carrier::in_process);
  Station& pilot = rig.join("pilot");
  Station& coast = rig.join("coast");
  pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
  coast.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position, speed});
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(object, AttributeSet{position, speed},
                                           values_of(1.0f, 2.0f, 3.0f), {});
  rig.settle();
  EXPECT_EQ(rig.execution().counters().datagrams_sent, 0u);
  EXPECT_EQ(coast.ambassador.counters().datagrams_received, 0u);
  EXPECT_EQ(coast.heard.objects[object.value].updates, 1);
}

TEST(Datagrams, AreAcknowledgedTenTimesASecondWhereNoneIsMissing) {
  StormySea sea(8, 1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height);
  sea.rounds(10);
  const int before = sea.clients().sent;
  const std::uint64_t frames_before = sea.counters().frames_sent;
  for (int tick = 0; tick < 180; ++tick) {
    sea.update(object, height);
    sea.round();
  }
  EXPECT_GE(sea.clients().sent - before, 3 * 8);
  EXPECT_LE(sea.clients().sent - before, 3 * 10 + 1);
  EXPECT_LE(sea.counters().frames_sent - frames_before, 4u)
      << "and who hears of us by datagrams needs no heartbeats";
  sea.expect_truth();
}

TEST(Datagrams, ManyObjectsAreCutIntoDatagramsOfTheAllowedSize) {
  StormySea sea(2);
  for (int i = 0; i < 500; ++i) sea.place_buoy();
  sea.rounds(3);
  for (int tick = 0; tick < 3; ++tick) {
    for (const ObjectHandle object : sea.buoys) sea.update(object, height);
    sea.rounds(1);
  }
  sea.rounds(5);
  sea.expect_truth();
  EXPECT_GE(sea.counters().datagrams_sent, 3u * 2u * (500u * 10u / 1191u));
}

TEST(Datagrams, ALostFinalStateIsRepaired) {
  StormySea sea(3, 1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height | heading);
  sea.rounds(5);
  sea.weather.is_blocked = true;
  sea.update(object, height);
  sea.update(object, heading);
  sea.rounds(1);
  sea.weather.is_blocked = false;
  sea.rounds(2);
  EXPECT_NE(sea.watchers[0].known[object.value].height, sea.truth[object.value].height);
  sea.rounds(30);
  sea.expect_truth();
  EXPECT_GE(sea.counters().updates_repaired, 1u);
}

TEST(Datagrams, StormsChangeNothingInTheEnd) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    StormySea sea(seed, 3);
    sea.weather = {.loss = 0.3,
                   .doubling = 0.2,
                   .delay = 0.5,
                   .is_blocked = false,
                   .size_max = seed % 2 == 0 ? 1191u : 300u};
    std::mt19937 random(seed);
    for (int tick = 0; tick < 200; ++tick) {
      if (tick < 40 && tick % 2 == 0) sea.place_buoy();
      for (const ObjectHandle object : sea.buoys) {
        const unsigned choice = random() % 8;
        if (choice < 3)
          sea.update(object, choice == 0 ? height : choice == 1 ? heading : height | heading);
        if (choice == 3 && tick % 10 == 0) sea.update(object, number | height);
      }
      // Watchers look away and come back, which brings the whole state by the stream, ahead of
      // datagrams that are still on their way.
      if (tick % 7 == 3) {
        BuoyWatcher& watcher = sea.watchers[random() % 3];
        watcher.ambassador.unsubscribe_object_class(buoy);
        sea.round();
        watcher.ambassador.subscribe_object_class_attributes(buoy, number | height | heading);
      }
      sea.round();
    }
    sea.weather = {};
    sea.rounds(150);
    sea.expect_truth();
    EXPECT_GT(sea.counters().updates_repaired, 0u);
    EXPECT_EQ(sea.counters().datagram_fallbacks, 0u);
  }
}

TEST(Datagrams, AWayThatLosesEverythingFallsBackToTheStreamAndOpensAgain) {
  StormySea sea(5);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height | heading);
  sea.rounds(5);
  sea.weather.is_blocked = true;
  for (int tick = 0; tick < 180; ++tick) {
    sea.update(object, height);
    sea.round();
  }
  EXPECT_EQ(sea.counters().datagram_fallbacks, 2u) << "one for each watcher";
  sea.rounds(2);
  sea.expect_truth();
  sea.weather.is_blocked = false;
  sea.rounds(100);
  EXPECT_EQ(sea.counters().datagram_recoveries, 2u);
  const int before = sea.far().sent;
  sea.update(object, height);
  sea.rounds(2);
  EXPECT_GE(sea.far().sent, before + 2);
  sea.expect_truth();
}

TEST(Datagrams, NonsenseIsIgnoredAndCounted) {
  StormySea sea(6, 1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height);
  sea.rounds(5);
  std::mt19937 random(6);
  BuoyWatcher& watcher = sea.watchers[0];
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> bytes(random() % 60);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % (i % 2 == 0 ? 256 : 64));
    if (bytes.size() >= 8 && i % 3 != 0) {
      // A plausible number, or receipts of all later ones would be spoilt, as a stranger without
      // the key cannot.
      std::fill(bytes.begin(), bytes.begin() + 8, std::byte{0});
    }
    if (i % 3 != 0) watcher.ambassador.receive_datagram(bytes);
    sea.execution().receive_datagram(1, bytes);
    sea.execution().receive_datagram(77, bytes);
  }
  EXPECT_GT(watcher.ambassador.counters().datagrams_ignored, 100u);
  EXPECT_GT(sea.counters().datagrams_ignored, 100u);
  sea.update(object, height);
  sea.rounds(60);
  sea.expect_truth();
  EXPECT_EQ(sea.execution().federate_count(), 2u);
}

TEST(DatagramReceipts, TellOfTheLastSixtyFourAsASetWould) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    DatagramReceipts receipts;
    std::set<std::uint32_t> arrived;
    std::uint32_t front = 1;
    for (int i = 0; i < 500; ++i) {
      const auto back = static_cast<std::uint32_t>(random() % 80),
                 number = front > back ? front - back : 1;
      if (random() % 3 == 0)
        front += 1 + static_cast<std::uint32_t>(random() % (seed % 5 == 0 ? 100 : 3));
      const std::uint32_t newest = arrived.empty() ? 0 : *arrived.rbegin();
      const bool is_new = !arrived.contains(number) && (number > newest || newest - number <= 64);
      EXPECT_EQ(receipts.note(number), is_new) << number << " after " << newest;
      if (is_new) arrived.insert(number);
      const AcknowledgeDatagramsMessage told = receipts.acknowledge();
      for (std::uint32_t age = 0; age <= 64 && age < told.newest; ++age)
        EXPECT_EQ(told.has(told.newest - age), arrived.contains(told.newest - age));
    }
  }
}

}  // namespace
}  // namespace rink::rti::testing
