// Queue, losses, retransmissions and delays of packets, decided when they are sent.
#include "rti/transport/modelled/network_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace rink::rti {

namespace {
constexpr std::uint64_t bits_ns = 8'000'000'000;  // bits of a byte times nanoseconds of a second
enum Property : std::uint64_t { losses, jitters, orders, duplicates, repetitions };
}  // namespace

NetworkModel::NetworkModel(NetworkConditions conditions) : conditions_(std::move(conditions)) {
  assert(conditions_.to_listener.objection().empty() &&
         conditions_.from_listener.objection().empty());
  for ([[maybe_unused]] const LinkException& exception : conditions_.exceptions)
    assert(exception.to_listener.objection().empty() &&
           exception.from_listener.objection().empty());
}

void NetworkModel::open_line(std::uint32_t number, const LineIdentity& identity) {
  if (number >= lines_.size()) lines_.resize(number + 1);
  Line& line = lines_[number] = Line{};
  line.link = identity.link;
  line.direction = identity.direction;
  line.conditions = conditions_.of(identity.link, identity.direction);
  const bool is_up = identity.direction == LinkDirection::to_listener;
  line.back_ns =
      conditions_
          .of(identity.link, is_up ? LinkDirection::from_listener : LinkDirection::to_listener)
          .latency_ns;
  const std::uint64_t link =
      LinkStream::key_of(LinkStream::key_of(conditions_.seed, identity.listener), identity.link);
  const std::uint64_t key = LinkStream::key_of(link, is_up ? 0u : 1u);
  line.loss = LossChain(line.conditions.loss, LinkStream::key_of(key, losses));
  line.jitter = LinkStream(LinkStream::key_of(key, jitters));
  line.order = LinkStream(LinkStream::key_of(key, orders));
  line.copies = LinkStream(LinkStream::key_of(key, duplicates));
  line.retries = LinkStream(LinkStream::key_of(key, repetitions));
}

std::int64_t NetworkModel::departure_ns(Line& line, std::int64_t now_ns, std::size_t bytes) {
  const std::uint64_t rate = line.conditions.rate_bits_per_s;
  if (rate == 0) return now_ns;
  if (line.idle_ns <= now_ns) {
    line.idle_ns = now_ns;
    line.remainder = 0;
  }
  const std::uint64_t work = bytes * bits_ns + line.remainder;
  line.idle_ns += static_cast<std::int64_t>(work / rate);
  line.remainder = work % rate;
  assert(line.idle_ns >= now_ns);
  return line.idle_ns;
}

std::int64_t NetworkModel::service_ns(const Line& line, std::size_t bytes) const {
  const std::uint64_t rate = line.conditions.rate_bits_per_s;
  return rate == 0 ? 0 : static_cast<std::int64_t>(bytes * bits_ns / rate);
}

std::size_t NetworkModel::queued_bytes(std::uint32_t number, std::int64_t now_ns) const {
  assert(number < lines_.size());
  const Line& line = lines_[number];
  if (line.idle_ns <= now_ns) return 0;
  const double seconds = 1e-9 * static_cast<double>(line.idle_ns - now_ns);
  return static_cast<std::size_t>(
      std::ceil(seconds * static_cast<double>(line.conditions.rate_bits_per_s) / 8.0 - 1e-6));
}

bool NetworkModel::is_cut(const Line& line, std::int64_t instant_ns) const {
  return std::any_of(
      conditions_.partitions.begin(), conditions_.partitions.end(), [&](const Partition& cut) {
        return instant_ns >= cut.from_ns && instant_ns < cut.until_ns && line.link >= cut.first &&
               line.link <= cut.last && (!cut.direction || *cut.direction == line.direction);
      });
}

bool NetworkModel::is_lost(Line& line, std::int64_t departed_ns, bool is_retry) {
  const PacketLoss& loss = line.conditions.loss;
  const bool loses = !loss.loses_nothing() &&
                     (is_retry ? line.retries.coin(loss.loss()) : line.loss.loses_next(loss));
  const bool cuts = is_cut(line, departed_ns);
  if (cuts) ++counters_.cut;
  else if (loses) ++counters_.lost;
  return cuts || loses;
}

