// The kinds of bodies that are relevant to all, wherever they are, as the scheme `always` lets them
// through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "game/model/scene.h"

namespace rink::game {

class RelevantKinds {
 public:
  void add(physics::BodyKind kind) { has_[static_cast<std::size_t>(kind)] = true; }
  bool has(physics::BodyKind kind) const { return has_[static_cast<std::size_t>(kind)]; }
  /// Bit k: kind k.
  static constexpr std::uint8_t bits_max = 7;
  std::uint8_t bits() const {
    return static_cast<std::uint8_t>(has_[0] | has_[1] << 1 | has_[2] << 2);
  }
  static RelevantKinds of_bits(std::uint8_t bits) {
    RelevantKinds kinds;
    for (std::size_t kind = 0; kind < kinds.has_.size(); ++kind)
      kinds.has_[kind] = (bits >> kind & 1) != 0;
    return kinds;
  }

 private:
  std::array<bool, 3> has_{};
};

/// Their names, by number.
inline const std::vector<std::string> relevant_kind_names{"puck", "bat", "post"};

/// The default for `scene`: posts, which never move, and the pucks of a match that ends at a number
/// of goals.
inline RelevantKinds relevant_kinds_of(const Scene& scene) {
  RelevantKinds kinds;
  kinds.add(physics::BodyKind::post);
  if (scene.rules.goals_to_win) kinds.add(physics::BodyKind::puck);
  return kinds;
}

/// The kinds called `names`, or the default for `scene` if there are none.
inline RelevantKinds relevant_kinds_of(const Scene& scene, const std::vector<std::string>& names) {
  if (names.empty()) return relevant_kinds_of(scene);
  RelevantKinds kinds;
  for (std::size_t kind = 0; kind < relevant_kind_names.size(); ++kind)
    for (const std::string& name : names)
      if (name == relevant_kind_names[kind]) kinds.add(static_cast<physics::BodyKind>(kind));
  return kinds;
}

}  // namespace rink::game
