// A publisher whose datagrams fly over a strait, as the test says, and a listener who must always
// know the truth in the end.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <map>
#include <string>

#include "rti/wire/datagram.h"
#include "rti/wire/update_block.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing::over_the_strait {

inline constexpr const char* strait_xml = R"(<objectModel><objects><objectClass><name>Root</name>
<objectClass><name>Buoy</name>
  <attribute><name>number</name><dataType>HLAinteger32LE</dataType></attribute>
  <attribute><name>height</name><dataType>HLAfloat64LE</dataType><transportation>HLAbestEffort</transportation></attribute>
  <attribute><name>heading</name><dataType>HLAfloat32LE</dataType><transportation>HLAbestEffort</transportation></attribute>
</objectClass></objectClass></objects></objectModel>)";

inline const Fom& strait() {
  static const Fom fom = Fom::parse(strait_xml, "strait.xml");
  return fom;
}
inline const ObjectClassHandle buoy = *strait().object_class("Buoy");
inline AttributeSet only(const char* attribute) {
  return AttributeSet(1u << strait().attribute(buoy, attribute)->value);
}
inline const AttributeSet number = only("number"), height = only("height"),
                          heading = only("heading");

/// Keeps values, which only grow where they are told of, and notes each step back.
struct Ear : FederateAmbassador {
  struct Known {
    double height = -1.0;
    float heading = -1.0f;
  };
  std::map<std::uint32_t, Known> known;
  int reflections = 0, went_back = 0, confirmed = 0;
  std::string lost;
  std::function<void()>
      meanwhile;  ///< what the federate does in a callback before it looks at the values
  void discover_object_instance(ObjectHandle object, ObjectClassHandle, std::string_view) override {
    known[object.value] = {};
  }
  void remove_object_instance(ObjectHandle object) override { known.erase(object.value); }
  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp&) override {
    ++reflections;
    if (meanwhile) meanwhile();
    if (set.includes(height)) read(object, "height", set, values, known[object.value].height);
    if (set.includes(heading)) read(object, "heading", set, values, known[object.value].heading);
  }
  void confirm_attribute_transportation_type_change(ObjectHandle, AttributeSet,
                                                    Transportation) override {
    ++confirmed;
  }
  void connection_lost(std::string_view why) override { lost = why; }
  template <class Number>
  void read(ObjectHandle, const char* attribute, AttributeSet set, Bytes values, Number& value) {
    Number is = 0;
    std::memcpy(&is, strait().value(buoy, set, *strait().attribute(buoy, attribute), values).data(),
                sizeof is);
    went_back += is < value ? 1 : 0;
    value = is;
  }
};

/// The RTI, a publisher (0) whose datagrams fly over the strait, and a listener (1) with a stream
/// only.
class Strait final : public Outlet {
 public:
  FederationExecution execution{strait(), {}};
  Ear heard[2];
  Ambassador ambassadors[2]{{strait(), heard[0]}, {strait(), heard[1]}};
  Ambassador &publisher = ambassadors[0], &listener = ambassadors[1];
  std::deque<std::vector<std::byte>> up, down,
      frames;            ///< on their way: datagrams in either direction, the publisher's stream
  bool delivers = true;  ///< datagrams arrive with the tick in which they were sent
  bool holds_stream = false;
  std::size_t size_max = 400;
  double now = 0.0;

  Strait() {
    for (ConnectionId id = 0; id < 2; ++id) execution.connect(id);
    publisher.join("rink", "publisher", ""), listener.join("rink", "listener", "");
    tick();
    publisher.publish_object_class_attributes(buoy, number | height | heading);
    listener.subscribe_object_class_attributes(buoy, number | height | heading);
    tick(), tick();
  }
  void tick(double seconds = 0.05) {
    now += seconds;
    for (ConnectionId id = 0; id < 2; ++id) {
      Ambassador& ambassador = ambassadors[id];
      ambassador.advance_clock(now);
      ambassador.expect_datagrams(id == 0 ? size_max : 0);
      const std::span<const Datagram> datagrams = ambassador.outgoing_datagrams();
      const Bytes bytes = ambassador.outgoing();
      if (id == 0) frames.emplace_back(bytes.begin(), bytes.end());
      else execution.receive(id, bytes);
      for (const Datagram& each : datagrams) up.emplace_back(each.head.begin(), each.head.end());
      ambassador.clear_outgoing(), ambassador.clear_outgoing_datagrams();
    }
    if (!holds_stream) let_stream();
    if (delivers) arrive();
    execution.advance_clock(now);
    execution.match();
    execution.flush(*this);
    if (delivers) answer();
  }
  void let_stream() {
    for (; !frames.empty(); frames.pop_front()) execution.receive(0, frames.front());
  }
  void arrive() {
    for (; !up.empty(); up.pop_front()) execution.receive_datagram(0, up.front());
  }
  void answer() {
    for (; !down.empty(); down.pop_front()) publisher.receive_datagram(down.front());
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  ObjectHandle place() { return publisher.register_object_instance(buoy); }
  /// One whose updates go by datagram from the next one on; `value` has arrived.
  ObjectHandle place(double value) {
    const ObjectHandle object = place();
    ticks(3);
    set(object, value);
    tick();
    return object;
  }
  void set(ObjectHandle object, double value) {
    publisher.update_attribute_values(object, height, values_of(value), {now, 0});
  }
  double seen(ObjectHandle object) const {
    return heard[1].known.contains(object.value) ? heard[1].known.at(object.value).height : -2.0;
  }
  const FederationCounters& counters() const { return execution.counters(); }

 private:
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) EXPECT_TRUE(ambassadors[connection].receive(part));
  }
  void drop(ConnectionId connection, std::string_view why) override {
    ADD_FAILURE() << connection << " was dropped: " << why;
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    return connection == 0 ? size_max : 0;
  }
  void send_datagrams(ConnectionId, std::span<const Datagram> datagrams) override {
    for (const Datagram& each : datagrams) {
      std::vector<std::byte>& whole = down.emplace_back(each.head.begin(), each.head.end());
      whole.insert(whole.end(), each.body.begin(), each.body.end());
    }
  }
};

}  // namespace rink::rti::testing::over_the_strait
