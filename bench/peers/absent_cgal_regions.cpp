// Stands where CGAL was not there.
#include "bench/peers/region_peers.h"

namespace rink::bench {

extern const RegionMatch match_by_box_intersection = nullptr;

}  // namespace rink::bench
