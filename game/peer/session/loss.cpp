// Writes and reads a loss.
#include "game/peer/session/loss.h"

#include "game/peer/message_bytes.h"

namespace rink::peer {

std::vector<std::uint8_t> written(Loss message) { return bytes_from(message); }
bool read(std::span<const std::uint8_t> bytes, Loss& message) { return read_whole(bytes, message); }

}  // namespace rink::peer
