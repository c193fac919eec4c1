// Impacts of two: the impulses along the normal, and along the tangent of rough surfaces.
#pragma once

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/body.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Newton's law of impact, and Coulomb's for the surfaces.
class Bounce {
 public:
  Bounce(const WorldSpec& spec, Bodies& bodies, RestContacts& rests)
      : spec_(spec), bodies_(bodies), rests_(rests) {}

  /// A contact that no longer closes (grazing, rounding) still leaves with the least separation, or
  /// it would be found again.
  void apply(const Contact& contact, Real restitution, Real time);

 private:
  void push(const Contact& contact, Real impulse);
  void rub(const Contact& contact, Real normal_impulse);
  Real tangential_impulse(const Contact& contact, const RealVector& tangent,
                          Real normal_impulse) const;
  bool turns(Partner partner) const;
  void kick(std::uint32_t body, const RealVector& impulse, Real rubbing, Real sign);

  const WorldSpec& spec_;
  Bodies& bodies_;
  RestContacts& rests_;
};

}  // namespace rink::physics::inline RINK_PRECISION
