// A thread that answers the local network's questions for matches at once, whatever the game does.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "game/net/discovery/match_announcer.h"

namespace rink::game {

class Announcing {
 public:
  /// `now_s` is real time [s], which never falls; the thread calls it.
  Announcing(const AnnouncedMatch& match, const rti::MulticastGroup& group,
             const std::function<double()>& now_s)
      : announcer_(match, group, now_s()), thread_([this, now_s] { attend(now_s); }) {}
  ~Announcing() {
    is_over_ = true;
    thread_.join();
  }
  Announcing(const Announcing&) = delete;
  Announcing& operator=(const Announcing&) = delete;

 private:
  void attend(const std::function<double()>& now_s) {
    while (!is_over_ && announcer_.is_open()) {
      announcer_.socket().wait(std::chrono::milliseconds(100));
      announcer_.attend(now_s());
    }
  }

  MatchAnnouncer announcer_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;  ///< the last, since it uses the others
};

}  // namespace rink::game
