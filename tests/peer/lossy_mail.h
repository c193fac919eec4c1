// Mail between peers in threads that die in the middle of a word, or are cut off from each other.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::peer::test {

/// What ends a thread that is killed.
struct Killed {};

class LossyOffice {
 public:
  explicit LossyOffice(PeerNumber peer_count) : peer_count_(peer_count), lines_(peer_count * peer_count), is_dead_(peer_count), has_finished_(peer_count) {}

  void kill(PeerNumber peer) {
    const std::lock_guard lock(mutex_);
    is_dead_[peer] = true;
    has_come_.notify_all();
  }
  /// No word goes any more between those for whom `is_one` is true and the others.
  void cut_off(const std::function<bool(PeerNumber)>& is_one) {
    const std::lock_guard lock(mutex_);
    for (PeerNumber a = 0; a < peer_count_; ++a)
      for (PeerNumber b = 0; b < peer_count_; ++b)
        if (is_one(a) != is_one(b)) line(a, b).is_cut = true;
    has_come_.notify_all();
  }
  void finish(PeerNumber peer) {
    const std::lock_guard lock(mutex_);
    has_finished_[peer] = true;
    has_come_.notify_all();
  }
  void part(PeerNumber number, PeerNumber peer, bool is_lost) {
    const std::lock_guard lock(mutex_);
    line(peer, number).is_parted = true;
    if (is_lost) line(number, peer).is_cut = true;
    has_come_.notify_all();
  }
  void send(PeerNumber from, PeerNumber to, std::vector<std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    if (!line(from, to).is_cut) line(from, to).waiting.push_back(std::move(bytes));
    has_come_.notify_all();
  }
  std::vector<std::uint8_t> receive(PeerNumber number, PeerNumber from) {
    std::unique_lock lock(mutex_);
    for (;;) {
      Line& mail = line(from, number);
      for (PeerNumber peer = 0; peer < peer_count_; ++peer)
        if (peer != number && !line(peer, number).is_parted && (is_dead_[peer] || line(peer, number).is_cut)) throw PeerGone(peer, false, "peer " + std::to_string(peer) + " is gone");
      if (!mail.waiting.empty()) {
        std::vector<std::uint8_t> bytes = std::move(mail.waiting.front());
        mail.waiting.pop_front();
        return bytes;
      }
      if (has_finished_[from]) throw PeerGone(from, true, "peer " + std::to_string(from) + " has left");
      has_come_.wait(lock);
    }
  }

 private:
  struct Line {
    std::deque<std::vector<std::uint8_t>> waiting;
    bool is_cut = false, is_parted = false;
  };
  Line& line(PeerNumber from, PeerNumber to) { return lines_[from * peer_count_ + to]; }

  PeerNumber peer_count_;
  std::vector<Line> lines_;
  std::vector<bool> is_dead_, has_finished_;
  std::mutex mutex_;
  std::condition_variable has_come_;
};

class LossyMail final : public Mail {
 public:
  /// With every word that is said or awaited, `before_word` is called with its number; it may throw.
  LossyMail(LossyOffice& office, PeerNumber number, std::function<void(std::uint64_t)> before_word) : office_(office), number_(number), before_word_(std::move(before_word)) {}
  void send(PeerNumber to, std::vector<std::uint8_t> bytes) override {
    before_word_(++words_);
    office_.send(number_, to, std::move(bytes));
  }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    before_word_(++words_);
    return office_.receive(number_, from);
  }
  void part(PeerNumber peer, bool is_lost) override { office_.part(number_, peer, is_lost); }

 private:
  LossyOffice& office_;
  PeerNumber number_;
  std::function<void(std::uint64_t)> before_word_;
  std::uint64_t words_ = 0;
};

}  // namespace rink::peer::test
