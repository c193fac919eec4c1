// Texts for the reasons why connections close.
#include "rti/transport/transport.h"

namespace rink::rti {

const char* to_string(CloseReason reason) {
  switch (reason) {
    case CloseReason::closed_by_peer:
      return "closed by peer";
    case CloseReason::closed_by_us:
      return "closed by us";
    case CloseReason::queue_full:
      return "queue full";
    case CloseReason::refused:
      return "refused";
    case CloseReason::failed:
      return "failed";
    case CloseReason::too_fast:
      return "sent faster than allowed";
    case CloseReason::too_many:
      return "too many connections from one address";
  }
  return "unknown reason";
}

}  // namespace rink::rti
