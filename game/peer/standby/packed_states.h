// Bodies' states in few bytes: each as its difference from a body that lies still in the scene.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/validation.h"

namespace rink::peer {

/// Radius, mass, kind and the like are the scene's, and most bodies have no thrust, spin or rest
/// contact: a flying puck takes 42 to 52 bytes instead of 209. A body is number:v (less the least
/// that may come), then its changes since it lay still (state_fields.h).
class StatePacker {
 public:
  /// `scene` must outlive it.
  explicit StatePacker(const Validator& scene) : scene_(scene) {}
  /// Numbers rise from call to call.
  void add(std::uint32_t number, const BodyState& state);
  /// All bodies that were added, which are forgotten.
  std::vector<std::uint8_t> take();

 private:
  const Validator& scene_;
  std::vector<std::uint8_t> packed_;
  std::uint32_t next_ = 0;  ///< no number that comes is lower
};

/// Calls `visit` for each body, in order of numbers. False if these are not, or not all, the bytes
/// of bodies of the scene.
bool unpack(std::span<const std::uint8_t> bytes, const Validator& scene,
            const std::function<void(const Handover::Body&)>& visit);
/// All at once; nothing instead of false.
std::optional<std::vector<Handover::Body>> unpacked(std::span<const std::uint8_t> bytes,
                                                    const Validator& scene);

}  // namespace rink::peer
