// Subtracts what came before the span.
#include "loadgen/run/bots/meter.h"

#include <cassert>

namespace rink::loadgen {
namespace {

CrowdTraffic operator-(CrowdTraffic a, const CrowdTraffic& b) {
  a.bytes_sent -= b.bytes_sent;
  a.bytes_received -= b.bytes_received;
  a.segments_sent -= b.segments_sent;
  a.acknowledgements_sent -= b.acknowledgements_sent;
  a.kernel_segments_sent -= b.kernel_segments_sent;
  a.kernel_bytes_sent -= b.kernel_bytes_sent;
  a.kernel_bytes_received -= b.kernel_bytes_received;
  a.updates_received -= b.updates_received;
  return a;
}

}  // namespace

void Meter::begin(double now_s, const CarriedSoFar& carried) {
  assert(!has_begun());
  begin_s_ = now_s;
  at_begin_ = carried.traffic;
  received_by_bot_ = carried.received_by_bot;
}

void Meter::end(double now_s, const CarriedSoFar& carried) {
  assert(is_measuring() && carried.received_by_bot.size() == received_by_bot_.size());
  has_ended_ = true;
  measured_s_ = now_s - *begin_s_;
  within_ = carried.traffic - at_begin_;
  for (std::size_t bot = 0; bot < received_by_bot_.size(); ++bot)
    received_by_bot_[bot] = carried.received_by_bot[bot] - received_by_bot_[bot];
}

}  // namespace rink::loadgen
