// A federation in which some federates speak by rule and others say whatever a fuzzer makes up.
#pragma once

#include "rti/wire/bytes.h"

namespace rink::fuzz {

/// Bytes are turns: whose, what (a frame, bare bytes, a join, leaving, time, a tick), and its
/// content. Whatever strangers say, the witness hears only what is in order, and once they are
/// gone, nothing of theirs is left.
void drive_federation(rti::Bytes input);
/// Frames without messages, oversized ones and messages that do not exist or break off, of
/// strangers in any state: each loses its connection at once.
void refuse_federation(rti::Bytes input);

/// Bytes are frames from the RTI to a federate that joins, declares and registers between them. It
/// believes them or loses its connection, and never tells its federate of what cannot be: an update
/// of an object that is not known, a discovery of one that is.
void drive_federate(rti::Bytes input);
/// What the RTI cannot have sent ends the federate's connection, and the federate says why.
void refuse_federate(rti::Bytes input);

/// Bytes are what happens to datagrams of best-effort updates and their acknowledgements: lost,
/// doubled, late, changed, made up. Nobody loses a connection by them, and a federate is told of
/// nothing that cannot be.
void drive_datagrams(rti::Bytes input);
/// A datagram that breaks off or makes no sense is ignored and counted.
void refuse_datagrams(rti::Bytes input);

}  // namespace rink::fuzz
