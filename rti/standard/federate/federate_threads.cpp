// The threads that carry a federate's bytes and deliver its callbacks.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>

#include "rti/standard/federate/federate.h"

namespace rink::standard {

namespace {

using Clock = std::chrono::steady_clock;

/// Heartbeats are due every second, and bytes wake at once.
constexpr int longest_sleep_ms = 20;

double seconds_now() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

Clock::time_point instant(double seconds) {
  return Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
}

}  // namespace

void Federate::wake() {
  if (is_woken_) return;
  is_woken_ = true;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(alarm_.number(), &one, sizeof one);
}

void Federate::carry() {
  Lock lock(mutex_);
  while (!is_ending_) {
    is_woken_ = false;
    const bool is_live = connection_ && !connection_->is_finished();
    if (is_live) connection_->exchange();
    if (state_.deliveries.waiting_bytes() > rti::Ambassador::waiting_callbacks_max && is_live) {
      receiver_.connection_lost("too many callbacks wait for the federate");
      connection_.reset();
    }
    const bool is_behind = connection_ && is_live && connection_->is_behind();
    std::array<pollfd, 2> files{
        pollfd{alarm_.number(), POLLIN, 0},
        pollfd{is_live && connection_ ? connection_->wait_file() : -1, POLLIN, 0}};
    lock.unlock();
    changed_.notify_all();
    poll(files.data(), files.size(), is_behind ? 0 : longest_sleep_ms);
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t taken = read(alarm_.number(), &count, sizeof count);
    lock.lock();
  }
}

/// The immediate model. An exception of a callback has nowhere to go: it is printed.
void Federate::deliver() {
  Lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return is_ending_ || state_.deliveries.is_ready(); });
    if (is_ending_) return;
    try {
      state_.deliveries.deliver_one(lock);
    } catch (const rti1516e::Exception& exception) {
      std::wcerr << L"rti1516e: a callback threw: " << exception.what() << std::endl;
    } catch (const std::exception& exception) {
      std::wcerr << L"rti1516e: a callback threw: " << exception.what() << std::endl;
    }
  }
}

void Federate::check_outside_callback() {
  const Lock lock(mutex_);
  if (state_.deliveries.is_delivering_here())
    throw rti1516e::CallNotAllowedFromWithinCallback(L"call it once the callback has returned");
}

/// True if a callback is ready before `until` [s]. In the immediate model none is for this thread.
bool Federate::deliver_until(Lock& lock, double until) {
  const auto is_due = [&] { return !is_immediate_ && state_.deliveries.is_ready(); };
  if (!changed_.wait_until(lock, instant(until), is_due)) return false;
  try {
    state_.deliveries.deliver_one(lock);
  } catch (const rti1516e::Exception& exception) {
    throw rti1516e::RTIinternalError(L"a callback threw: " + exception.what());
  }
  return true;
}

bool Federate::evoke_one(double least_s) {
  check_outside_callback();
  Lock lock(mutex_);
  deliver_until(lock, seconds_now() + least_s);
  return !is_immediate_ && state_.deliveries.is_ready();
}

bool Federate::evoke_many(double least_s, double most_s) {
  check_outside_callback();
  Lock lock(mutex_);
  const double begin = seconds_now();
  while (deliver_until(lock, begin + least_s))
    if (seconds_now() >= begin + std::max(least_s, most_s)) break;
  return !is_immediate_ && state_.deliveries.is_ready();
}

void Federate::enable_callbacks(bool is_enabled) {
  {
    const Lock lock(mutex_);
    state_.deliveries.enable(is_enabled);
  }
  changed_.notify_all();
}

}  // namespace rink::standard
