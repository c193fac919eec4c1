// Rest contacts: bodies pressed together along an axis share velocity and acceleration along it,
// and have no events until something changes.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body_state.h"
#include "game/physics/engine/friction.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Bodies in rest contact along an axis, directly or through others, are a group of it.
class RestContacts {
 public:
  RestContacts(const WorldSpec& spec, Bodies& bodies, Jams& jams, EventRecord& record,
               const Observers& observers);
  RestContacts(const RestContacts&) = delete;
  RestContacts& operator=(const RestContacts&) = delete;

  /// A body has come into the world, without contacts.
  void add(std::uint32_t body) { friction_.slide(body, std::nullopt); }
  const std::vector<RestContact>& rest_contacts() const { return rest_contacts_; }
  void restore(std::vector<RestContact> rest_contacts) {
    assert(std::all_of(rest_contacts.begin(), rest_contacts.end(),
                       [](const RestContact& rest) { return rest.axis == 0 || rest.axis == 1; }));
    rest_contacts_ = std::move(rest_contacts);
  }

  bool are_joined(std::uint32_t a, std::uint32_t b) const;
  /// The bodies in rest contact with `body`, directly or through others, along any of `axes`
  /// (Body::held); itself first. Fixed partners are not among them.
  std::vector<std::uint32_t> group(std::uint32_t body, std::uint8_t axes) const;
  /// Bodies in rest contact keep bitwise equal velocities only if they are evaluated from the same
  /// instant, so they are rebased together.
  void rebase_group(std::uint32_t body, Real time);

  /// Before something befalls the body: it is in no jam any more, and its groups are rebased.
  void rouse(std::uint32_t body, Real time) {
    jams_.wake(body, time);
    rebase_group(body, time);
  }
  /// Before it goes its own way: it is rebased, and in no jam or rest contact any more. Who is due
  /// to hit it looks anew.
  void free(std::uint32_t body, Real time);

  bool can_join(const Contact& contact) const;
  /// Perfectly inelastic along the axis of the face: the groups on both sides become one.
  void join(const Contact& contact, Real time);
  /// Ends every rest contact of the group of `body` along `axis`; each member goes on with the
  /// common velocity and its own thrust and drag.
  void dissolve(std::uint32_t body, int axis, Real time);
  /// Shares what acts on the group of `body` anew, along an axis along which it is held.
  void share(std::uint32_t body, int axis, Real time) {
    assert(bodies_[body].is(Body::held_along(axis)));
    share(axis, group(body, Body::held_along(axis)), time);
  }
  /// The law of friction for everything that the event at hand touched. Groups that push a puck
  /// come first, for they may let it go.
  void push_again();

  /// Calls `visit(time)` for each time at which a rest contact of the body ends, or friction in its
  /// group is to be aimed anew [s]; infinite if never.
  template <class Visit>
  void for_each_end(std::uint32_t body, Visit&& visit) const {
    for (const RestContact& rest : rest_contacts_)
      if (rest.low == body || rest.high == body)
        visit(std::min({rest.pull_time, rest.turn_time, slide_time(rest)}));
  }
  /// The rest contacts of `body` that end at `time` do so; or the friction in its group is aimed
  /// anew.
  void release(std::uint32_t body, Real time);

 private:
  void share(int axis, const std::vector<std::uint32_t>& members, Real time);
  void let_go_what_is_pulled(int axis, const std::vector<std::uint32_t>& members, Real time);
  void share_part(int axis, const std::vector<std::uint32_t>& part, Real time);
  void solve_forces(int axis, const std::vector<std::uint32_t>& members, Real speed,
                    bool only_push);
  Real sweep_forces(int axis, const std::vector<std::uint32_t>& members, bool only_push);
  void set_pull_times(int axis, const std::vector<std::uint32_t>& part, Real terminal_speed,
                      Real drag, Real time);
  bool is_in_group(const RestContact& rest, int axis,
                   const std::vector<std::uint32_t>& members) const;
  bool is_group_fixed(int axis, const std::vector<std::uint32_t>& members) const;
  std::optional<int> pushed_axis(std::uint32_t body) const;
  bool is_pushed_twice(int axis, const std::vector<std::uint32_t>& members) const;
  bool would_push_twice(const Contact& contact) const;
  Real slide_time(const RestContact& rest) const;
  void note_release(const RestContact& rest, Real time);
  void dissolve_around(std::uint32_t post, Real time);

  Bodies& bodies_;
  Friction friction_;
  Jams& jams_;
  EventRecord& record_;
  const Observers& observers_;
  Real tolerance_, contact_time_;
  std::vector<RestContact> rest_contacts_;
  std::vector<Real> accelerations_;  // by body, of the problem at hand [m/s^2]
};

}  // namespace rink::physics::inline RINK_PRECISION
