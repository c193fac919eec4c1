// The RTI's state of a federation as one stretch of bytes.
#pragma once

#include <vector>

#include "rti/wire/bytes.h"

namespace rink::rti {

class FederationParts;

/// Appends the state: federates, declarations, objects with values and owners, regions, names,
/// logical times, queued messages, switches, and what waits to be sent. False if a part was
/// replaced by the user whose state only the user knows.
bool write_state(FederationParts& parts, std::vector<std::byte>& bytes);
/// `parts` must be new, and the model that of the state. Connections are those of nobody yet. False
/// if the bytes are damaged: then `parts` is fit for nothing but its destruction.
bool read_state(FederationParts& parts, Bytes bytes);

}  // namespace rink::rti
