// Settings that are right for a frictionless rink; whatever is not named here is Box2D's own
// default or its manual's advice.
#include "bench/peers/box2d_world.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "bench/peers/peer_world.h"

namespace rink::peers {
namespace {

constexpr int velocity_iterations = 8, position_iterations = 3;  // the manual's advice
constexpr std::uintptr_t wall_kind = 3;                          ///< others have their BodyKind

/// Box2D lets bodies lie 5 mm in each other, looks for partners 0.1 m around and is made for bodies
/// of 0.1 to 10 m, and a puck has a radius of 0.04 m. So Box2D's metre is as small as a puck is
/// large, unless a body at `speed_max` would then move by the 2 m and more that Box2D cuts off each
/// step's way at.
double units_per_metre(double speed_max, double dt) {
  assert(speed_max > 0.0 && dt > 0.0);
  return std::min(25.0, b2_maxTranslation / (speed_max * dt));
}

class Box2dWorld final : public PeerWorld, private b2ContactListener {
 public:
  Box2dWorld(const physics::WorldSpec& spec, bool are_bullets, double dt, double speed_max)
      : PeerWorld(spec, dt),
        units_(units_per_metre(speed_max, dt)),
        world_(b2Vec2(0.0f, 0.0f)),
        middle_(0.5 * spec.field.length, 0.5 * spec.field.width),
        are_bullets_(are_bullets) {
    world_.SetContinuousPhysics(are_bullets);
    world_.SetAllowSleeping(false);
    world_.SetContactListener(this);
    const double l = spec.field.length, w = spec.field.width, t = wall_thickness;
    const b2BodyDef ground_definition;
    b2Body* ground = world_.CreateBody(&ground_definition);
    struct Wall {
      Vector2 centre, half_extent;
    };
    for (const Wall& wall : std::array<Wall, 4>{{{{-t, w / 2}, {t, w / 2 + 2 * t}},
                                                 {{l + t, w / 2}, {t, w / 2 + 2 * t}},
                                                 {{l / 2, -t}, {l / 2 + 2 * t, t}},
                                                 {{l / 2, w + t}, {l / 2 + 2 * t, t}}}}) {
      const b2PolygonShape shape = box(wall.half_extent, wall.centre - middle_);
      add_shape(*ground, shape, 0.0, wall_kind);
    }
  }

 private:
  b2Vec2 to_box2d(const Vector2& vector) const {
    return {to_box2d(vector.x()), to_box2d(vector.y())};
  }
  float to_box2d(double length) const { return static_cast<float>(length * units_); }
  Vector2 to_vector(const b2Vec2& vector) const { return Vector2(vector.x, vector.y) / units_; }
  /// That Box2D grows polygons by [m].
  double skin() const { return b2_polygonRadius / units_; }

  /// Less its skin, so that contact is where it is on the rink.
  b2PolygonShape box(const Vector2& half_extent, const Vector2& centre = {0.0, 0.0}) const {
    assert(half_extent.minCoeff() > skin());
    b2PolygonShape shape;
    shape.SetAsBox(to_box2d(half_extent.x() - skin()), to_box2d(half_extent.y() - skin()),
                   to_box2d(centre), 0.0f);
    return shape;
  }

  void make(std::size_t, const Outline& outline, const Vector2& position,
            const Vector2& velocity) override {
    const bool is_fixed = !std::isfinite(outline.mass);
    b2BodyDef definition;
    definition.type = is_fixed ? b2_staticBody : b2_dynamicBody;
    definition.position = to_box2d(position - middle_);
    definition.linearVelocity = to_box2d(velocity);
    definition.linearDamping = static_cast<float>(drag_of(outline.kind));
    definition.fixedRotation = true;
    definition.bullet = are_bullets_ && !is_fixed;
    b2Body* body = world_.CreateBody(&definition);
    assert(is_fixed || outline.mass > 0.0);
    bodies_.push_back(body);
    if (outline.kind == BodyKind::bat) {
      add_shape(*body, box(outline.half_extent),
                outline.mass / (4.0 * (outline.half_extent.array() - skin()).prod()),
                static_cast<std::uintptr_t>(outline.kind));
      driven_.push_back({bodies_.size() - 1, outline.mass});
      return;
    }
    b2CircleShape disc;
    disc.m_radius = to_box2d(outline.radius);
    add_shape(*body, disc,
              is_fixed ? 0.0 : outline.mass / (std::numbers::pi * outline.radius * outline.radius),
              static_cast<std::uintptr_t>(outline.kind));
  }

  /// `density` in kg/m^2 of the rink.
  void add_shape(b2Body& body, const b2Shape& shape, double density, std::uintptr_t kind) {
    b2FixtureDef definition;
    definition.shape = &shape;
    definition.density = static_cast<float>(density / (units_ * units_));
    definition.friction = 0.0f;
    definition.restitution = static_cast<float>(spec().restitution(0, 0));
    definition.restitutionThreshold = 0.0f;
    definition.userData.pointer = kind;
    body.CreateFixture(&definition);
  }

  void destroy(std::size_t index) override {
    assert(index < bodies_.size());
    world_.DestroyBody(bodies_[index]);
    std::erase_if(driven_, [index](const Driven& bat) { return bat.index == index; });
  }
  Vector2 place_of(std::size_t index) const override {
    return to_vector(bodies_[index]->GetPosition()) + middle_;
  }
  Vector2 velocity_of(std::size_t index) const override {
    return to_vector(bodies_[index]->GetLinearVelocity());
  }

  void step() override {
    for (const Driven& bat : driven_)
      if (!thrust_of(bat.index).isZero(0.0))
        bodies_[bat.index]->ApplyForceToCenter(to_box2d(bat.mass * thrust_of(bat.index)), true);
    world_.Step(static_cast<float>(dt()), velocity_iterations, position_iterations);
  }

  void BeginContact(b2Contact* contact) override {
    const std::uintptr_t a = contact->GetFixtureA()->GetUserData().pointer,
                         b = contact->GetFixtureB()->GetUserData().pointer;
    if (a == wall_kind || b == wall_kind) count_wall_impact();
    else count_impact(static_cast<BodyKind>(a), static_cast<BodyKind>(b));
  }

  struct Driven {
    std::size_t index;
    double mass;
  };

  double units_;  // of Box2D in a metre
  b2World world_;
  Vector2 middle_;  // of the field, where Box2D's origin is: floats are finest there [m]
  bool are_bullets_;
  std::vector<b2Body*> bodies_;
  std::vector<Driven> driven_;
};

}  // namespace

std::unique_ptr<physics::Simulator> make_box2d(const physics::WorldSpec& spec, bool are_bullets,
                                               double dt, double speed_max) {
  return std::make_unique<Box2dWorld>(spec, are_bullets, dt, speed_max);
}

std::string box2d_version() {
  return std::to_string(b2_version.major) + "." + std::to_string(b2_version.minor) + "." +
         std::to_string(b2_version.revision);
}

}  // namespace rink::peers
