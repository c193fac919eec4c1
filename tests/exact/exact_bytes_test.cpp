// What a client of the crowd is sent by the host under the policy "exact", in bytes.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/exact/exact_rink.h"

namespace rink::game {
namespace {

/// Payload [bytes] per client and second with the RTI's frames, and with 36 B of headers a packet.
struct Rate {
  double payload = 0.0, wire = 0.0, told = 0.0, entries = 0.0;
};

Rate measured(double rate_hz, double view_fraction, double seconds, double network_grid = 0.0) {
  Scene scene = load_scene(rink::test::source_folder() + "/scenes/crowd.toml");
  scene.network_grid = network_grid;
  constexpr std::uint32_t clients = 6;
  LockstepRink rink(scene, {.scheme = view_fraction >= 1.0 ? "none" : "region",
                            .clients = clients,
                            .rate_hz = rate_hz,
                            .view_fraction = view_fraction,
                            .view_margin = view_fraction >= 1.0 ? 0.0 : 0.3,
                            .server = {.policy = "exact", .replay = keys_for(scene, 1, 60.0)}});
  rink.start();
  rink.run(1.0);
  const ExactCounters begin = rink.exact_feed()->counters();
  const std::uint64_t ticks = rink.tick_number;
  rink.run(seconds);
  const ExactCounters end = rink.exact_feed()->counters();
  const double of = clients * seconds;
  constexpr double frame = 4.0 + 1.0 + 1.0, headers = 36.0;
  const double per_s = static_cast<double>(rink.tick_number - ticks) / seconds;
  Rate rate;
  rate.payload = static_cast<double>(end.bytes - begin.bytes) / of + per_s * frame;
  rate.wire = rate.payload + per_s * headers;
  rate.told = static_cast<double>(end.told - begin.told) / of;
  rate.entries = static_cast<double>(end.entries - begin.entries) / of;
  std::printf(
      "%4.0f Hz, view %.2f: payload %.0f B/s, with headers %.2f kB/s; told %.2f/s, entries "
      "%.1f/s, returns %.1f/s, keys %.1f/s\n",
      rate_hz, view_fraction, rate.payload, 1e-3 * rate.wire, rate.told, rate.entries,
      static_cast<double>(end.returns - begin.returns) / of,
      static_cast<double>(end.keys - begin.keys) / of);
  EXPECT_EQ(counted(rink).wrong_hashes, 0u);
  return rate;
}

TEST(ExactBytes, WhoSeesAllOfTheCrowdIsSentLessThanFourKilobytesASecond) {
  const Rate rate = measured(60.0, 1.0, 4.0);
  EXPECT_LT(rate.wire, 3700.0);
  EXPECT_LT(rate.told, 3.0) << "face-offs alone";
}

TEST(ExactBytes, AViewOfATwentiethIsSentLessThanTwoKilobytesASecond) {
  const Rate rate = measured(20.0, 0.05, 6.0);
  EXPECT_LT(rate.wire, 1900.0);
}

TEST(ExactBytes, OnTheNetworkGridAViewOfATwentiethIsSentLessThanOneAndAHalf) {
  const Rate rate = measured(20.0, 0.05, 6.0, 20.0);
  EXPECT_LT(rate.wire, 1400.0);
}

}  // namespace
}  // namespace rink::game
