// A thread that does half of a match, for `im` where a second core is free.
#pragma once

#include <cassert>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "im/worker.h"

namespace rink::rti {

/// One thread, from construction to destruction; between tasks it sleeps.
class SecondCore final : public im::Worker {
 public:
  SecondCore() : thread_([this] { run(); }) {}
  ~SecondCore() override {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void start(void (*task)(void* context), void* context) override {
    {
      const std::lock_guard lock(mutex_);
      assert(task != nullptr && task_ == nullptr);  // one at a time
      task_ = task, context_ = context;
      ++task_count_;
    }
    changed_.notify_all();
  }
  void wait() override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return task_ == nullptr; });
  }
  /// Tasks given to the thread so far.
  std::uint64_t task_count() const { return task_count_; }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_over_ || task_ != nullptr; });
      if (task_ == nullptr) return;
      lock.unlock();
      task_(context_);
      lock.lock();
      task_ = nullptr;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  void (*task_)(void*) = nullptr;
  void* context_ = nullptr;
  std::uint64_t task_count_ = 0;
  bool is_over_ = false;
  std::thread thread_;  // last, for it uses the rest
};

}  // namespace rink::rti
