// Who looks at a world while it is played.
#pragma once

#include <cstdint>

#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

struct BodyState;
struct Flight;
struct Journal;

/// Keeps what bodies were before they change: of a free impact their flights, of all else the
/// whole. An interface, for who changes a body does not know all that belongs to one.
class ChangeObserver {
 public:
  virtual void keep(std::uint32_t body) = 0;
  virtual void keep_flight(std::uint32_t body, const Flight& flight) = 0;
  /// After the body has changed otherwise than in a free impact: what it was.
  virtual void keep_state(std::uint32_t body, const BodyState& before) = 0;

 protected:
  ~ChangeObserver() = default;
};

/// Nobody, or a subdomain of a world (subdomain.h), which may want to undo a window and tells other
/// worlds what happened in it. Nothing that they are told changes the motion.
struct Observers {
  ChangeObserver* before = nullptr;
  Journal* journal = nullptr;
};

}  // namespace rink::physics::inline RINK_PRECISION
