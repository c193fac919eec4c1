// What peers tell each other when one of them is gone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/messages.h"

namespace rink::peer {

/// What a peer says when somebody is gone: the last step that it has, and all who are gone as far
/// as it knows.
struct Loss {
  std::uint64_t word = 0x73736f4c6b6e6952ULL;  ///< tells it from all other messages: "RinkLoss"
  std::uint64_t step = 0;
  std::vector<PeerNumber> gone{};
  std::vector<PeerNumber> finished{};  ///< of these, who left in good order
};

template <class Stream>
bool exchange(Stream& stream, Loss& loss) {
  return stream.number(loss.word) && loss.word == Loss{}.word && stream.number(loss.step) &&
         exchange_numbers(stream, loss.gone) && exchange_numbers(stream, loss.finished);
}
std::vector<std::uint8_t> written(Loss message);
bool read(std::span<const std::uint8_t> bytes, Loss& message);

}  // namespace rink::peer
