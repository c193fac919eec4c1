// The conditions of a modelled network: delay, jitter, loss, reordering, duplication and rate of
// each link and direction, and when links are cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rti/transport/modelled/line_identity.h"
#include "rti/transport/modelled/packet_loss.h"

namespace rink::rti {

/// One direction of a link. The default is perfect: everything arrives at once.
struct LinkConditions {
  std::int64_t latency_ns = 0;  ///< that every packet takes
  std::int64_t jitter_ns = 0;  ///< mean of the additional delay, exponentially distributed. Packets
                               ///< keep their order: one that would overtake waits
  PacketLoss loss = PacketLoss::independent(0.0);
  double reorder =
      0.0;  ///< fraction of packets held for `held_ns` more, which those behind may overtake
  std::int64_t held_ns = 0;
  double duplicate = 0.0;             ///< fraction of packets that arrive twice
  std::uint64_t rate_bits_per_s = 0;  ///< with headers; 0: unlimited
  std::size_t queue_bytes =
      1u << 16;  ///< waiting or being sent at that rate, with headers; a datagram beyond is lost
                 ///< (tail drop), a reliable line's sender waits

  /// The longest that one packet that is not lost may take, the wait for others apart.
  std::int64_t longest_ns() const { return latency_ns + 37 * jitter_ns + held_ns; }
  /// What is wrong with these numbers, in words; empty if nothing.
  std::string objection() const;
  friend bool operator==(const LinkConditions&, const LinkConditions&) = default;
};

/// Other conditions for links `first` to `last` of each listener; a later exception overrides an
/// earlier one.
struct LinkException {
  std::uint32_t first = 0, last = 0;
  LinkConditions to_listener, from_listener;
};

/// Packets sent on links `first` to `last` from `from_ns` on and before `until_ns` are lost, in one
/// direction or, if none is named, in both.
struct Partition {
  std::int64_t from_ns = 0, until_ns = 0;
  std::uint32_t first = 0, last = UINT32_MAX;
  std::optional<LinkDirection> direction{};
};

/// The whole network. The same conditions and seed give the same fate to the same packets, whatever
/// other links carry.
struct NetworkConditions {
  std::uint64_t seed = 1;
  LinkConditions to_listener, from_listener;
  std::vector<LinkException> exceptions;
  std::vector<Partition> partitions;

  const LinkConditions& of(std::uint32_t link, LinkDirection direction) const;
};

}  // namespace rink::rti
