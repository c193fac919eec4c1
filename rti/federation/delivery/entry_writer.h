// Writes the states that are due in full.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "rti/baselines/residual_states.h"
#include "rti/federation/delivery/announcements.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/delivery/residual_writer.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/wire/entry_block.h"
#include "rti/wire/updates_block.h"

namespace rink::rti {

/// The state of an object that comes into scope is one record with the news that it does.
class EntryWriter {
 public:
  struct Uses {
    Announcements& announcements;
    ResidualWriter& residuals;
    const ResidualStates& states;
    const NewestStamps& newest;
  };
  EntryWriter(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  /// Fills the frame up to `end` bytes, the gathered entries included. A state has the newest stamp
  /// of its owner, not that of its own latest update: it holds until then.
  void write(FlushContext& context, std::size_t end);

 private:
  /// At most one is open.
  struct Blocks {
    std::optional<UpdatesBlock> updates;
    EntriesBlock entries;
    void close() {
      updates.reset();
      entries.close();
    }
  };
  struct Due {
    ObjectSlot slot = no_object;
    AttributeSet in_scope{};    ///< all that it has
    AttributeSet attributes{};  ///< of these, without static ones that the federate was sent before
    bool is_held = false;       ///< the federate was sent all of the values before
  };
  Due state_due(FederateInterest& interest, ObjectSlot slot);
  void write_state(FlushContext& context, Due due, Blocks& blocks);
  AttributeSet fitting(ObjectSlot object, AttributeSet set) const;
  void write_update(FlushContext& context, const Due& due, Blocks& blocks);
  void write_entry(FlushContext& context, const Due& due, Blocks& blocks);
  /// Those whose values are the ones of the class's last entry.
  AttributeSet repeated(const EntryValues& last, ObjectSlot object, AttributeSet set) const;
  /// Static ones whose values an entry of the class brought before.
  AttributeSet recalled(const EntryValues& last, ObjectSlot object, AttributeSet set) const;

  FederationBasis basis_;
  Uses uses_;
};

}  // namespace rink::rti
