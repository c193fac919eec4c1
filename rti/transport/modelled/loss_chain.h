// The states of one direction of a link that loses packets, one packet after the other.
#pragma once

#include <cassert>
#include <cstdint>

#include "rti/transport/modelled/link_stream.h"
#include "rti/transport/modelled/packet_loss.h"

namespace rink::rti {

/// The chain of one direction of one link. It starts in a state drawn from the long run, so that no
/// warm-up is needed.
class LossChain {
 public:
  LossChain() = default;
  LossChain(const PacketLoss& loss, std::uint64_t key)
      : stream_(key), is_bad_(stream_.coin(loss.bad_fraction())) {
    assert(loss.is_possible());
  }
  /// Whether the next packet is lost. Draws two numbers, so that chains of one key and different
  /// probabilities stay in step.
  bool loses_next(const PacketLoss& loss) {
    const bool changes = stream_.coin(is_bad_ ? loss.to_good : loss.to_bad);
    is_bad_ ^= changes;
    return stream_.coin(is_bad_ ? loss.loss_bad : loss.loss_good);
  }

 private:
  LinkStream stream_;
  bool is_bad_ = false;
};

}  // namespace rink::rti
