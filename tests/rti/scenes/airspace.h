// An airspace: aircraft over up to four dimensions, and a federation of pilots without transports.
#pragma once

#include <deque>

#include <gtest/gtest.h>

#include "tests/rti/rig.h"

namespace rink::rti::testing {

/// An airspace: `Aircraft` over all four dimensions, of which `Channel` has an upper bound;
/// `weight` has none.
inline constexpr const char* airspace_xml =
    R"(<objectModel><objects><objectClass><name>HLAobjectRoot</name>
<objectClass><name>Aircraft</name>
  <attribute><name>position</name><dataType>HLAfloat64LE</dataType><dimensions><dimension>X</dimension><dimension>Y</dimension><dimension>Altitude</dimension><dimension>Channel</dimension></dimensions></attribute>
  <attribute><name>radio</name><dataType>HLAfloat64LE</dataType><dimensions><dimension>X</dimension><dimension>Y</dimension><dimension>Altitude</dimension><dimension>Channel</dimension></dimensions></attribute>
  <attribute><name>weight</name><dataType>HLAfloat64LE</dataType></attribute>
</objectClass></objectClass></objects>
<interactions><interactionClass><name>HLAinteractionRoot</name><interactionClass><name>Call</name>
  <dimensions><dimension>X</dimension><dimension>Y</dimension><dimension>Altitude</dimension><dimension>Channel</dimension></dimensions>
  <parameter><name>words</name><dataType>HLAoctet</dataType></parameter></interactionClass></interactionClass></interactions>
<dimensions><dimension><name>Altitude</name></dimension><dimension><name>X</name></dimension><dimension><name>Channel</name><upperBound>6</upperBound></dimension><dimension><name>Y</name></dimension></dimensions>
</objectModel>)";

inline const Fom& airspace() {
  static const Fom fom = Fom::parse(airspace_xml, "airspace.xml");
  return fom;
}
inline const ObjectClassHandle aircraft = *airspace().object_class("Aircraft");
inline const AttributeHandle where = *airspace().attribute(aircraft, "position"),
                             radio = *airspace().attribute(aircraft, "radio"),
                             weight = *airspace().attribute(aircraft, "weight");
inline const InteractionClassHandle call = *airspace().interaction_class("Call");
inline const DimensionHandle x = *airspace().dimension("X"), y = *airspace().dimension("Y"),
                             altitude = *airspace().dimension("Altitude"),
                             channel = *airspace().dimension("Channel");

struct Pilot {
  Recorder heard;
  Ambassador ambassador{airspace(), heard};
  Pilot() { heard.model = &airspace(); }
};

/// One federation execution and its pilots, who publish all. Services in, callbacks out.
template <class Member = Pilot>
class Flights : private Outlet {
 public:
  explicit Flights(int pilots, const FederationServices& services = {})
      : execution_(airspace(), settings(), services) {
    for (int i = 0; i < pilots; ++i) {
      Member& pilot = pilots_.emplace_back();
      execution_.connect(static_cast<ConnectionId>(i));
      pilot.ambassador.join("rink", "pilot " + std::to_string(i), "test");
    }
    tick();
    for (Member& pilot : pilots_) {
      pilot.ambassador.publish_object_class_attributes(aircraft, airspace().attributes(aircraft));
      pilot.ambassador.publish_interaction_class(call);
    }
  }
  static FederationSettings settings() {
    FederationSettings settings;
    settings.filter = "region";
    settings.filter_settings.world = {0.0, 0.0, 10.0, 10.0};
    return settings;
  }
  /// What was said goes to the RTI, which matches, and its answers come back.
  void tick() {
    for (ConnectionId id = 0; id < pilots_.size(); ++id) {
      execution_.receive(id, pilots_[id].ambassador.outgoing());
      pilots_[id].ambassador.clear_outgoing();
    }
    execution_.match();
    execution_.flush(*this);
    EXPECT_EQ(drops_, resigned) << "connections end only by resigning";
  }
  std::deque<Member>& pilots() { return pilots_; }
  FederationExecution& execution() { return execution_; }
  int resigned = 0;  ///< whose connections the test expects to end

 private:
  void send(ConnectionId id, std::span<const Bytes> parts) override {
    std::vector<std::byte> all;
    for (const Bytes part : parts) all.insert(all.end(), part.begin(), part.end());
    EXPECT_TRUE(pilots_[id].ambassador.receive(all));
  }
  void drop(ConnectionId, std::string_view) override { ++drops_; }

  FederationExecution execution_;
  std::deque<Member> pilots_;
  int drops_ = 0;
};

}  // namespace rink::rti::testing
