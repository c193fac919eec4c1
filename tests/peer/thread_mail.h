// Mail between peers in threads of one process.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::peer::test {

/// What goes from one thread to another, one way.
class Post {
 public:
  void put(std::vector<std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(bytes));
    has_come_.notify_one();
  }
  bool is_empty() {
    const std::lock_guard lock(mutex_);
    return waiting_.empty();
  }
  std::vector<std::uint8_t> take() {
    std::unique_lock lock(mutex_);
    has_come_.wait(lock, [&] { return !waiting_.empty(); });
    std::vector<std::uint8_t> first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
  }

 private:
  std::mutex mutex_;
  std::condition_variable has_come_;
  std::deque<std::vector<std::uint8_t>> waiting_;
};

/// From everybody to everybody.
class PostOffice {
 public:
  explicit PostOffice(PeerNumber peer_count)
      : peer_count_(peer_count), posts_(peer_count * peer_count) {}
  Post& between(PeerNumber from, PeerNumber to) { return posts_[from * peer_count_ + to]; }

 private:
  PeerNumber peer_count_;
  std::deque<Post> posts_;
};

class ThreadMail final : public Mail {
 public:
  ThreadMail(PostOffice& office, PeerNumber number) : office_(office), number_(number) {}
  void send(PeerNumber to, std::vector<std::uint8_t> bytes) override {
    office_.between(number_, to).put(std::move(bytes));
  }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    return office_.between(from, number_).take();
  }

 private:
  PostOffice& office_;
  PeerNumber number_;
};

}  // namespace rink::peer::test
