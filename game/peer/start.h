// The bodies of a whole at its start, one after the other: whoever takes some of them need not have
// all in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "game/physics/world.h"

namespace rink::peer {

class Start {
 public:
  /// Body `number` of the whole is `id` in `world`, where others may be missing.
  using Visit =
      std::function<void(std::uint32_t number, const physics::World& world, physics::BodyId id)>;

  /// A whole that is in memory, and outlives this.
  Start(const physics::World& whole)
      : spec_(whole.spec()), body_count_(whole.body_count()), visit_([&whole](const Visit& visit) {
          for (std::uint32_t body = 0; body < whole.body_count(); ++body)
            visit(body, whole, {body});
        }) {}
  /// One that is made anew each time: `visit` is called for all its bodies in order of numbers.
  Start(physics::WorldSpec spec, std::uint32_t body_count,
        std::function<void(const Visit& visit)> visit)
      : spec_(std::move(spec)), body_count_(body_count), visit_(std::move(visit)) {}

  const physics::WorldSpec& spec() const { return spec_; }
  std::uint32_t body_count() const { return body_count_; }
  void visit(const Visit& visit) const { visit_(visit); }

 private:
  physics::WorldSpec spec_;
  std::uint32_t body_count_;
  std::function<void(const Visit&)> visit_;
};

}  // namespace rink::peer
