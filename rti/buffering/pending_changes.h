// What changed since some federates were last updated, by object and attribute: for federates that
// are not updated at every match.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/buffering/update_runs.h"
#include "rti/objects/bitmap.h"
#include "rti/objects/object_table.h"

namespace rink::rti {

/// Of each attribute that was updated more than once, only the newest update stays, under its own
/// stamp. Values are read from the object table when they are sent. Keeps its memory.
class PendingChanges {
 public:
  /// Adds the updates of one flush, which come after all that were added before.
  void add(std::span<const UpdateRun> runs);
  /// Whatever was added since `clear`, oldest stamps first; values as `objects` has them now. Valid
  /// until `clear`.
  std::span<const UpdateRun> seal(const ObjectTable& objects);
  void clear();

 private:
  /// Objects of which these attributes have their newest update under `stamp`.
  struct Change {
    std::uint32_t owner = 0;  ///< the slot of the federate that updated them
    AttributeSet attributes;
    Stamp stamp;
    Bitmap objects;
  };
  std::size_t place_of(std::uint32_t owner, AttributeSet attributes, const Stamp& stamp);
  void supersede(const UpdateRun& run);

  std::vector<Change> changes_;  ///< the first `size_` are in use
  std::size_t size_ = 0;
  std::vector<std::size_t> order_;
  UpdateRuns runs_;
  std::vector<std::byte> values_;  ///< of one record
};

}  // namespace rink::rti
