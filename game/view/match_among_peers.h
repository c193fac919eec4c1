// A match that peers share, in the window of one of them: a node of its own hosts it together with
// theirs, and the player joins that one.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "game/match/match_source.h"
#include "game/model/scene.h"
#include "game/net/client/joined_match.h"
#include "game/view/host_process.h"

namespace rink::view {

/// Whoever comes back to peers who play already joins the node of one of them, which tells where.
class MatchAmongPeers final : public game::MatchSource {
 public:
  /// `host` shares `scene`, in which a match can be played; the player is known by `name` there.
  /// Throws std::runtime_error if it cannot be started; a later failure shows as a match that is
  /// lost.
  MatchAmongPeers(const game::Scene& scene, const HostSettings& host, const std::string& name);

  void advance(double now_s) override;
  const game::MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return 1; }
  void press(std::uint32_t hand, game::Key key, bool is_down) override {
    if (match_) match_->press(hand, key, is_down);
  }
  std::string why_keys_alone() const override { return "A match among peers takes keys alone"; }
  void pause(bool is_wanted) override {
    if (match_) match_->pause(is_wanted);
  }
  void rematch() override {
    if (match_) match_->rematch();
  }

  /// Text for the terminal: what the node said.
  std::string take_words() { return std::exchange(words_, {}); }

 private:
  void hear(const std::string& line);
  void join(const std::string& place);
  void show();

  std::string name_, key_file_;
  HostProcess host_;
  std::unique_ptr<game::JoinedMatch> match_;
  game::MatchSight sight_;
  std::string words_, line_;      ///< for the terminal; and the beginning of the next line
  std::string waiting_, notice_;  ///< what to show before the match, and of losses in it
  double now_s_ = 0.0, notice_s_ = 0.0;
  bool is_elsewhere_ = false;  ///< it is played at another peer's node
};

}  // namespace rink::view
