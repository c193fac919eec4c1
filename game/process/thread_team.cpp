// One lock, taken when a task begins and when a thread has ended it.
#include "game/process/thread_team.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <system_error>

namespace rink::game {

ThreadTeam::ThreadTeam(std::uint32_t count) {
  assert(count > 0);
  try {
    for (std::uint32_t worker = 1; worker < count; ++worker)
      threads_.emplace_back([this, worker] { work(worker); });
  } catch (const std::system_error& error) {
    end();
    throw std::runtime_error(std::to_string(count) + " threads cannot be started: " + error.what());
  }
}

ThreadTeam::~ThreadTeam() { end(); }

void ThreadTeam::end() {
  {
    const std::lock_guard lock(mutex_);
    assert(busy_count_ == 0);
    is_over_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run(void (*task)(void* context, std::uint32_t worker), void* context) {
  assert(task != nullptr);
  if (threads_.empty()) return task(context, 0);
  {
    const std::lock_guard lock(mutex_);
    assert(busy_count_ == 0);  // one task at a time
    task_ = task, context_ = context;
    busy_count_ = static_cast<std::uint32_t>(threads_.size());
    ++task_count_;
  }
  begun_.notify_all();
  task(context, 0);
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return busy_count_ == 0; });
}

void ThreadTeam::work(std::uint32_t worker) {
  std::unique_lock lock(mutex_);
  for (std::uint64_t seen = 0;;) {
    begun_.wait(lock, [&] { return is_over_ || task_count_ != seen; });
    if (is_over_) return;
    seen = task_count_;
    lock.unlock();
    task_(context_, worker);
    lock.lock();
    if (--busy_count_ == 0) ended_.notify_one();
  }
}

std::optional<std::string> objection_to_threads(std::uint32_t count, std::size_t body_count) {
  if (count <= std::max<std::size_t>(1, body_count)) return std::nullopt;
  return std::to_string(count) + " threads for " + std::to_string(body_count) +
         " bodies: expected at most as many threads as bodies";
}

}  // namespace rink::game
