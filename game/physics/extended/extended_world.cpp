// Compiled with RINK_EXTENDED_PRECISION, where World counts in long double.
#include "game/physics/extended/extended_world.h"

#include <type_traits>
#include <utility>

#include "game/physics/world.h"

namespace rink::physics {

static_assert(std::is_same_v<Real, long double>);

struct ExtendedWorld::Inside {
  explicit Inside(World begun) : world(std::move(begun)) {}
  World world;
};

ExtendedWorld::ExtendedWorld(const WorldSpec& spec)
    : ExtendedWorld(std::make_unique<Inside>(World(spec))) {}
ExtendedWorld::ExtendedWorld(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
ExtendedWorld::~ExtendedWorld() = default;
ExtendedWorld::ExtendedWorld(ExtendedWorld&&) noexcept = default;
ExtendedWorld& ExtendedWorld::operator=(ExtendedWorld&&) noexcept = default;

BodyId ExtendedWorld::add(const PuckSpec& spec) { return inside_->world.add(spec); }
BodyId ExtendedWorld::add(const BatSpec& spec) { return inside_->world.add(spec); }
BodyId ExtendedWorld::add(const PostSpec& spec) { return inside_->world.add(spec); }
void ExtendedWorld::set_thrust(BodyId bat, const Vector2& acceleration) {
  inside_->world.set_thrust(bat, acceleration);
}
std::optional<BodyId> ExtendedWorld::advance(long double until) {
  const std::optional<Goal> goal = inside_->world.advance(until);
  return goal ? std::optional(goal->puck) : std::nullopt;
}

std::uint32_t ExtendedWorld::body_count() const { return inside_->world.body_count(); }
ExtendedVector ExtendedWorld::position(BodyId body) const { return inside_->world.position(body); }
bool ExtendedWorld::is_free(const Vector2& centre, double radius) const {
  return inside_->world.is_free(centre, radius);
}
const Counters& ExtendedWorld::counters() const { return inside_->world.counters(); }
std::uint64_t ExtendedWorld::hash() const { return inside_->world.hash(); }

std::vector<std::uint8_t> ExtendedWorld::save() const { return inside_->world.save(); }
std::optional<ExtendedWorld> ExtendedWorld::restore(std::span<const std::uint8_t> bytes) {
  std::optional<World> world = World::restore(bytes);
  if (!world) return std::nullopt;
  return ExtendedWorld(std::make_unique<Inside>(std::move(*world)));
}

}  // namespace rink::physics
