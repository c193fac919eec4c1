// Uses an installed Rink as any other project would: a filter decides who sees whom, an object model is read and asked.
#include <cstdio>

#include "im/filter.h"
#include "rti/fom.h"

namespace {

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
  return changes.size() == 1 && changes[0].entity == 7 && changes[0].transition == rink::im::Transition::entered;
}

bool model_has_a_ship_with_a_position() {
  const rink::rti::Fom fom = rink::rti::Fom::parse(model, "consumer.xml");
  const auto ship = fom.object_class("Ship");
  return ship && fom.attribute(*ship, "position");
}

}  // namespace

int main() {
  if (!touching_regions_overlap()) return std::puts("touching regions were missed"), 1;
  if (!model_has_a_ship_with_a_position()) return std::puts("the object model was misread"), 1;
  return 0;
}
