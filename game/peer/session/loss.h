// The message between peers when one of them is gone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/messages.h"

namespace rink::peer {

/// A peer's message after a loss: its last step, and all lost peers that it knows of.
struct Loss {
  std::uint64_t word = 0x73736f4c6b6e6952ULL;  ///< marks the message: "RinkLoss"
  std::uint64_t step = 0;
  std::vector<PeerNumber> gone{};
  std::vector<PeerNumber> finished{};  ///< of these, those that left in good order
};

template <class Stream>
bool exchange(Stream& stream, Loss& loss) {
  return stream.number(loss.word) && loss.word == Loss{}.word && stream.number(loss.step) &&
         exchange_numbers(stream, loss.gone) && exchange_numbers(stream, loss.finished);
}
std::vector<std::uint8_t> written(Loss message);
bool read(std::span<const std::uint8_t> bytes, Loss& message);

}  // namespace rink::peer
