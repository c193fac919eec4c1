// Who of those that have not joined has been there longest.
#pragma once

#include <optional>

#include "rti/central_component.h"

namespace rink::rti {

/// Of `connections`, a list by id whose elements say `since` when they are there [s], those that
/// have been there for `stranger_due_s` at `now` and pass the test `is_stranger`: the oldest.
template <typename ConnectionList, typename IsStranger>
std::optional<ConnectionId> oldest_stranger_of(const ConnectionList& connections, double now,
                                               const IsStranger& is_stranger) {
  std::optional<ConnectionId> oldest;
  for (ConnectionId id = 0; id < connections.size(); ++id)
    if ((!oldest || connections[id].since < connections[*oldest].since) &&
        now - connections[id].since >= stranger_due_s && is_stranger(id))
      oldest = id;
  return oldest;
}

}  // namespace rink::rti
