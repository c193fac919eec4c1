// What a client of the crowd that does not compute is sent under the other policies, in bytes,
// beside those of "exact" (exact_bytes_test.cpp): the same scene, keys, rates and headers.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/exact/exact_rink.h"

namespace rink::game {
namespace {

constexpr double headers = 36.0;  // bytes of a packet's IP and TCP or UDP

/// Bytes per client and second, with the headers of one packet a frame.
double told(const std::string& policy, double rate_hz, double view_fraction, double seconds) {
  const Scene scene = load_scene(rink::test::source_folder() + "/scenes/crowd.toml");
  constexpr std::uint32_t clients = 6;
  LockstepRink rink(scene, {.scheme = view_fraction >= 1.0 ? "none" : "region",
                            .clients = clients,
                            .rate_hz = rate_hz,
                            .view_fraction = view_fraction,
                            .server = {.policy = policy, .replay = keys_for(scene, 1, 60.0)}});
  rink.start();
  rink.run(1.0);
  struct Sum {
    std::uint64_t bytes = 0, frames = 0, updates = 0, changes = 0;
  };
  const auto count = [&rink] {
    Sum sum;
    for (std::size_t i = 0; i < rink.client_count(); ++i) {
      const rti::AmbassadorCounters& each = rink.client(i).ambassador().counters();
      sum.bytes += each.bytes_received;
      sum.frames += each.frames_received;
      sum.updates += each.updates_reflected;
      sum.changes += each.scope_changes;
    }
    return sum;
  };
  const Sum begin = count();
  const rti::FederationCounters& counters = rink.execution().counters();
  const std::uint64_t scope = counters.scope_bytes_sent, entry = counters.entry_bytes_sent,
                      update = counters.update_bytes_sent;
  rink.run(seconds);
  const Sum end = count();
  const double of = clients * seconds;
  const auto rate = [of](std::uint64_t from, std::uint64_t to) {
    return static_cast<double>(to - from) / of;
  };
  const double wire = rate(begin.bytes, end.bytes) + headers * rate(begin.frames, end.frames);
  std::printf(
      "%-14s %2.0f Hz, view %.2f: payload %.0f B/s (updates %.0f, full states %.0f, scope %.0f), "
      "with headers %.2f kB/s; %.1f updates/s, %.1f changes of scope/s\n",
      policy.c_str(), rate_hz, view_fraction, rate(begin.bytes, end.bytes),
      rate(update, counters.update_bytes_sent), rate(entry, counters.entry_bytes_sent),
      rate(scope, counters.scope_bytes_sent), 1e-3 * wire, rate(begin.updates, end.updates),
      rate(begin.changes, end.changes));
  return wire;
}

TEST(ToldBytes, WhoSeesAllOfTheCrowdIsSentLessUnderOnEventThanUnderAnyOther) {
  const double on_event = told("on-event", 60.0, 1.0, 4.0);
  EXPECT_LT(on_event, 12800.0);
  EXPECT_LT(on_event, told("dead-reckoning", 60.0, 1.0, 4.0));
  EXPECT_LT(on_event, told("snapshot", 60.0, 1.0, 4.0));
}

TEST(ToldBytes, AViewOfATwentiethIsSentLessUnderOnEventThanUnderAnyOther) {
  const double on_event = told("on-event", 20.0, 0.05, 6.0);
  EXPECT_LT(on_event, 1750.0);
  EXPECT_LT(on_event, told("dead-reckoning", 20.0, 0.05, 6.0));
  EXPECT_LT(on_event, told("snapshot", 20.0, 0.05, 6.0));
}

}  // namespace
}  // namespace rink::game
