// Keeps the lists of own bodies and ghosts in step with the roles.
#include "game/peer/window/roles.h"

#include <functional>

namespace rink::peer {

Roles::Roles(std::uint32_t body_count) : roles_(body_count, Role::away), details_(body_count, 0) {}

void Roles::own(std::uint32_t body) {
  assert(of(body) == Role::away);
  roles_[body] = Role::own;
  details_[body] = static_cast<std::uint32_t>(owned_.size());
  owned_.push_back(body);
}

void Roles::disown(std::uint32_t body) {
  assert(owns(body));
  roles_[body] = Role::away;
  const std::uint32_t place = details_[body], last = owned_.back();
  assert(place < owned_.size() && owned_[place] == body);
  owned_[place] = last, details_[last] = place;
  owned_.pop_back();
}

void Roles::add_ghost(std::uint32_t body, PeerNumber owner) {
  assert(of(body) == Role::away);
  roles_[body] = Role::ghost, details_[body] = owner;
  if (ghosts_.empty() || ghosts_.back() < body) ghosts_.push_back(body);
  else ghosts_.insert(std::ranges::upper_bound(ghosts_, body), body);
}

void Roles::remove_ghost(std::uint32_t body) {
  ghosts_.erase(ghosts_.begin() + static_cast<std::ptrdiff_t>(place_of_ghost(body)));
  roles_[body] = Role::away;
}

void Roles::clear_ghosts() {
  for (const std::uint32_t body : ghosts_) roles_[body] = Role::away;
  ghosts_.clear();
}

void Roles::check() const {
  for (std::size_t place = 0; place < owned_.size(); ++place)
    assert(owns(owned_[place]) && details_[owned_[place]] == place);
  assert(std::ranges::adjacent_find(ghosts_, std::greater_equal<>()) == ghosts_.end());
  assert(std::ranges::all_of(ghosts_, [this](std::uint32_t body) { return has_ghost(body); }));
  [[maybe_unused]] const auto with = [this](Role role) {
    return static_cast<std::size_t>(std::ranges::count(roles_, role));
  };
  assert(with(Role::own) == owned_.size() && with(Role::ghost) == ghosts_.size());
}

}  // namespace rink::peer
