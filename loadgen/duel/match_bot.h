// A bot that plays a hosted match as a person would: by what its own client shows, with the keys of
// one hand, or with a pointer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "game/net/client/network_match.h"
#include "game/players/player.h"
#include "loadgen/duel/pointer_hand.h"

namespace rink::loadgen {

/// The `most` pucks of `sight` that are nearest to `from` [m], the nearest first.
std::vector<game::SeenEntity> nearest_pucks(const game::MatchSight& sight,
                                            const game::Vector2& from, std::size_t most);

class MatchBot {
 public:
  /// The kind of a hand on a pointer.
  static constexpr const char* pointer = "pointer";

  /// `kind` is `pointer` or one of game::player_kinds().
  MatchBot(std::string kind, std::uint64_t seed)
      : kind_(std::move(kind)), seed_(seed), hand_(seed) {}

  /// Decides when a decision is due, and presses keys; call it before each frame of `match`, at
  /// real time `now_s`.
  void act(game::NetworkMatch& match, double now_s);

 private:
  void decide(game::NetworkMatch& match);

  std::string kind_;
  std::uint64_t seed_;
  std::unique_ptr<game::Player> player_;
  game::KeysHeld held_;
  double next_s_ = 0.0;
  PointerHand hand_;
};

}  // namespace rink::loadgen