std::int64_t NetworkModel::jitter_ns(Line& line) {
  return line.conditions.jitter_ns == 0
             ? 0
             : std::llround(static_cast<double>(line.conditions.jitter_ns) *
                            line.jitter.exponential());
}

bool NetworkModel::is_held(Line& line) {
  const bool holds = line.conditions.reorder > 0.0 && line.order.coin(line.conditions.reorder);
  counters_.held += holds;
  return holds;
}

void NetworkModel::learn(Line& line, std::int64_t round_trip_ns) {
  assert(round_trip_ns >= 0);
  if (line.smoothed_ns == 0) {
    line.smoothed_ns = round_trip_ns;
    line.variation_ns = round_trip_ns / 2;
  } else {
    line.variation_ns += (std::abs(line.smoothed_ns - round_trip_ns) - line.variation_ns) / 4;
    line.smoothed_ns += (round_trip_ns - line.smoothed_ns) / 8;
  }
  line.timeout_ns =
      std::clamp(line.smoothed_ns + 4 * line.variation_ns, timeout_min_ns, timeout_max_ns);
}

Delivery NetworkModel::deliver_segment(Line& line, std::int64_t now_ns, std::size_t bytes,
                                       std::size_t behind) {
  const std::int64_t round_trip_ns =
      std::max(line.smoothed_ns, line.conditions.latency_ns + line.back_ns);
  std::int64_t departed_ns = departure_ns(line, now_ns, bytes), timeout_ns = line.timeout_ns;
  for (int attempt = 0;; ++attempt) {
    ++counters_.segments;
    const bool loses = is_lost(line, departed_ns, attempt > 0);
    const std::int64_t arrival_ns = departed_ns + line.conditions.latency_ns + jitter_ns(line) +
                                    (is_held(line) ? line.conditions.held_ns : 0);
    if (!loses) {
      if (attempt == 0) learn(line, arrival_ns - now_ns + line.back_ns);
      return {arrival_ns, false};
    }
    const bool is_fast = attempt == 0 && behind >= 3;
    departed_ns += is_fast ? round_trip_ns : timeout_ns;
    if (attempt == retries_max) return {departed_ns, true};
    if (!is_fast) timeout_ns = std::min(2 * timeout_ns, timeout_max_ns);
    departed_ns += service_ns(line, bytes);
    ++counters_.retransmitted;
  }
}

Delivery NetworkModel::deliver(std::uint32_t number, std::int64_t now_ns, std::size_t size) {
  assert(number < lines_.size());  // it was opened
  Line& line = lines_[number];
  const std::size_t segments = std::max<std::size_t>(1, (size + segment_max - 1) / segment_max);
  Delivery last{now_ns, false};
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t payload = std::min(size - std::min(size, i * segment_max), segment_max);
    const Delivery segment =
        deliver_segment(line, now_ns, payload + segment_header, segments - 1 - i);
    if (segment.is_given_up) return segment;
    last.instant_ns = std::max(last.instant_ns, segment.instant_ns);
  }
  return last;
}

DatagramArrivals NetworkModel::datagram(std::uint32_t number, std::int64_t now_ns,
                                        std::size_t size) {
  assert(number < lines_.size());
  Line& line = lines_[number];
  const LinkConditions& conditions = line.conditions;
  const std::size_t bytes = size + datagram_header;
  ++counters_.datagrams;
  if (conditions.rate_bits_per_s > 0 &&
      queued_bytes(number, now_ns) + bytes > conditions.queue_bytes) {
    ++counters_.dropped;
    return {};
  }
  const std::int64_t departed_ns = departure_ns(line, now_ns, bytes);
  const bool loses = is_lost(line, departed_ns, false), holds = is_held(line),
             copies = conditions.duplicate > 0.0 && line.copies.coin(conditions.duplicate);
  std::int64_t arrival_ns = departed_ns + conditions.latency_ns + jitter_ns(line);
  if (loses) return {};
  DatagramArrivals arrivals;
  if (holds) {
    arrival_ns += conditions.held_ns;
  } else {
    arrival_ns = line.last_datagram_ns = std::max(arrival_ns, line.last_datagram_ns);
  }
  arrivals.add(arrival_ns);
  if (copies) {
    ++counters_.duplicated;
    arrivals.add(arrival_ns + (is_held(line) ? conditions.held_ns : 0));
  }
  return arrivals;
}

}  // namespace rink::rti
