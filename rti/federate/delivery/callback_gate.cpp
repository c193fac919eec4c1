// Holds callbacks back and evokes them.
#include "rti/federate/delivery/callback_gate.h"

#include <cassert>

namespace rink::rti {

bool CallbackGate::evoke(std::size_t count_max) {
  if (!queue_) return false;
  if (queue_->is_delivering())
    throw RtiException(HlaError::call_not_allowed_from_within_callback,
                       "callbacks are evoked one after the other");
  for (std::size_t count = 0; count < count_max && are_enabled_ && !queue_->is_empty(); ++count)
    queue_->deliver_one();
  return !queue_->is_empty();
}

bool CallbackGate::hold(Bytes bytes) {
  assert(!is_open());
  held_.insert(held_.end(), bytes.begin(), bytes.end());
  return held_.size() <= waiting_max;
}

void CallbackGate::hold_loss(std::string_view why) {
  assert(!is_open());
  held_loss_ = why;
}

}  // namespace rink::rti
