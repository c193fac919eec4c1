// A queue between the threads of a window and of its peer: keys one way, pictures the other.
// Neither waits for the other.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/interest/peer_sight.h"

namespace rink::game {

/// A key that takes effect at `instant` [s, simulated], at which the window shows it already.
struct KeyInput {
  Key key = Key::left;
  bool is_down = false;
  double instant = 0.0;
};

/// The answer to question `number`: keys taken with it take effect at `felt_at` [s, simulated] at
/// the earliest.
struct InputAnswer {
  std::uint64_t number = 0;
  double felt_at = 0.0;
};

class InputQueue {
  template <class Do>
  auto locked(Do&& act) const {
    const std::lock_guard lock(mutex_);
    return act();
  }

 public:
  // The window's side.
  void press(const KeyInput& press) {
    locked([&] { presses_.push_back(press); });
  }
  /// Asks when a key that is pressed now takes effect.
  void ask(std::uint64_t number) {
    locked([&] { question_ = number; });
  }
  std::optional<InputAnswer> take_answer() {
    return locked([&] { return std::exchange(answer_, std::nullopt); });
  }
  /// The newest picture, unless it was taken before.
  std::optional<PeerSight> look() {
    return locked([&] { return std::exchange(sight_, std::nullopt); });
  }
  PeerStage stage() const {
    return locked([&] { return stage_; });
  }
  void leave() { wants_to_leave_ = true; }
  std::string take_words() {
    return locked([&] { return std::exchange(words_, {}); });
  }

  // The peer's side.
  std::vector<KeyInput> take_presses(double felt_at) {
    return locked([&] {
      if (question_) answer_ = InputAnswer{*question_, felt_at};
      question_.reset();
      return std::exchange(presses_, {});
    });
  }
  void show(PeerSight sight) {
    locked([&] { sight_ = std::move(sight); });
  }
  void set_stage(PeerStage::Step step, const std::string& words, double begins_in_s = 0.0) {
    locked([&] { stage_.step = step, stage_.words = words, stage_.begins_in_s = begins_in_s; });
  }
  void set_player(std::uint32_t player) {
    locked([&] { stage_.player = player; });
  }
  void notice(const std::string& what) {
    locked([&] { stage_.notice = what, ++stage_.notice_count; });
  }
  /// Adds text for the standard output.
  void print(const std::string& words) {
    locked([&] { words_ += words; });
  }
  bool wants_to_leave() const { return wants_to_leave_; }

 private:
  mutable std::mutex mutex_;
  std::vector<KeyInput> presses_;
  std::optional<std::uint64_t> question_;
  std::optional<InputAnswer> answer_;
  std::optional<PeerSight> sight_;
  PeerStage stage_;
  std::string words_;
  std::atomic<bool> wants_to_leave_ = false;
};

}  // namespace rink::game
