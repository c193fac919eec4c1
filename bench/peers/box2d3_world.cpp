// Settings that are right for a frictionless rink; whatever is not named here is the default of
// Box2D v3.1 or its manual's advice.
#include "bench/peers/box2d3_world.h"

#include <box2d/box2d.h>

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "bench/peers/peer_world.h"

namespace rink::peers {
namespace {

/// Box2D leaves overlaps of 5 mm of its own, so its metre is smaller; at 25 in a metre, as for 2.4,
/// it takes a fifth longer to err by as little, at 1 substep half as long again.
constexpr double units_per_metre = 10.0;
constexpr int substeps = 4;              // the manual's advice
constexpr std::uintptr_t wall_kind = 3;  ///< others have their BodyKind

class Box2d3World final : public PeerWorld {
 public:
  Box2d3World(const physics::WorldSpec& spec, double dt, double speed_max)
      : PeerWorld(spec, dt), middle_(0.5 * spec.field.length, 0.5 * spec.field.width) {
    b2WorldDef definition = b2DefaultWorldDef();
    definition.gravity = {0.0f, 0.0f};
    definition.restitutionThreshold = 0.0f;
    definition.enableSleep = false;
    world_ = b2CreateWorld(&definition);
    b2World_SetMaximumLinearSpeed(world_, to_box2d(2.0 * speed_max));
    const b2BodyDef ground_definition = b2DefaultBodyDef();
    const b2BodyId ground = b2CreateBody(world_, &ground_definition);
    const double l = spec.field.length, w = spec.field.width, t = wall_thickness;
    struct Wall {
      Vector2 centre, half_extent;
    };
    for (const Wall& wall : std::array<Wall, 4>{{{{-t, w / 2}, {t, w / 2 + 2 * t}},
                                                 {{l + t, w / 2}, {t, w / 2 + 2 * t}},
                                                 {{l / 2, -t}, {l / 2 + 2 * t, t}},
                                                 {{l / 2, w + t}, {l / 2 + 2 * t, t}}}}) {
      const b2ShapeDef shape = shape_of(wall_kind);
      const b2Polygon box =
          b2MakeOffsetBox(to_box2d(wall.half_extent.x()), to_box2d(wall.half_extent.y()),
                          to_box2d(wall.centre - middle_), b2Rot_identity);
      b2CreatePolygonShape(ground, &shape, &box);
    }
  }
  Box2d3World(const Box2d3World&) = delete;
  Box2d3World& operator=(const Box2d3World&) = delete;
  ~Box2d3World() override { b2DestroyWorld(world_); }

 private:
  static float to_box2d(double length) { return static_cast<float>(length * units_per_metre); }
  static b2Vec2 to_box2d(const Vector2& vector) {
    return {to_box2d(vector.x()), to_box2d(vector.y())};
  }
  template <class Vector>
  static Vector2 to_vector(const Vector& vector) {
    return Vector2(vector.x, vector.y) / units_per_metre;
  }

  b2ShapeDef shape_of(std::uintptr_t kind) const {
    b2ShapeDef definition = b2DefaultShapeDef();
    definition.material.friction = 0.0f;
    definition.material.restitution = static_cast<float>(spec().restitution(0, 0));
    definition.enableContactEvents = true;
    definition.userData = reinterpret_cast<void*>(kind);
    return definition;
  }

  void make(std::size_t, const Outline& outline, const Vector2& position,
            const Vector2& velocity) override {
    const bool is_fixed = !std::isfinite(outline.mass);
    b2BodyDef definition = b2DefaultBodyDef();
    definition.type = is_fixed ? b2_staticBody : b2_dynamicBody;
    definition.position = to_box2d(position - middle_);
    definition.linearVelocity = to_box2d(velocity);
    definition.linearDamping = static_cast<float>(drag_of(outline.kind));
    const b2BodyId body = b2CreateBody(world_, &definition);
    const b2ShapeDef shape = shape_of(static_cast<std::uintptr_t>(outline.kind));
    if (outline.kind == BodyKind::bat) {
      const b2Polygon box =
          b2MakeBox(to_box2d(outline.half_extent.x()), to_box2d(outline.half_extent.y()));
      b2CreatePolygonShape(body, &shape, &box);
      driven_.push_back({bodies_.size(), outline.mass});
    } else {
      const b2Circle disc{{0.0f, 0.0f}, to_box2d(outline.radius)};
      b2CreateCircleShape(body, &shape, &disc);
    }
    // Without a moment of inertia nothing turns, in whichever way a version says that.
    if (!is_fixed) b2Body_SetMassData(body, {static_cast<float>(outline.mass), {0.0f, 0.0f}, 0.0f});
    bodies_.push_back(body);
  }

  void destroy(std::size_t index) override {
    assert(index < bodies_.size());
    b2DestroyBody(bodies_[index]);
    std::erase_if(driven_, [index](const Driven& bat) { return bat.index == index; });
  }
  Vector2 place_of(std::size_t index) const override {
    return to_vector(b2Body_GetPosition(bodies_[index])) + middle_;
  }
  Vector2 velocity_of(std::size_t index) const override {
    return to_vector(b2Body_GetLinearVelocity(bodies_[index]));
  }

  void step() override {
    for (const Driven& bat : driven_)
      if (!thrust_of(bat.index).isZero(0.0))
        b2Body_ApplyForceToCenter(bodies_[bat.index], to_box2d(bat.mass * thrust_of(bat.index)),
                                  true);
    b2World_Step(world_, static_cast<float>(dt()), substeps);
    const b2ContactEvents events = b2World_GetContactEvents(world_);
    for (int k = 0; k < events.beginCount; ++k) {
      const std::uintptr_t a = kind_of(events.beginEvents[k].shapeIdA),
                           b = kind_of(events.beginEvents[k].shapeIdB);
      if (a == wall_kind || b == wall_kind) count_wall_impact();
      else count_impact(static_cast<BodyKind>(a), static_cast<BodyKind>(b));
    }
  }
  static std::uintptr_t kind_of(b2ShapeId shape) {
    return reinterpret_cast<std::uintptr_t>(b2Shape_GetUserData(shape));
  }

  struct Driven {
    std::size_t index;
    double mass;
  };

  Vector2 middle_;  // of the field, where Box2D's origin is: floats are finest there [m]
  b2WorldId world_{};
  std::vector<b2BodyId> bodies_;
  std::vector<Driven> driven_;
};

}  // namespace

std::unique_ptr<physics::Simulator> make_box2d3(const physics::WorldSpec& spec, double dt,
                                                double speed_max) {
  return std::make_unique<Box2d3World>(spec, dt, speed_max);
}

std::string box2d3_version() {
  const b2Version version = b2GetVersion();
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.revision);
}

}  // namespace rink::peers
