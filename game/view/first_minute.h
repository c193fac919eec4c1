// What a player is told in the first minute: how to play, and keys until they were used once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "game/view/match_source.h"
#include "game/view/render/picture.h"
#include "game/view/settings.h"

namespace rink::view {

class FirstMinute {
 public:
  static constexpr double rules_s = 6.0;  ///< the rules stay for so long once the match runs

  /// The player used what `hint` is about. True if it was new, so that settings are to be kept.
  static bool use(Hint hint, Settings& settings);

  /// Takes up a sight of a person's match at `now_s` [s]. True if the rules were shown long enough.
  bool look(const MatchSight& sight, double now_s, Settings& settings);
  /// The rules in three lines before a first match, then the keys that were not used yet.
  void add_to(const MatchSight& sight, const Settings& settings, bool is_alone,
              Picture& words) const;

 private:
  std::optional<double> playing_since_s_;
};

/// All keys of the window, as pairs of what to press and what it does.
std::vector<std::pair<std::string, std::string>> all_keys(const Settings& settings);

/// Who won how many of up to three matches between the same two.
class Series {
 public:
  static constexpr std::uint32_t wins_needed = 2;

  /// Takes up a sight: a match that ends is counted once, and one that follows the last begins
  /// anew.
  void look(const MatchSight& sight);
  std::uint32_t wins(game::Team team) const { return team == game::Team::left ? left_ : right_; }
  std::optional<game::Team> winner() const;
  /// The standing, below the headline, between the matches.
  void add_to(const MatchSight& sight, const Palette& palette, Picture& words) const;

 private:
  std::uint32_t left_ = 0, right_ = 0;
  Phase phase_ = Phase::waiting;
};

}  // namespace rink::view
