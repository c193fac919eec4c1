// The general case of an object's newest stamp, needed once some object has changed owners.
#include "rti/federation/services/newest_stamps.h"

namespace rink::rti {

Stamp NewestStamps::among_owners(ObjectSlot object) const {
  Stamp newest = object < inherited_.size() ? inherited_[object] : Stamp();
  const auto include = [&](std::uint32_t federate) {
    if (federate < newest_.size() && newest_[federate].time > newest.time)
      newest = newest_[federate];
  };
  const std::uint32_t owner = objects_[object].owner;
  if (owner != no_federate) include(owner);
  else ownership_.for_each_owner(object, include);
  return newest;
}

}  // namespace rink::rti
