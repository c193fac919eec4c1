// Uses an installed Rink as any other project would: a filter decides who sees whom, an object
// model is read and asked.
#include <cmath>
#include <cstdio>

#include "im/checked_filter.h"
#include "im/filter.h"
#include "im/schemes/predicate_filter.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"

namespace {

using rink::rti::Ambassador;

constexpr const char* model = R"(<?xml version="1.0"?>
<objectModel xmlns="http://standards.ieee.org/IEEE1516-2010">
  <modelIdentification><name>Consumer</name></modelIdentification>
  <objects>
    <objectClass><name>HLAobjectRoot</name>
      <objectClass><name>Ship</name>
        <attribute><name>position</name><dataType>HLAfloat64BE</dataType><transportation>HLAbestEffort</transportation><order>Receive</order></attribute>
      </objectClass>
    </objectClass>
  </objects>
</objectModel>
)";

bool touching_regions_overlap() {
  const auto filter = rink::im::make_filter("region", {.world = {0.0, 0.0, 10.0, 10.0}});
  filter->set_subscription_region(0, {0.0, 0.0, 5.0, 5.0});
  filter->set_update_region(7, {5.0, 5.0, 6.0, 6.0});
  const auto changes = filter->match();
  return changes.size() == 1 && changes[0].entity == 7 &&
         changes[0].transition == rink::im::Transition::entered;
}

/// A scheme of its own: ships are seen a third as far ahead as to the sides.
bool is_abeam(const rink::im::Party& lookout, const rink::im::Party& ship) {
  const double x = 0.5 * (lookout.region.low_x + lookout.region.high_x);
  return std::abs(0.5 * (ship.region.low_x + ship.region.high_x) - x) <=
         (lookout.region.high_x - lookout.region.low_x) / 6.0;
}

bool a_predicate_is_a_whole_scheme() {
  rink::im::CheckedFilter filter(
      rink::im::make_predicate_filter({.world = {0.0, 0.0, 20.0, 20.0}}, &is_abeam), 100);
  filter.add_subscriber(0, {4.0, 4.0, 16.0, 16.0});
  filter.add_entity(1, {11.0, 15.0, 12.0, 16.0});
  filter.add_entity(2, {15.0, 10.0, 16.0, 11.0});
  const auto rejection = filter.add_entity(3, {1.0, 1.0, 0.0, 2.0});
  const auto changes = filter.match();
  return changes.size() == 1 && changes[0].entity == 1 && rejection &&
         rink::im::describe(*rejection) == "update region 3 is inverted: its low exceeds its high";
}

bool model_has_a_ship_with_a_position() {
  const rink::rti::Fom fom = rink::rti::Fom::parse(model, "consumer.xml");
  const auto ship = fom.object_class("Ship");
  return ship && fom.attribute(*ship, "position");
}

class Lookout : public rink::rti::FederateAmbassador {
 public:
  std::size_t ships = 0;
  void discover_object_instance(rink::rti::ObjectHandle, rink::rti::ObjectClassHandle,
                                std::string_view) override {
    ++ships;
  }
};

/// Two federates, one federation, no game: what one registers, the other discovers.
bool a_lookout_discovers_a_ship() {
  const rink::rti::Fom fom = rink::rti::Fom::parse(model, "consumer.xml");
  rink::rti::InProcessNetwork network;
  rink::rti::InProcessEndpoint hub(network), sea(network);
  rink::rti::FederationExecution execution(fom, {.federation = "fleet"});
  rink::rti::FederationHost host(execution);
  hub.listen("rti");
  host.add(hub);

  rink::rti::FederateAmbassador nothing;
  Lookout lookout;
  Ambassador captain(fom, nothing), crew(fom, lookout);
  rink::rti::FederateLink captains(captain, sea, sea.connect("rti")),
      crews(crew, sea, sea.connect("rti"));
  rink::rti::FederateLinks links;
  links.add(captains);
  links.add(crews);
  const auto exchange = [&] {
    for (int round = 0; round < 4; ++round) {
      host.poll({});
      host.match();
      host.flush();
      sea.poll({}, links);
      links.flush(0.0);
    }
  };
  const auto ship = *fom.object_class("Ship");
  captain.join("fleet", "captain", "ship");
  crew.join("fleet", "crew", "ship");
  captain.publish_object_class_attributes(ship, fom.attributes(ship));
  crew.subscribe_object_class_attributes(ship, fom.attributes(ship));
  exchange();
  const std::byte position[8] = {};
  captain.update_attribute_values(captain.register_object_instance(ship, "Pequod"),
                                  fom.attributes(ship), position, {});
  captains.flush(0.0);
  exchange();
  return lookout.ships == 1;
}

}  // namespace

int main() {
  if (!touching_regions_overlap()) return std::puts("touching regions were missed"), 1;
  if (!a_predicate_is_a_whole_scheme()) return std::puts("the predicate was not heard"), 1;
  if (!a_lookout_discovers_a_ship()) return std::puts("the ship was not discovered"), 1;
  if (!model_has_a_ship_with_a_position()) return std::puts("the object model was misread"), 1;
  return 0;
}
