// The RTI's state of a federation as one stretch of bytes.
#pragma once

#include <vector>

#include "rti/save/saved_federation.h"
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
/// True if `federates` are those that have joined, in the order of their slots.
bool are_those_of(const FederationParts& parts, const std::vector<SavedFederate>& federates);

}  // namespace rink::rti
