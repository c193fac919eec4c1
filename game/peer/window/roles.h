// Which bodies a peer owns, and which it has as ghosts of other owners.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "game/peer/division.h"

namespace rink::peer {

enum class Role : std::uint8_t { away, ghost, own };

/// Every body has one role; at first all are away.
class Roles {
 public:
  explicit Roles(std::uint32_t body_count);

  std::uint32_t body_count() const { return static_cast<std::uint32_t>(roles_.size()); }
  Role of(std::uint32_t body) const {
    assert(body < roles_.size());
    return roles_[body];
  }
  bool owns(std::uint32_t body) const { return of(body) == Role::own; }
  bool has_ghost(std::uint32_t body) const { return of(body) == Role::ghost; }
  bool has_ghost_of(PeerNumber owner, std::uint32_t body) const {
    return has_ghost(body) && details_[body] == owner;
  }
  PeerNumber owner_of_ghost(std::uint32_t body) const {
    assert(has_ghost(body));
    return details_[body];
  }
  /// In the order in which they came, but for gaps that the last ones have filled.
  const std::vector<std::uint32_t>& owned() const { return owned_; }
  /// By number.
  const std::vector<std::uint32_t>& ghosts() const { return ghosts_; }
  /// The place of a ghost in `ghosts`.
  std::size_t place_of_ghost(std::uint32_t body) const {
    assert(has_ghost(body));
    return static_cast<std::size_t>(std::ranges::lower_bound(ghosts_, body) - ghosts_.begin());
  }

  void own(std::uint32_t body);
  void disown(std::uint32_t body);
  void add_ghost(std::uint32_t body, PeerNumber owner);
  void remove_ghost(std::uint32_t body);
  void clear_ghosts();

  /// Asserts that lists of own bodies and ghosts have those of that role, each once.
  void check() const;

 private:
  std::vector<Role> roles_;
  std::vector<std::uint32_t> owned_, ghosts_;
  std::vector<std::uint32_t> details_;  ///< by body: of an own one its place in `owned_`, of a
                                        ///< ghost its owner
};

}  // namespace rink::peer
