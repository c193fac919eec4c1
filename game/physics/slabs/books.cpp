// Enters what waits in the order of its events.
#include "game/physics/slabs/books.h"

namespace rink::physics::inline RINK_PRECISION {

void Books::enter() {
  for (const BookEntry& entry : entries_.sort()) ledger_.spend(entry.transfer);
}

}  // namespace rink::physics::inline RINK_PRECISION
