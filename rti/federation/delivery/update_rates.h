// Federates that are not updated at every match: whose turn it is, what they have not been sent
// yet, and which updates they receive at once.
#pragma once

#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "rti/buffering/pending_changes.h"
#include "rti/objects/object_table.h"
#include "rti/types.h"
#include "rti/update_rate.h"

namespace rink::rti {

/// Federates of one rate are spread evenly over groups of different phases; those of a group
/// receive the same updates, encoded once. What changed is kept once for all groups.
class UpdateRates {
 public:
  /// Phases of one rate, at most: each encodes what changed since its last turn.
  static constexpr std::uint32_t phase_max = 16;
  static constexpr std::uint32_t every_match = 0xffffffffu;  ///< in place of a group

  struct Group {
    UpdateRate rate;
    std::uint32_t progress = 0;  ///< matches times `rate.turns` since the last turn, and its phase
    std::uint32_t federates = 0;
    std::uint64_t turns = 0;      ///< that it has had
    std::uint64_t keyframes = 0;  ///< flushes with periodic state (rti/baselines)
    bool is_due = false;
    std::uint64_t position = 0;  ///< flush of `PendingChanges` up to which it has received all
  };
  /// An update in the runs of a flush that a federate receives whether or not it is its turn.
  struct Prompt {
    std::uint32_t federate = 0;
    std::size_t run = 0, record = 0;
    friend auto operator<=>(const Prompt&, const Prompt&) = default;
  };

  /// A federate in a free slot, which is updated at every match.
  void joined(std::uint32_t federate);
  void left(std::uint32_t federate);
  /// Moves the federate to the group of this rate with the fewest others. What
  /// it missed before it must be sent otherwise.
  void set_rate(std::uint32_t federate, UpdateRate rate);
  /// Adds the objects that were updated since the federate's last turn to `objects`.
  void list_missed(std::uint32_t federate, Bitmap& objects) const;
  /// The federate receives updates of the object with any of `attributes` at once; one object each,
  /// which a further call replaces.
  void send_at_once(std::uint32_t federate, ObjectSlot slot, ObjectHandle object,
                    AttributeSet attributes);

  /// Federates that are not updated at every match.
  std::uint32_t limited_count() const { return limited_; }
  /// Number of the federate's group, or `every_match`.
  std::uint32_t group_of(std::uint32_t federate) const {
    assert(federate < federates_.size());
    return federates_[federate].group;
  }
  std::deque<Group>& groups() { return groups_; }

  void begin_match();
  /// Adds a flush's updates to what groups have to be sent.
  void add(std::span<const UpdateRun> runs);
  /// What the group has to be sent; valid until the next call.
  std::span<const UpdateRun> due_runs(std::uint32_t group, const ObjectTable& objects);
  /// The updates of the flush at hand that federates between two turns receive, by federate.
  std::span<const Prompt> prompts() const { return prompts_; }
  /// The federate was sent `attributes` of its object under `stamp` before its turn.
  void note_prompt(std::uint32_t federate, AttributeSet attributes, const Stamp& stamp);
  /// The object whose record in `run` was sent to the federate before its turn; else `no_object`.
  ObjectSlot sent_before(std::uint32_t federate, const UpdateRun& run) const;
  /// The federate has had its turn.
  void note_turn(std::uint32_t federate) { federates_[federate].sent.clear(); }
  /// All of the groups that were due have.
  void end_turns();

 private:
  struct Sent {
    AttributeSet attributes;
    double time = 0.0;  ///< of the stamp
  };
  struct Federate {
    std::uint32_t group = every_match;
    ObjectSlot object = no_object;  ///< of which it is sent updates at once
    AttributeSet attributes;
    std::vector<Sent> sent;  ///< of the object since the last turn
  };
  void add_groups(UpdateRate rate);
  void forget_received();
  void list_prompts(std::span<const UpdateRun> runs);

  std::vector<Federate> federates_;  ///< by slot
  std::deque<Group> groups_;
  PendingChanges pending_;  ///< of all groups with federates
  struct Watcher {
    std::uint32_t federate = no_federate;
    ObjectHandle object;  ///< since a slot may have another one later
  };
  std::vector<Watcher> watchers_;  ///< by object slot: who is sent its updates at once
  AttributeSet watched_;           ///< attributes of any object that somebody is sent at once
  std::vector<Prompt> prompts_;
  std::uint32_t limited_ = 0;  ///< federates in groups
};

}  // namespace rink::rti
