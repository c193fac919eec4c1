// Stands where Boost.Geometry was not there.
#include "bench/peers/region_peers.h"

namespace rink::bench {

extern const RegionMatch match_by_rtree = nullptr;

std::unique_ptr<MovingRegions> make_moving_rtrees(std::span<const im::Region>,
                                                  std::span<const im::Region>) {
  return nullptr;
}

}  // namespace rink::bench
