// Entities in the order of the cells they are in, so that a subscriber looks only where its interest can have changed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "im/region_history.h"

namespace rink::im {

/// A snapshot of moving boxes, binned once by the centre of where they are now (counting sort, row after row). The cells at the rim reach to infinity.
class CellIndex {
 public:
  explicit CellIndex(const Region& world) : world_(world) {}

  /// Bins `entities`, none of which may be nowhere now. Linear in their number; allocates only when there are more than ever before.
  void build(std::span<const std::uint32_t> entities, const RegionHistory& motions);

  /// Appends to `changed` each entity whose overlap with `subscription` now is not what it was before. Returns how many it looked at.
  std::uint64_t find_changes(const Motion& subscription, std::vector<std::uint32_t>& changed);

 private:
  struct Axis {
    double origin = 0.0, cells_per_metre = 0.0;
    std::int32_t last = 0;
    std::int32_t cell(double coordinate) const;
  };
  struct Span {
    std::int32_t first, last;  // closed; empty if first > last
  };
  struct Entry {
    Motion motion;
    std::uint32_t entity;
  };

  void lay_out(std::size_t count);
  std::int32_t bin(const Motion& motion);
  Span touched(const Axis& axis, double low, double high) const;
  Span certain(const Axis& axis, double low, double high) const;
  void scan(std::size_t first, std::size_t end, const Motion& subscription, std::vector<std::uint32_t>& changed);

  Region world_;
  Axis x_, y_;
  double reach_limit_ = 0.0;   // of what is binned [m]
  double reach_ = 0.0;         // farthest that a binned box, before or now, is from its centre now [m], rounding included
  bool has_newcomers_ = false;
  std::int32_t oversized_ = 0;  // the bin after the cells
  std::uint64_t looked_at_ = 0;
  std::vector<std::int32_t> bins_;      // of each entity handed to build
  std::vector<std::uint32_t> starts_;  // of each bin in entries_, and the end
  std::vector<Entry> entries_;
};

}  // namespace rink::im
