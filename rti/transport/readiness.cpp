// Epoll and a precise wait for it.
#include "rti/transport/readiness.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <ctime>

namespace rink::rti {

namespace {

std::uint32_t interest(bool wants_bytes, bool wants_room) {
  return (wants_bytes ? static_cast<std::uint32_t>(EPOLLIN) : 0u) |
         (wants_room ? static_cast<std::uint32_t>(EPOLLOUT) : 0u);
}

}  // namespace

File& File::operator=(File&& other) noexcept {
  if (this == &other) return *this;
  close();
  number_ = other.number_;
  other.number_ = -1;
  return *this;
}

void File::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

Readiness::Readiness() : epoll_(::epoll_create1(EPOLL_CLOEXEC)) {}

bool Readiness::watch(int file, std::uint64_t number, bool wants_room) {
  epoll_event event{};
  event.events = interest(true, wants_room);
  event.data.u64 = number;
  return ::epoll_ctl(epoll_.number(), EPOLL_CTL_ADD, file, &event) == 0;
}

void Readiness::change(int file, std::uint64_t number, bool wants_bytes, bool wants_room) {
  epoll_event event{};
  event.events = interest(wants_bytes, wants_room);
  event.data.u64 = number;
  ::epoll_ctl(epoll_.number(), EPOLL_CTL_MOD, file, &event);
}

void Readiness::ask_now() {
  taken_ = 0;
  count_ = static_cast<std::size_t>(std::max(
      0, ::epoll_wait(epoll_.number(), events_.data(), static_cast<int>(events_.size()), 0)));
}

void Readiness::ask(std::chrono::nanoseconds longest_wait, std::chrono::nanoseconds spin) {
  using Clock = std::chrono::steady_clock;
  if (taken_ != count_) return;
  if (longest_wait.count() <= 0) return ask_now();
  if (spin.count() > 0) {
    const Clock::time_point start = Clock::now(), until = start + std::min(spin, longest_wait);
    do ask_now();
    while (count_ == 0 && Clock::now() < until);
    if (count_ != 0 || spin >= longest_wait) return;
    longest_wait -= Clock::now() - start;
  }
  if (longest_wait.count() > 0) sleep(longest_wait);
}

/// Sleeping and asking are one system call where the kernel has epoll_pwait2 (Linux 5.11), three
/// where it has not: epoll_wait counts whole milliseconds, but ppoll on the epoll itself is exact
/// everywhere.
void Readiness::sleep(std::chrono::nanoseconds longest_wait) {
  assert(longest_wait.count() > 0 && taken_ == count_);
  const auto seconds = std::chrono::floor<std::chrono::seconds>(longest_wait);
  const timespec timeout{.tv_sec = static_cast<std::time_t>(seconds.count()),
                         .tv_nsec = static_cast<long>((longest_wait - seconds).count())};
  if (has_exact_sleep_) {
    taken_ = 0;
    const int count = ::epoll_pwait2(epoll_.number(), events_.data(),
                                     static_cast<int>(events_.size()), &timeout, nullptr);
    count_ = static_cast<std::size_t>(std::max(0, count));
    if (count >= 0 || errno == EINTR) return;
    has_exact_sleep_ = false;  // an older kernel, or a sandbox that does not know the call
  }
  pollfd all{.fd = epoll_.number(), .events = POLLIN, .revents = 0};
  ::ppoll(&all, 1, &timeout, nullptr);
  ask_now();
}

std::optional<Readiness::Event> Readiness::next() {
  assert(taken_ <= count_ && count_ <= events_.size());
  if (taken_ == count_ && count_ == events_.size()) ask_now();
  if (taken_ == count_) return std::nullopt;
  const epoll_event& event = events_[taken_++];
  const bool is_over = (event.events & (EPOLLERR | EPOLLHUP)) != 0;
  return Event{.number = event.data.u64,
               .is_writable = is_over || (event.events & EPOLLOUT) != 0,
               .is_readable = is_over || (event.events & EPOLLIN) != 0};
}

}  // namespace rink::rti
