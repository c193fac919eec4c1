// Sends periodic state, and handles federates' acknowledgements of keyframes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rti/baselines/baselines.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/status.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

class PeriodicWriter {
 public:
  explicit PeriodicWriter(const FederationBasis& basis)
      : basis_(basis), baselines_(basis.fom, basis.settings.keyframe_period) {}

  Status handle_acknowledgement(std::uint32_t slot, Reader& reader);
  Status handle_refusal(std::uint32_t slot, Reader& reader);
  void left(std::uint32_t slot) { baselines_.forget(slot); }

  /// `flushes`: see `Baselines::begin`.
  void begin_flush(std::span<const UpdateRun> runs, std::uint64_t& flushes) {
    baselines_.begin(runs, basis_.federates.size(), flushes);
  }
  void end_flush() { baselines_.end(); }
  /// True if that run of the flush is periodic state.
  bool covers(std::size_t run) const { return baselines_.covers(run); }
  void gather(std::size_t run, FlushContext& context);
  const BaselineCounters& counters() const { return baselines_.counters(); }

 private:
  void cut(const UpdateRun& run, const DeltaBlock& block, FlushContext& context);
  void count(std::size_t records, std::size_t differences);
  void begin_keyframe(const Stamp& stamp, GatheredFrame& frame);

  FederationBasis basis_;
  Baselines baselines_;
};

}  // namespace rink::rti
