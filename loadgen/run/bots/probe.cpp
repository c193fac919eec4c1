// Latency counts from the instant an action was due, so that a stalled server or bot cannot hide
// its stall.
#include "loadgen/run/bots/probe.h"

#include <algorithm>

#include "loadgen/measure/statistics/distributions.h"

namespace rink::loadgen {

std::string Measurements::schedule_trouble() const {
  constexpr double late_fraction_max = 0.01, level = 0.01;
  if (binomial_tail(late_sends, keys_sent, late_fraction_max) >= level) return "";
  return std::to_string(late_sends) + " of " + std::to_string(keys_sent) +
         " keys went out more than " + std::to_string(static_cast<int>(Probe::late_s * 1e3)) +
         " ms late";
}

void Probe::key_sent(double due_s, double sent_s, bool is_counted) {
  waiting_.push_back({due_s, is_counted});
  if (!is_counted) return;
  ++measurements_.keys_sent;
  measurements_.send_lateness.record(sent_s - due_s);
  if (sent_s - due_s > late_s) ++measurements_.late_sends;
}

void Probe::news_applied(double due_s, double now_s, bool is_counted) {
  if (is_counted) measurements_.update_latency.record(now_s - due_s);
}

void Probe::keys_felt(double now_s, std::uint32_t felt) {
  for (; answered_ < felt && !waiting_.empty(); ++answered_) {
    if (waiting_.front().is_counted)
      measurements_.input_latency.record(now_s - waiting_.front().due_s);
    waiting_.pop_front();
  }
}

std::uint64_t Probe::unanswered() const {
  return static_cast<std::uint64_t>(std::count_if(
      waiting_.begin(), waiting_.end(), [](const Waiting& key) { return key.is_counted; }));
}

}  // namespace rink::loadgen
