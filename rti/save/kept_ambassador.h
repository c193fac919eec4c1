// What a federate's ambassador knows, as one stretch of bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/wire/bytes.h"

namespace rink::rti {

class AmbassadorParts;

/// Appends the state: known objects, names, declarations, regions, ownership, logical time, and
/// messages that wait for it.
void write_state(AmbassadorParts& parts, std::vector<std::byte>& bytes);
/// Replaces the state, and forgets what was received or kept back otherwise. `block` is that of the
/// federate's object handles, as the RTI knows it. False if the bytes are damaged: then the
/// ambassador can only be disconnected.
bool read_state(AmbassadorParts& parts, Bytes bytes, std::uint32_t block);

}  // namespace rink::rti
