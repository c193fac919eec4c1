// The updates of one tick, encoded once for all their receivers.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/baselines/residual_states.h"
#include "rti/objects/bitmap.h"
#include "rti/objects/object_table.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// One update of one object by one federate.
struct ObjectUpdate {
  std::uint32_t owner = 0;  ///< the federate's slot
  ObjectSlot slot = no_object;
  const Object& object;  ///< the one in `slot`
  AttributeSet attributes;
  Stamp stamp;
  Bytes values;         ///< as they travel
  Residual residual{};  ///< if they may travel so, too
};

/// Updates of one owner, class, attribute set and stamp; at most one of each object.
struct UpdateRun {
  /// One object's values as they travel, in `message`.
  struct Record {
    std::uint32_t handle = 0, at = 0, size = 0;
    std::uint32_t residual_at = 0,  ///< in `residuals`
        residual_size = 0;          ///< bits; 0 if there is none
    std::uint32_t number = 0;       ///< of the update
    /// The residual by a companion, after the other: 0 bits if there is none.
    std::uint32_t companion_at = 0, companion_size = 0;
    std::uint32_t companion = 0;         ///< the number of its update
    std::uint32_t companion_handle = 0;  ///< the object
  };
  std::uint32_t owner = 0;
  std::uint16_t object_class = 0;
  AttributeSet attributes;
  Stamp stamp;
  std::vector<std::byte> message;  ///< the whole message as it is sent, but for the zero that
                                   ///< `seal` puts at its end
  std::vector<ObjectSlot> slots;   ///< of the records, in their order
  std::vector<Record> records;
  std::vector<std::byte> residuals;  ///< of the records, each from a byte on
  bool has_residuals = false;
  Bitmap members;                             ///< the same slots
  std::size_t first_word = 0, last_word = 0;  ///< of `members` that may hold any
  std::vector<std::uint32_t> record_of;  ///< by slot: index into `slots`; for members only, after
                                         ///< `seal` of runs longer than `short_run`
  static constexpr std::size_t short_run = 8;

  /// Asserts that slots, records and members name the same objects, once each.
  void check() const;
  Bytes values(std::size_t index) const {
    assert(index < records.size());
    return Bytes(message).subspan(records[index].at, records[index].size);
  }
};

/// Collects records in the order in which they came, in as few runs as that order allows. Keeps its
/// memory from tick to tick.
class UpdateRuns {
 public:
  void append(const ObjectUpdate& update);
  /// Completes the messages; no `append` may follow before `clear`.
  void seal();
  void clear();
  std::span<const UpdateRun> runs() const { return {runs_.data(), size_}; }

 private:
  UpdateRun& run_for(const ObjectUpdate& update);
  UpdateRun& begin(const ObjectUpdate& update);
  static void append_residual(const Residual& residual, UpdateRun& run, UpdateRun::Record& record);

  std::vector<UpdateRun> runs_;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> last_run_;  ///< by slot: 1 + the last run that has it, 0 if none
};

}  // namespace rink::rti
