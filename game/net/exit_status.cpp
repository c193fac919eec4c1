// Exit statuses for the errors of transports.
#include "game/net/exit_status.h"

#include "rti/transport/transport.h"

namespace rink::game {

ExitStatus exit_status(const std::exception& error, const TransportStatuses& statuses) {
  const auto* failure = dynamic_cast<const rti::TransportError*>(&error);
  if (failure == nullptr) return ExitStatus::bad_input;
  using Kind = rti::TransportError::Kind;
  switch (failure->kind()) {
    case Kind::in_use:
    case Kind::no_such_address:
    case Kind::no_permission:
      return statuses.bad_address;
    case Kind::too_many_files:
      return statuses.too_many_files;
    default:
      return statuses.otherwise;
  }
}

}  // namespace rink::game
