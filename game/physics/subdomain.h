// A world in which only some of the bodies are there: those of one part of the field, as worlds
// elsewhere hand them over.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/physics/bodies/before_images.h"
#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/world_mark.h"
#include "game/physics/body_slots.h"
#include "game/physics/halves/halves.h"
#include "game/physics/part_world.h"
#include "game/physics/real.h"
#include "game/physics/world.h"

namespace rink::physics::inline RINK_PRECISION {

/// So many events at one instant, wherever in the field, and the engine thinks of means beyond the
/// bodies concerned; below, they alone matter.
constexpr std::uint64_t events_at_once_local = 64;

/// No fewer than any world counts at one instant among events at these times [s], in the order in
/// which they came. Where an instant begins depends on who else is in the world: what is one
/// instant there may be the end of one and the beginning of another here.
std::uint64_t most_at_once(std::span<const double> times);

/// Bodies have the numbers that they have in the whole of `body_count`. They are put there and
/// dropped, and those that are not there take no memory (body_slots.h). What is there goes on with
/// the bits that it has in the whole, for as long as nothing that is not there would have touched
/// it. Time goes by windows, each of which can be undone.
class Subdomain {
 public:
  Subdomain(const WorldSpec& spec, std::uint32_t body_count);
  ~Subdomain();
  Subdomain(const Subdomain&) = delete;
  Subdomain& operator=(const Subdomain&) = delete;

  const PartWorld& world() const { return part_; }
  std::uint32_t body_count() const { return slots_.body_count(); }
  bool is_there(std::uint32_t body) const { return slot(body) != BodySlots::nobody; }

  BodyState state(std::uint32_t body) const { return state_in(world_, slot(body)); }
  /// Of a body of any world.
  static BodyState state_in(const World& world, std::uint32_t body);
  /// Shows in a world that is not played itself, and never will be, what others have played:
  /// from now on it is `now` [s] there, and `body` is in `state`.
  static void show_instant(World& world, double now);
  static void show(World& world, std::uint32_t body, const BodyState& state);
  /// Whether some world could have it in this state as far as flags and numbers say, in a game of
  /// `body_count` bodies. None has a body that was removed.
  static bool is_possible(const BodyState& state, std::uint32_t body_count);
  /// How long after now() BodyState::last_hop may lie, at most [s].
  static double glide_max(const WorldSpec& spec);
  static bool is_out_of_play(const BodyState& state);
  /// Whether it is in a jam, at rest or gliding.
  static bool is_frozen(const BodyState& state);
  /// Whether it is in a rest contact along axis 0 or 1.
  static bool is_held_along(const BodyState& state, int axis);
  /// As it was when the window began.
  BodyState state_before(std::uint32_t body) const { return before_->state(slot(body)); }
  /// The body's path from then to its first change.
  Motion motion_before(std::uint32_t body) const;

  const Flight& flight(std::uint32_t body) const;
  /// Whether it has changed in this window, and by nothing but free impacts, which leave all but
  /// its flight.
  bool has_flown_freely(std::uint32_t body) const { return before_->has_flown_freely(slot(body)); }
  /// Of a body in play that flies straight and has no companions; nothing of any other.
  std::optional<Flight> free_flight(std::uint32_t body) const;

  /// Whether it was out of play, or removed.
  bool was_gone(std::uint32_t body) const;

  /// Between windows: puts the body there, or in another state; or takes it away. Holds are set
  /// apart.
  void put(std::uint32_t body, const BodyState& state);
  void drop(std::uint32_t body);
  /// Between windows: as World::place, of a puck that is there.
  void place(std::uint32_t puck, const Vector2& position) {
    world_.place({slot(puck)}, position, {0.0, 0.0});
  }
  /// All rest contacts, until the next body is put also those of who was dropped; those that are
  /// set need no order, and whoever is in one must be there.
  std::vector<RestContact> rest_contacts() const;
  std::vector<RestContact> rest_contacts_before() const;
  void set_rest_contacts(std::vector<RestContact> rest_contacts);
  /// All bodies in rest contact or in one jam with `body`, directly or through others, itself
  /// first.
  std::vector<std::uint32_t> group_of(std::uint32_t body) const;

  /// From here on what happens is in the journal.
  void begin_window();
  /// Back to where the window began.
  void undo();
  const Journal& journal() const { return journal_; }
  /// Of all bodies that changed in this window, by slot; and who is in a slot.
  const BeforeImages& before() const { return *before_; }
  std::uint32_t number_of(std::uint32_t slot) const { return slots_.number_of(slot); }
  /// Free impacts of who stays in one of these rooms until `until` [s], if nothing else happens to
  /// it, are counted only.
  void set_rooms(std::vector<Journal::Room> rooms, double until) {
    journal_.rooms = std::move(rooms), journal_.quiet_until = until;
  }
  /// 1 + the room in which the body is; 0: all is entered that happens to it. Nothing for one that
  /// is not there.
  void set_room(std::uint32_t body, std::uint8_t room) {
    if (const std::uint32_t place = slot(body); place != BodySlots::nobody)
      journal_.rooms_of[place] = room;
  }
  /// Bodies of which something was entered, so that they have no room any more, since the last
  /// call.
  std::vector<std::uint32_t> take_entered() { return std::exchange(journal_.entered, {}); }

  /// As of World: an event of `body`, and time. Goals end no call.
  void set_thrust(std::uint32_t bat, const Vector2& acceleration) {
    world_.set_thrust({slot(bat)}, acceleration);
  }
  void advance(double until);
  /// The same, for who follows the pucks' halves, of which no stay may end before (asserted).
  void advance(double until, Halves& halves);

 private:
  friend class MotionGrid;
  Engine& engine() const { return *world_.engine_; }
  std::uint32_t slot(std::uint32_t body) const { return slots_.slot_of(body); }
  void observe();
  std::uint32_t make_room(std::uint32_t body);
  void spread(std::uint32_t body);

  BodySlots slots_;
  World world_;
  PartWorld part_;
  std::optional<BeforeImages> before_;  ///< of the engine in `world_`, which spread() makes anew
  Journal journal_;
  WorldMark mark_;            ///< when the window began
  bool has_dropped_ = false;  ///< since the last body was put into a blank slot
};

/// World::hash() of the larger world, if all of it that is not removed is there.
std::uint64_t hash_of(const Subdomain& part);

/// So that the body is in no rest contact along axis 0 or 1 any more.
void release(BodyState& state, int axis);

}  // namespace rink::physics::inline RINK_PRECISION
