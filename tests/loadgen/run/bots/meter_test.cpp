// What lies within the measured span is what came after its begin.
#include "loadgen/run/bots/meter.h"

#include <gtest/gtest.h>

namespace rink::loadgen {
namespace {

TEST(AMeter, SubtractsWhatCameBeforeItsSpan) {
  Meter meter(1.0, 3.0);
  EXPECT_TRUE(meter.measurements().is_counted(1.0));
  EXPECT_FALSE(meter.measurements().is_counted(3.0));
  EXPECT_FALSE(meter.is_measuring());
  meter.begin(101.0,
              {.traffic = {.bytes_sent = 10, .updates_received = 3}, .received_by_bot = {5, 7}});
  EXPECT_TRUE(meter.is_measuring());
  EXPECT_EQ(meter.traffic(), CrowdTraffic()) << "not known before the end";
  meter.end(103.5, {.traffic = {.bytes_sent = 25, .bytes_received = 4, .updates_received = 9},
                    .received_by_bot = {6, 17}});
  EXPECT_TRUE(meter.has_ended());
  EXPECT_FALSE(meter.is_measuring());
  EXPECT_EQ(meter.measured_s(), 2.5);
  EXPECT_EQ(meter.traffic(),
            (CrowdTraffic{.bytes_sent = 15, .bytes_received = 4, .updates_received = 6}));
  EXPECT_EQ(meter.received_by_bot(), (std::vector<std::uint64_t>{1, 10}));
}

}  // namespace
}  // namespace rink::loadgen
