// What changed in a peer's own part with the last commit, for whoever keeps a replica of it.
#pragma once

#include <cstdint>
#include <vector>

#include "game/peer/session/part_change.h"
#include "game/peer/window/share.h"
#include "game/peer/window/timed_keys.h"

namespace rink::peer {

/// Notes nothing before `begin`.
class PartChanges {
 public:
  void begin() { is_noting_ = true; }
  /// At a commit, before the journal is cleared: forgets earlier changes, and notes those of the
  /// window.
  void note_window(const Share& share);
  /// Then, and before the first window: notes own bodies that came, and those that left.
  void note(const Settlement& settled);
  /// What changed, or all if `is_whole`; its step is left out.
  PartChange change(const Share& share, const TimedKeys& keys, bool is_whole) const;

 private:
  bool is_noting_ = false;
  std::vector<std::uint32_t> changed_,
      left_;                                 ///< bodies that changed, or came; and those that went
  std::vector<std::uint32_t> free_flights_;  ///< bodies that free impacts alone changed
};

}  // namespace rink::peer
