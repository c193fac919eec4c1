// When a federate is told: at once, when it asks, or when it allows it again.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rti/callbacks/callback_queue.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// In the immediate model what comes while callbacks are disabled is held back unread; in the
/// evoked model it is read at once and its callbacks wait in a queue.
class CallbackGate {
 public:
  /// Of callbacks that wait to be evoked, or of what they would be made of [bytes].
  static constexpr std::size_t waiting_max = 64u << 20;

  /// `federate` must outlive it.
  CallbackGate(FederateAmbassador& federate, CallbackModel model)
      : queue_(model == CallbackModel::evoked ? std::make_unique<CallbackQueue>(federate)
                                              : nullptr),
        callbacks_(queue_ ? *queue_ : federate) {}

  /// Where callbacks go.
  FederateAmbassador& callbacks() const { return callbacks_; }
  /// Whether what comes may be read now.
  bool is_open() const { return are_enabled_ || queue_; }
  void disable() { are_enabled_ = false; }
  void enable() { are_enabled_ = true; }

  /// Whether some are left. Throws CallNotAllowedFromWithinCallback.
  bool evoke(std::size_t count_max);
  /// Whether more callbacks wait than may.
  bool is_overfull() const { return queue_ && queue_->waiting_bytes() > waiting_max; }

  /// What nobody may be told of yet. Must be closed. False if that is too much.
  bool hold(Bytes bytes);
  /// The connection is gone; that is told after what came before. Must be closed.
  void hold_loss(std::string_view why);
  std::vector<std::byte> take_held() { return std::exchange(held_, {}); }
  /// Empty if it was not lost.
  std::string take_held_loss() { return std::exchange(held_loss_, {}); }

  std::size_t memory_bytes() const {
    return held_.capacity() + (queue_ ? queue_->memory_bytes() : 0);
  }

 private:
  std::unique_ptr<CallbackQueue>
      queue_;  ///< null in the immediate model, which pays nothing for it
  FederateAmbassador& callbacks_;
  bool are_enabled_ = true;
  std::vector<std::byte> held_;
  std::string held_loss_;
};

}  // namespace rink::rti
