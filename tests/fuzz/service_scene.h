// Groups of services between strangers who have joined and a witness: time management, ownership,
// regions, and periodic state by baselines.
#pragma once

#include "rti/wire/bytes.h"

namespace rink::fuzz {

/// The functions called `refuse_...` play the same game and then send what is malformed: messages
/// of the group that break off, and frames without a message. Whoever sends one is dropped.
///
/// Bytes are turns: who, which message of the group, and what is in it, mostly as numbers that make
/// sense; some are raw. Strangers who break a rule are dropped and come again. The witness takes
/// part by the ambassador's services, understands all that it hears, and is never dropped.

/// Its time never goes back, and nothing comes to it in order that is older than its time.
void drive_time(rti::Bytes input);
void refuse_time(rti::Bytes input);
/// What it owns it loses by its own word only.
void drive_ownership(rti::Bytes input);
void refuse_ownership(rti::Bytes input);
/// It hears of every object that is in its scope, once.
void drive_regions(rti::Bytes input);
void refuse_regions(rti::Bytes input);
/// Acknowledgements are lost, late, doubled or made up: what a federate hears is always the
/// quantised value that was said. Frames that were changed on their way cost one federate its
/// connection at most.
void drive_baselines(rti::Bytes input);
void refuse_baselines(rti::Bytes input);

}  // namespace rink::fuzz
