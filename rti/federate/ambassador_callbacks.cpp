// When a federate is told: at once, when it asks, or when it allows it again.
#include "rti/federate/ambassador_services.h"

namespace rink::rti {

/// While bytes wait unread, nobody would tell that somebody listens.
void AmbassadorServices::disable_callbacks() {
  gate_.disable();
  if (!may_spare()) release_spared(ObjectClassHandle{}, AttributeSet(~0u));
}

void AmbassadorServices::enable_callbacks() {
  const bool was_open = gate_.is_open();
  gate_.enable();
  const std::vector<std::byte> held = gate_.take_held();
  const std::string loss = gate_.take_held_loss();
  if (!held.empty()) take_bytes(held);
  if (!was_open) apply_held_datagrams();
  if (!loss.empty()) lose(loss);
}

}  // namespace rink::rti
