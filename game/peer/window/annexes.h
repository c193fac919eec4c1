// Where a peer looks beyond its halo, because what is pressed there hangs together with own bodies:
// docs/peer-to-peer.md, "Annexes".
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/peer/box.h"
#include "game/peer/messages.h"
#include "game/peer/window/claim_check.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/share.h"
#include "game/peer/window/window.h"
#include "game/peer/window/window_verdicts.h"

namespace rink::peer {

/// A wider halo would show a cluster that reaches far beyond it as well, but with it all else that
/// is around the own zones, for thousands of windows.
class Annexes {
 public:
  static constexpr std::size_t count_max = 8;

  /// All must outlive it.
  Annexes(const Share& share, const Halos& halos, const ClaimCheck& check)
      : share_(share), halos_(halos), check_(check) {}

  /// Adds them to the own verdict, which `accepts` the run or not. Answers whether they show why it
  /// is to be repeated.
  bool announce(bool accepts, const Window& window, const WindowVerdicts& verdicts, Verdict& own);

 private:
  struct Need {
    Box box;
    std::uint32_t window;  ///< at whose end
  };

  std::vector<Box> to_repeat(const Window& window, std::uint32_t attempts);
  std::vector<Box> to_go_on(const Window& window, double halo);
  void find_deciding();
  bool is_pressed(std::uint32_t ghost, const Window& window) const;
  Box place_of(std::uint32_t ghost) const;

  const Share& share_;
  const Halos& halos_;
  const ClaimCheck& check_;
  std::vector<Need> needs_;
  std::vector<std::uint8_t> is_deciding_;  ///< by body
  std::vector<std::uint32_t> deciding_;    ///< ghosts
  bool has_found_ = false;                 ///< in the last run, what is pressed beyond the halo
};

}  // namespace rink::peer
