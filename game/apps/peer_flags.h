// The flags of rink peer.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "game/apps/flags.h"
#include "game/net/peer/interest/viewing_options.h"
#include "game/net/peer/network/greetings.h"

namespace rink::game {

struct PeerOptions {
  std::string scene, keys, listen, join, record, report, pace = "free", transport = "tcp";
  std::vector<std::string> players{"chaser"};
  std::uint64_t seed = 0;
  std::uint32_t bats = 0, bat_count = 0, puck_count = 0, bots = 0;
  std::set<std::string> given{};  ///< the flags that were given
  double patience_s = 30.0;
  Terms terms{
      .peer_count = 2, .until = 10.0, .window = 0.02, .balance_windows = balance_windows_default};
  ViewingOptions viewing;
};

void add_options(Flags& flags, PeerOptions& options);

}  // namespace rink::game
