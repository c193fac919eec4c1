// Moved boxes as queries to an index, in the caller's order.
#pragma once

#include <cassert>

#include "im/matching/buffer.h"
#include "im/matching/index/scan.h"
#include "im/matching/projection.h"
#include "im/matching/region_history.h"

namespace rink::im {

/// A motion with both its places projected; `before` may be nowhere.
struct ProjectedMotion {
  FloatBox before, now;
};

/// Clears `is_exact` if something is lost.
inline ProjectedMotion project(const Projection& projection, const Motion& motion, bool& is_exact) {
  ProjectedMotion projected{float_nowhere, projection(motion.now)};
  if (is_exact) is_exact = projection.is_exact(motion.now, projected.now);
  if (is_nowhere(motion.before)) return projected;
  projected.before = projection(motion.before);
  if (is_exact) is_exact = projection.is_exact(motion.before, projected.before);
  return projected;
}

class ProbeList {
 public:
  void begin(const Region& world) {
    projection_ = Projection(world.low_x, world.low_y);
    is_exact_ = true;
    probes_.clear();
  }
  void add(std::uint32_t id, const Motion& motion) {
    assert(!is_nowhere(motion.now));
    const ProjectedMotion projected = project(projection_, motion, is_exact_);
    probes_.push_back({projected.before, projected.now, id, 0});
  }

  std::size_t size() const { return probes_.size(); }
  const Probe& probe(std::size_t i) const { return probes_[i]; }
  bool is_exact() const { return is_exact_; }
  std::size_t bytes() const { return sizeof(Probe) * probes_.capacity(); }

 private:
  Projection projection_;
  bool is_exact_ = true;
  Buffer<Probe> probes_;
};

}  // namespace rink::im
