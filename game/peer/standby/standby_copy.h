// A copy of a peer's part that another can continue from: a snapshot, and a log of all that came to
// the part since.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "game/peer/standby/part_record.h"
#include "game/peer/standby/part_replay.h"

namespace rink::peer {

/// Of the last two steps at least, since peers are never further apart. A peer has one of its own
/// part, too.
class StandbyCopy {
 public:
  bool is_empty() const { return !base_ && !next_ && records_.empty(); }
  /// What all know of the start.
  void begin(PartSnapshot start);
  /// The next step's record; or one of any step, if a whole snapshot comes with it. False, with
  /// nothing changed, if it is neither.
  bool add(PartRecord record);
  /// A whole snapshot of the last step.
  void add(PartSnapshot snapshot);
  /// The next piece of one, of the last step or a piece of which came with the step before. The
  /// reason why it cannot be; empty if it can.
  std::string add(SnapshotPiece piece, const Validator& scene);

  /// True if the part at the last step, which is this one, can be played.
  bool is_at(std::uint64_t step) const;
  /// Returns to one of the last two steps, which is then the last. False if it is neither.
  bool rewind(std::uint64_t step);
  /// Plays up to the last step, at which it must be: what of it is own, where the zones of `peer`
  /// are those of `division`.
  Part part(const physics::WorldSpec& spec, const Validator& scene, const Division& division,
            PeerNumber peer) const;
  /// The keys of live players that took effect on the part's bats since the start.
  std::vector<Key> log() const;
  /// Of these, those that did so in the last step.
  const std::vector<Key>& last_keys() const;
  /// How many bytes of snapshots it holds, and how much work a replay is (PartRecord).
  std::size_t snapshot_size() const;
  std::uint64_t replay_work() const;

  /// Asserts that steps follow each other.
  void check() const;

 private:
  /// A snapshot and its step.
  struct Mark {
    std::uint64_t step = 0;
    double time = 0.0;  ///< s
    PartSnapshot part{};
    std::vector<Key> keys{};  ///< that took effect in that step, once it is the base
  };
  struct Coming {
    std::uint64_t step = 0, total = 0;
    double time = 0.0;  ///< s
    std::vector<std::uint8_t> bytes{};
  };

  std::optional<std::uint64_t> last_step() const;
  const Mark& newest() const { return next_ ? *next_ : *base_; }
  void move_on();

  std::optional<Mark> base_, next_;  ///< the next becomes the base one step later
  std::optional<Coming> coming_;
  std::deque<PartRecord> records_;  ///< of the steps after the base
  std::vector<Key> log_;            ///< up to the base
};

}  // namespace rink::peer
