// Decides when callbacks are delivered: at once, when the federate evokes them, or when it enables
// them again.
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

/// In the immediate model messages that arrive while callbacks are disabled are held back unread;
/// in the evoked model they are read at once and their callbacks wait in a queue.
class CallbackGate {
 public:
  /// Limit of the callbacks that wait to be evoked, or of the messages held back [bytes].
  static constexpr std::size_t waiting_max = 64u << 20;

  /// `federate` must outlive it.
  CallbackGate(FederateAmbassador& federate, CallbackModel model)
      : queue_(model == CallbackModel::evoked ? std::make_unique<CallbackQueue>(federate)
                                              : nullptr),
        callbacks_(queue_ ? *queue_ : federate) {}

  /// The receiver of callbacks.
  FederateAmbassador& callbacks() const { return callbacks_; }
  /// True if messages may be read now.
  bool is_open() const { return are_enabled_ || queue_; }
  void disable() { are_enabled_ = false; }
  void enable() { are_enabled_ = true; }

  /// Returns whether more wait. Throws CallNotAllowedFromWithinCallback.
  bool evoke(std::size_t count_max);
  /// True if more callbacks wait than the limit allows.
  bool is_overfull() const { return queue_ && queue_->waiting_bytes() > waiting_max; }

  /// Holds bytes back. The gate must be closed. False if they exceed the limit.
  bool hold(Bytes bytes);
  /// Holds back that the connection is lost, until what came before is delivered. The gate must be
  /// closed.
  void hold_loss(std::string_view why);
  std::vector<std::byte> take_held() { return std::exchange(held_, {}); }
  /// Empty if the connection was not lost.
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
