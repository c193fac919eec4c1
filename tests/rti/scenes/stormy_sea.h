// A publisher beside the RTI, and watchers behind weather that loses, doubles and delays datagrams.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/rti/scenes/strait.h"

namespace rink::rti::testing::over_the_strait {

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

}  // namespace rink::rti::testing::over_the_strait
