// Synchronisation points: registered, announced, achieved and reached (IEEE 1516.1-2010, 4.11 to
// 4.15).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/federation/federate_table.h"
#include "rti/federation/status.h"
#include "rti/federation/synchronization_point.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class Synchronization {
 public:
  static constexpr std::size_t point_max = 64;  ///< of one federate, not reached yet
  static constexpr std::size_t left_max =
      256;  ///< points that live on after their registrars have left

  explicit Synchronization(FederateTable& federates) : federates_(federates) {}

  Status handle_register(std::uint32_t slot, Reader& reader);
  Status handle_achieved(std::uint32_t slot, Reader& reader);
  /// A federate that joins belongs to every point that is for all.
  void joined(std::uint32_t slot);
  /// A federate that leaves is no longer waited for.
  void left(std::uint32_t slot);
  const std::vector<SynchronizationPoint>& points() const { return points_; }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, points_);
  }

 private:
  std::optional<SynchronizationFailure> find_members(
      const RegisterSynchronizationPointMessage& message, SynchronizationPoint& point) const;
  void announce(const SynchronizationPoint& point, std::uint32_t slot);
  void orphan(FederateHandle registrar);
  void complete();

  FederateTable& federates_;
  std::vector<SynchronizationPoint> points_;
};

}  // namespace rink::rti
