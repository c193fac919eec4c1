// What comes to a peer's own part from outside, step by step, for whoever keeps a copy of it:
// played again, it gives the same part.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/standby/part_record.h"
#include "game/peer/validation.h"
#include "game/peer/window/share.h"
#include "game/peer/window/timed_keys.h"

namespace rink::peer {

/// Notes nothing before `begin`.
class PartLog {
 public:
  /// Both must outlive it. It alone takes the touched bodies of `share`.
  PartLog(Share& share, const TimedKeys& keys) : share_(share), keys_(keys) {}

  /// Between windows: notes all from here on. `scene` must outlive it.
  void begin(const Validator& scene);
  /// Before a window is repeated, when more ghosts are there.
  void note_repeat();
  /// At a commit, before anything changes: the keys of the run, which had so many events.
  void note_window(std::uint64_t events);
  /// After the commit, and after pucks were put back: all since the last record. Its step and time
  /// are left out.
  PartRecord record();
  /// Between windows: all that is there.
  PartSnapshot snapshot() const;

 private:
  bool holds_any(std::span<const std::uint32_t> bodies) const;
  std::vector<std::uint8_t> packed(std::span<const std::uint32_t> bodies) const;
  std::vector<Key> pending() const;

  Share& share_;
  const TimedKeys& keys_;
  const Validator* scene_ = nullptr;
  PartRecord next_;
  std::vector<std::uint32_t> repeated_;  ///< bodies that came before a repeat of the window
  std::vector<RestContact> contacts_;    ///< when the window began, or at the end of its run
};

}  // namespace rink::peer
