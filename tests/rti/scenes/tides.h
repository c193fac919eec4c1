// Stations over real datagrams: the first owns gauges, all others listen to their level.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <memory>
#include <string>

#include "rti/transport/udp/udp.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

class Tides {
 public:
  const ObjectClassHandle tide = *harbour().object_class("Tide");
  const AttributeSet level = harbour().attributes(tide);
  UdpTransport server, clients;
  FederationExecution execution{harbour(), {}};
  FederationHost host{execution};
  const std::uint16_t port = server.listen("127.0.0.1", 0);
  std::deque<Station> stations;
  FederateLinks links;
  double now = 0.0;

  Tides() { host.add(server); }

  /// One more, which reaches the RTI at `at`.
  void join(std::uint16_t at) {
    const std::size_t number = stations.size();
    Station& station = stations.emplace_back(harbour());
    station.link = std::make_unique<FederateLink>(station.ambassador, clients,
                                                  clients.connect("127.0.0.1", at));
    links.add(*station.link);
    station.ambassador.join("rink", "station " + std::to_string(number), "");
    if (number == 0) station.ambassador.publish_object_class_attributes(tide, level);
    else station.ambassador.subscribe_object_class_attributes(tide, level);
  }
  void serve() {
    host.poll(std::chrono::microseconds(200));
    host.advance_clock(now);
    host.match();
    host.flush();
  }
  void round(double seconds) {
    now += seconds;
    links.flush(now);
    serve();
    clients.poll(std::chrono::microseconds(200), links);
  }
  /// Until every station has joined and its datagrams pass, but not for ever; `act` is a round.
  template <class Act>
  void open_ways(Act act) {
    const auto are_open = [&] {
      return execution.federate_count() == stations.size() &&
             server.udp_counters().ways_opened == stations.size();
    };
    for (int i = 0; i < 5000 && !are_open(); ++i) act();
    ASSERT_TRUE(are_open());
  }
  void set(ObjectHandle gauge, double value, double time) {
    stations[0].ambassador.update_attribute_values(gauge, level, values_of(value), {time, 0});
  }
};

}  // namespace rink::rti::testing
