// When a federate is told: at once, when it asks, or when it allows it again.
#include "rti/federate/ambassador_services.h"

namespace rink::rti {

bool AmbassadorServices::evoke_callback() { return evoke_multiple_callbacks(1); }

bool AmbassadorServices::evoke_multiple_callbacks(std::size_t count_max) {
  if (!queue_) return false;
  if (queue_->is_delivering())
    throw RtiException(HlaError::call_not_allowed_from_within_callback,
                       "callbacks are evoked one after the other");
  for (std::size_t count = 0; count < count_max && are_callbacks_enabled_ && !queue_->is_empty();
       ++count)
    queue_->deliver_one();
  return !queue_->is_empty();
}

/// Keeps bytes that nobody may be told of yet.
bool AmbassadorParts::hold(Bytes bytes) {
  held_.insert(held_.end(), bytes.begin(), bytes.end());
  if (held_.size() <= waiting_callbacks_max) return true;
  lose("callbacks were disabled for too long");
  return false;
}

/// While bytes wait unread, nobody would tell that somebody listens.
void AmbassadorServices::disable_callbacks() {
  are_callbacks_enabled_ = false;
  if (!may_spare()) release_spared(ObjectClassHandle{}, AttributeSet(~0u));
}

void AmbassadorServices::enable_callbacks() {
  are_callbacks_enabled_ = true;
  if (queue_) return;
  const std::vector<std::byte> held = std::move(held_);
  held_.clear();
  const std::string loss = std::move(held_loss_);
  held_loss_.clear();
  if (!held.empty()) take_bytes(held);
  apply_held_datagrams();
  if (!loss.empty()) lose(loss);
}

}  // namespace rink::rti
