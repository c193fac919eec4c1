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

/// All such federates share one list. Each remembers the last flush whose changes it has received,
/// so the cost of a flush does not grow with the number of phases.
/// Of each attribute that was updated more than once, only the newest update stays, under its own
/// stamp. Values are read from the object table when they are sent. Keeps its memory.
class PendingChanges {
 public:
  /// Adds the updates of one flush, which come after all that were added before.
  void add(std::span<const UpdateRun> runs);
  /// Number of the last flush that was added; 0 before the first.
  std::uint64_t flush_number() const { return flush_number_; }
  /// Whatever was added after the flush `since`, oldest stamps first; values as `objects` has them
  /// now. Valid until the next call.
  std::span<const UpdateRun> seal(const ObjectTable& objects, std::uint64_t since);
  /// Adds the objects of the same changes to `objects`.
  void list_objects(std::uint64_t since, Bitmap& objects) const;
  /// Forgets what was last updated by the flush `until` or before it: all federates have it.
  void forget(std::uint64_t until);

 private:
  /// Objects of which these attributes have their newest update under `stamp`.
  struct Change {
    std::uint64_t flush = 0;  ///< that brought it
    std::uint32_t owner = 0;  ///< the slot of the federate that updated them
    AttributeSet attributes;
    Stamp stamp;
    Bitmap objects;
    std::size_t first_word = 0, end_word = 0;  ///< of `objects` that may hold any
  };
  Change& place_of(const Change& like);
  void supersede(const UpdateRun& run);
  template <class IsKept>
  void keep_if(IsKept is_kept);

  std::vector<Change> changes_;  ///< the first `size_` are in use
  std::size_t size_ = 0;
  std::uint64_t flush_number_ = 0;
  std::vector<std::size_t> order_;
  UpdateRuns runs_;
  std::vector<std::byte> values_;  ///< of one record
};

}  // namespace rink::rti
