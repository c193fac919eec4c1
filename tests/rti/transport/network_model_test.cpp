// Fates of packets against the closed forms of their models: loss, bursts, queues, jitter, order,
// copies.
#include "rti/transport/modelled/network_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rti/transport/modelled/link_stream.h"
#include "tests/rti/transport/instants.h"

namespace rink::rti {
namespace {

using namespace testing;

/// One link of its own, whose direction to the listener is `conditions`.
struct Link {
  explicit Link(const LinkConditions& conditions, std::uint64_t seed = 1)
      : model({.seed = seed,
               .to_listener = conditions,
               .from_listener = {},
               .exceptions = {},
               .partitions = {}}) {
    EXPECT_EQ(conditions.objection(), "");
    model.open_line(0, {"here", 0, LinkDirection::to_listener});
  }
  /// The instants at which a datagram arrives.
  std::vector<std::int64_t> send(std::int64_t now_ns, std::size_t size = 100) {
    const DatagramArrivals arrivals = model.datagram(0, now_ns, size);
    return {arrivals.begin(), arrivals.end()};
  }
  NetworkModel model;
};

/// Lengths of the runs of lost packets among `count` datagrams a millisecond apart.
std::vector<std::size_t> lost_runs(Link& link, std::size_t count) {
  std::vector<std::size_t> runs;
  bool was_lost = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_lost = link.send(static_cast<std::int64_t>(i) * ms).empty();
    if (is_lost && was_lost) ++runs.back();
    else if (is_lost) runs.push_back(1);
    was_lost = is_lost;
  }
  return runs;
}

double sum_of(const std::vector<std::size_t>& runs) {
  double sum = 0.0;
  for (const std::size_t run : runs) sum += static_cast<double>(run);
  return sum;
}

/// Five standard deviations: one case in 1.7 million fails by chance, and the seeds are fixed.
constexpr double sigmas = 5.0;

TEST(NetworkModel, IndependentLossesHaveTheirRateAndGeometricRuns) {
  constexpr std::size_t count = 400'000;
  for (const double p : {0.001, 0.03, 0.2, 0.6}) {
    Link link({.loss = PacketLoss::independent(p)}, 7);
    const std::vector<std::size_t> runs = lost_runs(link, count);
    EXPECT_NEAR(sum_of(runs) / count, p, sigmas * std::sqrt(p * (1.0 - p) / count)) << "p " << p;
    EXPECT_NEAR(PacketLoss::independent(p).burst(), 1.0 / (1.0 - p), 1e-9);
    for (std::size_t length = 1; length <= 4; ++length) {
      const double expected = (1.0 - p) * std::pow(p, static_cast<double>(length - 1)),
                   n = static_cast<double>(runs.size());
      EXPECT_NEAR(static_cast<double>(std::ranges::count(runs, length)) / n, expected,
                  sigmas * std::sqrt(expected * (1.0 - expected) / n) + 1.0 / n)
          << "p " << p << ", runs of " << length;
    }
  }
}

TEST(NetworkModel, BurstsHaveTheRateAndTheMeanLengthThatWasAskedFor) {
  constexpr std::size_t count = 1'000'000;
  for (const auto& [rate, burst] : {std::pair{0.01, 5.0}, {0.1, 2.0}, {0.3, 20.0}, {0.5, 1.5}}) {
    const PacketLoss loss = PacketLoss::in_bursts(rate, burst);
    ASSERT_TRUE(loss.is_possible());
    EXPECT_NEAR(loss.loss(), rate, 1e-12);
    EXPECT_NEAR(loss.burst(), burst, 1e-9);
    Link link({.loss = loss}, 11);
    const std::vector<std::size_t> runs = lost_runs(link, count);
    const double memory = 1.0 - loss.to_bad - loss.to_good;  // correlation of neighbours
    EXPECT_NEAR(sum_of(runs) / count, rate,
                sigmas * std::sqrt(rate * (1.0 - rate) / count * (1.0 + memory) / (1.0 - memory)))
        << "burst " << burst;
    const double n = static_cast<double>(runs.size());
    EXPECT_NEAR(sum_of(runs) / n, burst, sigmas * std::sqrt(burst * (burst - 1.0) / n))
        << "rate " << rate;
  }
}

TEST(NetworkModel, AChainThatAlsoLosesInItsGoodStateAndNotAllInItsBadOneFollowsItsClosedForms) {
  constexpr std::size_t count = 1'000'000;
  const PacketLoss loss{.to_bad = 0.02, .to_good = 0.1, .loss_good = 0.01, .loss_bad = 0.7};
  EXPECT_NEAR(loss.bad_fraction(), 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(loss.loss(), 5.0 / 6.0 * 0.01 + 0.7 / 6.0, 1e-12);
  Link link({.loss = loss}, 13);
  const std::vector<std::size_t> runs = lost_runs(link, count);
  EXPECT_NEAR(sum_of(runs) / count, loss.loss(),
              sigmas * std::sqrt(loss.loss() * (1.0 - loss.loss()) / count * (1.88 / 0.12)));
  EXPECT_NEAR(sum_of(runs) / static_cast<double>(runs.size()), loss.burst(), 0.01 * loss.burst())
      << runs.size() << " runs";
}

TEST(NetworkModel, ABurstLeavesALimitedRateOnePacketAfterTheOther) {
  constexpr std::size_t size = 972;  // 1000 with headers: 3.2 ms at 2.5 Mbit/s
  Link link({.latency_ns = 20 * ms, .rate_bits_per_s = 2'500'000, .queue_bytes = 10'500});
  for (std::int64_t k = 1; k <= 10; ++k) {
    EXPECT_EQ(link.send(5 * ms, size), std::vector{5 * ms + k * 3'200'000 + 20 * ms});
    EXPECT_EQ(link.model.queued_bytes(0, 5 * ms), static_cast<std::size_t>(k) * 1000);
  }
  EXPECT_TRUE(link.send(5 * ms, size).empty()) << "500 bytes of room";
  EXPECT_EQ(link.send(5 * ms, 472).size(), 1u);
  EXPECT_EQ(link.model.counters().dropped, 1u);
  EXPECT_EQ(link.model.queued_bytes(0, 5 * ms + 32 * ms), 500u);
}

TEST(NetworkModel, NoRoundingAddsUpAtARateThatDividesNothing) {
  Link link({.rate_bits_per_s = 7'000'003, .queue_bytes = 1u << 30});
  std::int64_t last_ns = 0;
  constexpr std::int64_t count = 100'000;
  for (std::int64_t i = 0; i < count; ++i) last_ns = link.send(0, 133).at(0);
  EXPECT_EQ(last_ns, count * 161 * 8 * second / 7'000'003);
}

TEST(NetworkModel, PoissonArrivalsWaitAsPollaczekAndKhinchineSay) {
  constexpr int batches = 40, per_batch = 20'000;
  constexpr double service_s = 1e-3;  // 1000 bytes with headers at 8 Mbit/s
  for (const double load : {0.3, 0.7}) {
    Link link({.rate_bits_per_s = 8'000'000, .queue_bytes = 1u << 30});
    LinkStream arrivals(17);
    double now_s = 0.0, sum = 0.0, square = 0.0;
    for (int batch = 0; batch < batches; ++batch) {
      double waited_s = 0.0;
      for (int i = 0; i < per_batch; ++i) {
        now_s += arrivals.exponential() * service_s / load;
        const auto now_ns = static_cast<std::int64_t>(now_s * 1e9);
        waited_s += 1e-9 * static_cast<double>(link.send(now_ns, 972).at(0) - now_ns) - service_s;
      }
      sum += waited_s / per_batch;
      square += waited_s / per_batch * waited_s / per_batch;
    }
    const double mean = sum / batches,
                 deviation = std::sqrt((square / batches - mean * mean) / (batches - 1));
    EXPECT_NEAR(mean, load * service_s / (2.0 * (1.0 - load)), 4.0 * deviation) << "load " << load;
    EXPECT_LT(deviation, 0.02 * mean);
  }
}

TEST(NetworkModel, JitterIsExponential) {
  constexpr std::size_t count = 100'000;
  Link link({.latency_ns = 30 * ms, .jitter_ns = 4 * ms}, 19);
  std::vector<double> late(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t now_ns =
        static_cast<std::int64_t>(i) * second;  // too far apart to hold each other up
    late[i] = static_cast<double>(link.send(now_ns).at(0) - now_ns - 30 * ms) /
              static_cast<double>(4 * ms);
  }
  std::ranges::sort(late);
  double distance = 0.0;  // Kolmogorov and Smirnov's
  for (std::size_t i = 0; i < count; ++i)
    distance = std::max(distance,
                        std::abs(-std::expm1(-late[i]) - (static_cast<double>(i) + 0.5) / count));
  EXPECT_LT(distance * std::sqrt(count), 1.95) << "exceeded by one sample in a thousand";
  EXPECT_GE(late.front(), 0.0);
}

TEST(NetworkModel, NothingOvertakesUnlessItMay) {
  Link link({.latency_ns = 10 * ms,
             .jitter_ns = 20 * ms,
             .loss = PacketLoss::independent(0.1),
             .duplicate = 0.1},
            23);
  std::int64_t last_ns = 0;
  for (std::int64_t i = 0; i < 20'000; ++i)
    for (const std::int64_t arrival_ns : link.send(i * ms)) {
      ASSERT_GE(arrival_ns, last_ns);
      last_ns = arrival_ns;
    }
  EXPECT_EQ(link.model.counters().held, 0u);
}

TEST(NetworkModel, TheFractionHeldIsOvertakenAndNoOther) {
  constexpr double reorder = 0.1;
  constexpr std::int64_t count = 100'000;
  Link link({.latency_ns = 10 * ms, .reorder = reorder, .held_ns = 7 * ms}, 29);
  std::int64_t held = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t taken_ns = link.send(i * ms).at(0) - i * ms;
    held += taken_ns == 17 * ms;
    ASSERT_TRUE(taken_ns == 10 * ms || taken_ns == 17 * ms);
  }
  EXPECT_NEAR(static_cast<double>(held) / count, reorder,
              sigmas * std::sqrt(reorder * (1.0 - reorder) / count));
}

TEST(NetworkModel, TheFractionDuplicatedComesTwice) {
  constexpr double duplicate = 0.05;
  constexpr std::int64_t count = 100'000;
  Link link({.duplicate = duplicate}, 31);
  std::int64_t twice = 0;
  for (std::int64_t i = 0; i < count; ++i) twice += link.send(i * ms).size() == 2;
  EXPECT_NEAR(static_cast<double>(twice) / count, duplicate,
              sigmas * std::sqrt(duplicate * (1.0 - duplicate) / count));
  EXPECT_EQ(link.model.counters().duplicated, static_cast<std::uint64_t>(twice));
}

TEST(NetworkModel, WhatIsLostDependsOnNoOtherProperty) {
  const auto fates = [](const LinkConditions& conditions) {
    Link link(conditions, 37);
    std::vector<bool> lost;
    for (std::int64_t i = 0; i < 2000; ++i) lost.push_back(link.send(i * ms).empty());
    return lost;
  };
  const PacketLoss loss = PacketLoss::in_bursts(0.2, 3.0);
  EXPECT_EQ(fates({.loss = loss}), fates({.latency_ns = ms,
                                          .jitter_ns = ms,
                                          .loss = loss,
                                          .reorder = 0.5,
                                          .held_ns = ms,
                                          .duplicate = 0.5}));
}

TEST(NetworkModel, ALinksFateIsItsOwn) {
  const LinkConditions conditions{.jitter_ns = ms, .loss = PacketLoss::independent(0.3)};
  const auto fates = [&](std::uint32_t others, std::uint32_t link, LinkDirection direction,
                         std::uint64_t seed) {
    NetworkModel model({.seed = seed,
                        .to_listener = conditions,
                        .from_listener = conditions,
                        .exceptions = {},
                        .partitions = {}});
    for (std::uint32_t line = 0; line < others; ++line)
      model.open_line(line, {"elsewhere", line, LinkDirection::to_listener});
    model.open_line(others, {"here", link, direction});
    std::vector<std::int64_t> all;
    for (std::int64_t i = 0; i < 500; ++i) {
      for (std::uint32_t line = 0; line < others; ++line) model.datagram(line, i * ms, 50);
      for (const std::int64_t arrival_ns : model.datagram(others, i * ms, 50))
        all.push_back(arrival_ns);
    }
    return all;
  };
  const auto own = fates(0, 4, LinkDirection::to_listener, 1);
  EXPECT_EQ(own, fates(9, 4, LinkDirection::to_listener, 1));
  EXPECT_NE(own, fates(0, 4, LinkDirection::from_listener, 1));
  EXPECT_NE(own, fates(0, 5, LinkDirection::to_listener, 1));
  EXPECT_NE(own, fates(0, 4, LinkDirection::to_listener, 2));
}

TEST(NetworkModel, SomeLinksAreLikeNoOther) {
  NetworkModel model({.seed = 1,
                      .to_listener = {.latency_ns = 10},
                      .from_listener = {.latency_ns = 20},
                      .exceptions = {{.first = 3,
                                      .last = 5,
                                      .to_listener = {.latency_ns = 30},
                                      .from_listener = {.latency_ns = 40}}},
                      .partitions = {}});
  for (std::uint32_t link = 0; link < 8; ++link) {
    model.open_line(2 * link, {"here", link, LinkDirection::to_listener});
    model.open_line(2 * link + 1, {"here", link, LinkDirection::from_listener});
    const bool is_exception = link >= 3 && link <= 5;
    EXPECT_EQ(model.arrival_ns(2 * link, 100, 1), is_exception ? 130 : 110);
    EXPECT_EQ(model.arrival_ns(2 * link + 1, 100, 1), is_exception ? 140 : 120);
  }
}

TEST(NetworkModel, NumbersThatMakeNoLinkAreNamed) {
  EXPECT_EQ(LinkConditions{}.objection(), "");
  for (const LinkConditions& bad :
       {LinkConditions{.latency_ns = -1}, LinkConditions{.jitter_ns = -1},
        LinkConditions{.loss = PacketLoss::independent(1.1)},
        LinkConditions{.loss = PacketLoss::in_bursts(0.9, 1.0)}, LinkConditions{.reorder = -0.1},
        LinkConditions{.duplicate = 2.0},
        LinkConditions{.rate_bits_per_s = 1000, .queue_bytes = 100}})
    EXPECT_NE(bad.objection(), "");
}

}  // namespace
}  // namespace rink::rti
