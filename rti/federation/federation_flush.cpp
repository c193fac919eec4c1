// The order in which a flush says what has come together.
#include "rti/federation/federation_parts.h"

namespace rink::rti {

void FederationParts::flush(Outlet& outlet) {
  send_answers(outlet);
  update_requests_.settle();
  sender_.flush(outlet);
  update_requests_.flushed();
  interactions_.flushed();
  objects_.recycle();
  for (const Farewell& each : farewells_) {
    const Bytes bytes = each.bytes;
    if (!bytes.empty()) outlet.send(each.connection, std::span(&bytes, 1));
    outlet.drop(each.connection, each.why);
  }
  farewells_.clear();
}

}  // namespace rink::rti
