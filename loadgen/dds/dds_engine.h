// The engine of distribution over Cyclone DDS (docs/experiments.md, "DDS"): a server that publishes
// a game by partitions, and a crowd of bots that read them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rink::loadgen {

struct DdsServeOptions {
  std::string scene = "crowd", scheme = "grid", keys, from_state, report, trace;
  std::uint32_t bats = 0, bat_count = 0, puck_count = 0, clients = 1;
  std::uint64_t seed = 0;
  double cell_size = 0.0,  ///< m, of `grid`; 0: as the filter of that name would choose
      rate_hz = 30.0, duration_s = 10.0, warm_up_s = 0.0, patience_s = 30.0;
  std::optional<std::uint32_t> domain{};  ///< none: any that is free
};

struct DdsBotsOptions {
  std::string plan, report, trace;
  std::uint32_t domain = 0, count = 1;
  std::uint64_t seed = 1;
  double view_fraction = 0.05, view_area = 0.0, view_margin = 0.3, start_s = 0.0, duration_s = 10.0,
         warm_up_s = 0.0, patience_s = 30.0;
  bool extrapolates = true;
};

/// How a role ended; `error` is empty if all is well.
struct DdsEnding {
  std::string error;
  bool is_alone = false;  ///< the others did not come
};

/// The machine's clock [s], the same for both.
using DdsClock = std::function<double()>;

/// Serves until the duration is over or game::is_interrupted. `listening` is called with the domain
/// once bots can come. Throws DdsError (loadgen/dds/domain.h), SceneError and what files throw;
/// std::runtime_error with dds_absence (loadgen/dds/dds_absence.h) where the library is absent.
DdsEnding serve_by_dds(const DdsServeOptions& options, const DdsClock& now_s,
                       const std::function<void(std::uint32_t domain)>& listening);
/// Plays likewise.
DdsEnding play_by_dds(const DdsBotsOptions& options, const DdsClock& now_s);

}  // namespace rink::loadgen
