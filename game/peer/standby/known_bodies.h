// Leaves out of a record the states that its keeper has itself, and puts them back.
#pragma once

#include <string>

#include "game/peer/division.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/validation.h"
#include "game/peer/window/share.h"

namespace rink::peer {

/// At the sender, whose part is `share`, after a commit: of bodies that `keeper` has, too, the
/// numbers are enough, for both have them bit for bit alike, or one of the two has lied.
void leave_out_known(PartRecord& record, PeerNumber keeper, const Share& share,
                     const Validator& scene);

/// At the keeper, whose own part is `share`, in the window that begins with the record's step: puts
/// the states of these bodies back. The reason why that cannot be, as in "says that body 7 is here,
/// which is not"; empty if it can.
std::string put_back_known(PartRecord& record, const Share& share, const Validator& scene);

}  // namespace rink::peer
