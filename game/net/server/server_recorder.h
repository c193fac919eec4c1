// Records a running server's trace in memory; it is written afterwards.
#pragma once

#include <cstdint>
#include <vector>

#include "game/net/server/server.h"
#include "game/net/server_trace.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// A sampled tick costs one pass over the scope of a few players; all others a few words. Memory is
/// bounded by SamplingSettings::record_max.
class ServerRecorder {
 public:
  ServerRecorder(const SamplingSettings& settings, double rate_hz);

  /// Call it after every tick, when the filter has decided.
  void look(const Server& server, const rti::FederationExecution& execution,
            const ServerTrace::Tick& tick);
  /// The trace so far, with the keys and the present hash of the game. The caller adds choice,
  /// scheme and policy.
  ServerTrace trace(const Server& server) const;
  std::size_t memory_bytes() const;

 private:
  void name_objects(const Server& server);
  void note_decisions(const Server& server, const rti::FederationExecution& execution,
                      double instant_s);

  SamplingSettings settings_;
  double tick_s_;
  std::vector<std::uint32_t> players_;
  std::vector<double> instants_;
  std::size_t next_instant_ = 0, next_player_ = 0;
  bool are_named_ = false;
  std::vector<rti::ObjectHandle> listed_;
  ServerTrace trace_;
};

}  // namespace rink::game
