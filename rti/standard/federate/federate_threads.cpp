// The threads that carry a federate's bytes and deliver its callbacks.
#include <poll.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "rti/standard/federate/federate.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

using Clock = std::chrono::steady_clock;

/// Heartbeats are due every second, and bytes wake at once.
constexpr std::chrono::nanoseconds longest_sleep = std::chrono::milliseconds(20), no_time{0};

double seconds_now() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// Infinity and NaN are no instants of a clock.
double patience(double seconds) {
  constexpr double a_year = 3.2e7;
  return seconds > 0.0 ? std::min(seconds, a_year) : 0.0;
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

void Federate::start_threads() {
  carrier_ = std::thread([self = shared_from_this()] { self->carry(); });
  if (is_immediate_) deliverer_ = std::thread([self = shared_from_this()] { self->deliver(); });
}

/// Ends the connection, and what any thread waits for. From within a callback, the thread that
/// delivers it ends once the callback has returned.
void Federate::end_threads(Lock& lock) {
  const bool is_here = state_.deliveries.is_delivering_here();
  is_ending_ = true;
  state_.deliveries.interrupt();
  is_woken_ = false;
  wake();
  changed_.notify_all();
  std::thread carrier = std::move(carrier_), deliverer = std::move(deliverer_);
  lock.unlock();
  if (carrier.joinable()) carrier.join();
  if (deliverer.get_id() == std::this_thread::get_id()) deliverer.detach();
  if (deliverer.joinable()) deliverer.join();
  lock.lock();
  changed_.wait(lock, [&] {
    return !is_managing_ && !is_asking_ && (is_here || !state_.deliveries.is_delivering());
  });
  drop_connection();
  is_connected_ = is_joined_ = false;
  is_ending_ = is_here;
}

void Federate::carry() {
  prctl(PR_SET_TIMERSLACK, 1000);  // else waits of 100 us take 150
  Lock lock(mutex_);
  while (!is_ending_) {
    is_woken_ = false;
    std::chrono::nanoseconds wait =
        sending_.is_due ? sending_.at + send_gap - Clock::now() : no_time;
    if (wait <= no_time) {
      if (std::exchange(sending_.is_due, false)) sending_.at = Clock::now();
      if (connection_ && !connection_->is_finished())
        if (const auto fault = fault_of([&] { exchange(); })) lose(*fault);
      wait = longest_sleep;
    }
    const bool is_live = connection_ && !connection_->is_finished();
    if (is_live && connection_->is_behind()) {
      wait = no_time;
      sending_.is_due = false;
    }
    std::array<pollfd, 2> files{pollfd{alarm_.number(), POLLIN, 0},
                                pollfd{is_live ? connection_->wait_file() : -1, POLLIN, 0}};
    lock.unlock();
    changed_.notify_all();
    const timespec patience{0, static_cast<long>(wait.count())};
    if (ppoll(files.data(), files.size(), &patience, nullptr) > 0 && files[0].revents != 0) {
      std::uint64_t count = 0;
      [[maybe_unused]] const ssize_t taken = read(alarm_.number(), &count, sizeof count);
    }
    lock.lock();
    // Bytes have come: they are read, and what waits is sent with the answers to them.
    if (files[1].revents != 0) sending_.is_due = false;
  }
}

void Federate::exchange() {
  connection_->exchange();
  if (state_.deliveries.waiting_bytes() > rti::Ambassador::waiting_callbacks_max)
    throw std::runtime_error("too many callbacks wait for the federate");
}

void Federate::lose(const std::string& why) {
  if (!state_.lost_because) receiver_.connection_lost(why);
  drop_connection();
}

/// The immediate model. An exception of a callback has nowhere to go: it is printed.
void Federate::deliver() {
  Lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return is_ending_ || state_.deliveries.is_ready(); });
    if (is_ending_) return;
    if (const auto fault = fault_of([&] { state_.deliveries.deliver(lock, [] { return false; }); }))
      std::wcerr << L"rti1516e: a callback threw: " << to_wide(*fault) << std::endl;
    if (is_ending_) return;
    changed_.notify_all();
  }
}

void Federate::check_outside_callback() {
  const Lock lock(mutex_);
  if (!is_connected_) throw rti1516e::NotConnected(L"connect first");
  if (state_.deliveries.is_delivering_here())
    throw rti1516e::CallNotAllowedFromWithinCallback(L"call it once the callback has returned");
}

/// True if a callback is ready before `until` [s]. In the immediate model none is for this thread.
template <class Enough>
bool Federate::deliver_until(Lock& lock, double until, const Enough& is_enough) {
  const auto is_due = [&] { return !is_immediate_ && state_.deliveries.is_ready(); };
  if (!changed_.wait_until(lock, instant(until), [&] { return is_ending_ || is_due(); }))
    return false;
  if (is_ending_) return false;
  const auto fault = fault_of([&] { state_.deliveries.deliver(lock, is_enough); });
  changed_.notify_all();
  if (fault) throw rti1516e::RTIinternalError(L"a callback threw: " + to_wide(*fault));
  return true;
}

bool Federate::evoke_one(double least_s) {
  const std::shared_ptr<Federate> self = shared_from_this();
  check_outside_callback();
  Lock lock(mutex_);
  deliver_until(lock, seconds_now() + patience(least_s), [] { return true; });
  return !is_immediate_ && state_.deliveries.is_ready();
}

bool Federate::evoke_many(double least_s, double most_s) {
  const std::shared_ptr<Federate> self = shared_from_this();
  check_outside_callback();
  Lock lock(mutex_);
  const double begin = seconds_now(), least = patience(least_s), most = patience(most_s);
  const double end = begin + std::max(least, most);
  const auto is_enough = [end] { return seconds_now() >= end; };
  while (deliver_until(lock, begin + least, is_enough) && !is_enough()) {
  }
  return !is_immediate_ && state_.deliveries.is_ready();
}

void Federate::enable_callbacks(bool is_enabled) {
  {
    const Lock lock(mutex_);
    if (!is_connected_) throw rti1516e::NotConnected(L"connect first");
    state_.deliveries.enable(is_enabled);
  }
  changed_.notify_all();
}

}  // namespace rink::standard
