// Views of raw bytes, and the numbers that transports give their conversations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rink::rti {

/// One conversation with one peer. Never used twice within a transport.
using ConnectionId = std::uint32_t;

using Bytes = std::span<const std::byte>;

/// One datagram in two parts: a head for its receiver alone, and a body that many receivers may
/// share.
struct Datagram {
  Bytes head, body;
  bool does_body_stay = false;  ///< valid until the transport's next `push`; else, as the head,
                                ///< during the call only
};

}  // namespace rink::rti
