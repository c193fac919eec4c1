// A peer's own bodies and ghosts in a subdomain, and which of the own ones others have.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/peer/box.h"
#include "game/peer/messages.h"
#include "game/peer/window/halos.h"
#include "game/peer/window/roles.h"
#include "game/physics/subdomain.h"

namespace rink::peer {

/// What a body takes up, with its companions in rest contact.
struct Reach {
  std::uint32_t body;
  Box box;
};

/// The bodies of a decision about owners, by number: those that are own from now on; of these,
/// those that came; and those that went to another owner.
struct Settlement {
  std::vector<std::uint32_t> own{}, came{}, left{};
};

/// These contacts between bodies that are there, each once, in the order in which they are set.
std::vector<RestContact> sound_contacts(std::vector<RestContact> rest_contacts,
                                        const physics::Subdomain& there);

class Share {
 public:
  Share(const physics::WorldSpec& spec, std::uint32_t body_count, PeerNumber peer_count);

  const physics::Subdomain& subdomain() const { return subdomain_; }
  const physics::PartWorld& world() const { return subdomain_.world(); }
  BodyState state(std::uint32_t body) const { return subdomain_.state(body); }
  const Roles& roles() const { return roles_; }
  bool owns(std::uint32_t body) const { return roles_.owns(body); }
  Vector2 extent_of(std::uint32_t body) const { return world().half_extent({body}); }
  /// The widest of all bodies that were here, or may come [m].
  double extent_max() const { return extent_max_; }
  /// Where the body was at the window's `start` [s].
  Vector2 start_place(std::uint32_t body, double start) const;
  Box reach_of(std::uint32_t body) const;
  Box start_reach(std::uint32_t body, double start) const;
  /// Own bodies with companions, at the window's start.
  const std::vector<Reach>& groups() const { return groups_; }

  /// Which of the own bodies `peer` has, at the window's start, by number.
  const std::vector<std::uint32_t>& known(PeerNumber peer) const {
    assert(peer < known_.size());
    return known_[peer];
  }
  bool knows(PeerNumber peer, std::uint32_t body) const;
  /// Which it will have in the next window, by number, as its own or as ghosts.
  const std::vector<std::uint32_t>& coming(PeerNumber peer) const {
    assert(peer < coming_.size());
    return coming_[peer];
  }
  bool will_have(PeerNumber peer, std::uint32_t body) const;

  /// Adds the body, or changes its state; `settle` or `add_ghost` gives it a role.
  void put(std::uint32_t body, const BodyState& state);
  /// Counts a body that stays elsewhere among those that may come.
  void note_extent(const BodyState& state) {
    extent_max_ = std::max(extent_max_, state.extent().maxCoeff());
  }
  void add_ghost(std::uint32_t body, PeerNumber owner) { roles_.add_ghost(body, owner); }
  /// A ghost that is not what its owner says has its old state if it is unmoved; all others are
  /// sent anew, or are gone.
  void correct(std::uint32_t ghost, bool is_unmoved);
  /// Sets each contact once, and only between present bodies.
  void set_rest_contacts(std::vector<RestContact> rest_contacts);
  /// All contacts of own bodies.
  std::vector<RestContact> own_rest_contacts() const;
  /// Decides the owners from now on, the ghosts here, and the peers with ghosts of own bodies. Own
  /// bodies that are no candidates stay, and nobody has ghosts of them.
  Settlement settle(std::vector<std::uint32_t> candidates, const Halos& halos);
  /// Puts a puck, with its owner's state, at `place`, which touches nothing: one that has scored,
  /// or, of a share that is the whole, one in play.
  Settlement put_back(const Handover::Body& scored, const Vector2& place, const Halos& halos);
  /// `peer` gets these own bodies for this window, too; or will have all of these in the next one.
  void tell(PeerNumber peer, std::span<const std::uint32_t> bodies);
  void expect(PeerNumber peer, std::vector<std::uint32_t> bodies);
  void make_room(PeerNumber peer_count);

  void begin_window() { subdomain_.begin_window(); }
  void undo() { subdomain_.undo(); }
  /// Of a share that is the whole: follows the pucks' halves from what `halves` says of the
  /// window's start; halves() then says it of its end.
  void follow(const physics::Halves& halves) { halves_before_ = halves; }
  const physics::Halves& halves() const { return halves_; }
  /// The keys, by time, take effect.
  void play(std::span<const Key> keys, double until);

  /// Between windows: notes from here on who is put, put back or dropped.
  void note_touched() { notes_touched_ = true, touched_.clear(); }
  /// Those that were since the last call, in no order, some of them more than once.
  std::vector<std::uint32_t> take_touched() { return std::exchange(touched_, {}); }

  /// As Subdomain's.
  std::vector<std::uint32_t> take_entered() { return subdomain_.take_entered(); }
  void set_room(std::uint32_t body, std::uint8_t room) { subdomain_.set_room(body, room); }
  void set_rooms(std::vector<physics::Journal::Room> rooms, double until) {
    subdomain_.set_rooms(std::move(rooms), until);
  }

  /// Asserts that own bodies and ghosts are there, and that others have own bodies only.
  void check(PeerNumber number) const;

 private:
  void touch(std::uint32_t body) {
    if (notes_touched_) touched_.push_back(body);
  }
  void drop(std::uint32_t body) { touch(body), subdomain_.drop(body); }
  void find_owner(std::uint32_t body, const Vector2& place, const Box& reach, const Halos& halos,
                  Settlement& settled);

  physics::Subdomain subdomain_;
  Roles roles_;
  double extent_max_ = 0.0;
  std::vector<Reach> groups_;
  std::vector<std::uint32_t> touched_;
  bool notes_touched_ = false;
  physics::Halves halves_before_, halves_;
  std::vector<std::vector<std::uint32_t>> known_, coming_;  ///< by peer
};

}  // namespace rink::peer
