// The exact engine in extended precision, beside the one in double: the truth to judge that by.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "game/physics/body.h"
#include "game/physics/counters.h"

namespace rink::physics {

using ExtendedVector = Eigen::Matrix<long double, 2, 1>;

/// A World (world.h) of the same sources compiled with long double as their scalar: on x86 64 bits
/// of mantissa, eleven more. Every function is that of World with its name.
class ExtendedWorld {
 public:
  explicit ExtendedWorld(const WorldSpec& spec);
  ~ExtendedWorld();
  ExtendedWorld(ExtendedWorld&&) noexcept;
  ExtendedWorld& operator=(ExtendedWorld&&) noexcept;

  BodyId add(const PuckSpec& spec);
  BodyId add(const BatSpec& spec);
  BodyId add(const PostSpec& spec);
  void set_thrust(BodyId bat, const Vector2& acceleration);
  /// Answers who scored.
  std::optional<BodyId> advance(long double until);

  std::uint32_t body_count() const;
  ExtendedVector position(BodyId body) const;
  bool is_free(const Vector2& centre, double radius) const;
  const Counters& counters() const;
  std::uint64_t hash() const;

  std::vector<std::uint8_t> save() const;
  static std::optional<ExtendedWorld> restore(std::span<const std::uint8_t> bytes);

 private:
  struct Inside;
  explicit ExtendedWorld(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace rink::physics
