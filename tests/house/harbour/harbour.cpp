// Two federates in one process: the captain registers a ship, the lighthouse discovers it.
#include <cstdio>

#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"

using namespace rink::rti;

constexpr const char* model = R"(<objectModel><objects><objectClass><name>HLAobjectRoot</name>
  <objectClass><name>Ship</name>
    <attribute><name>speed</name><dataType>HLAfloat64BE</dataType></attribute>
  </objectClass></objectClass></objects></objectModel>)";

struct Keeper : FederateAmbassador {
  void discover_object_instance(ObjectHandle, ObjectClassHandle, std::string_view name) override {
    std::printf("discovered %.*s\n", static_cast<int>(name.size()), name.data());
  }
};

int main() {
  const Fom fom = Fom::parse(model, "harbour.xml");
  const ObjectClassHandle ship = *fom.object_class("Ship");

  InProcessNetwork network;
  InProcessEndpoint hub(network), sea(network);
  FederationExecution execution(fom, {.federation = "harbour"});
  FederationHost host(execution);
  hub.listen("rti");
  host.add(hub);

  FederateAmbassador quiet;
  Keeper keeper;
  Ambassador captain(fom, quiet), lighthouse(fom, keeper);
  FederateLink first(captain, sea, sea.connect("rti")), second(lighthouse, sea, sea.connect("rti"));
  FederateLinks links;
  links.add(first);
  links.add(second);

  captain.join("harbour", "captain", "ship");
  captain.publish_object_class_attributes(ship, fom.attributes(ship));
  lighthouse.join("harbour", "lighthouse", "watcher");
  lighthouse.subscribe_object_class_attributes(ship, fom.attributes(ship));
  for (int round = 0; round < 8; ++round) {
    if (round == 4) captain.register_object_instance(ship, "Pequod");
    links.flush(0.0);
    host.poll({});
    host.match();
    host.flush();
    sea.poll({}, links);
  }
}
