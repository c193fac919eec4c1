// Settings that are right for a frictionless rink; whatever is not named here is Chipmunk's own
// default.
#include "bench/peers/chipmunk_world.h"

#include <chipmunk/chipmunk.h>

#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <limits>

#include "bench/peers/peer_world.h"

namespace rink::peers {
namespace {

constexpr cpCollisionType wall_type = 3;  ///< others have their BodyKind

cpVect to_vect(const Vector2& vector) { return cpv(vector.x(), vector.y()); }
Vector2 to_vector(const cpVect& vect) { return {vect.x, vect.y}; }

class ChipmunkWorld final : public PeerWorld {
 public:
  ChipmunkWorld(const physics::WorldSpec& spec, double dt)
      : PeerWorld(spec, dt),
        space_(cpSpaceNew()),
        elasticity_(std::sqrt(spec.restitution(0, 0))),
        bat_damping_(std::exp(-spec.bat_drag * dt)) {
    cpSpaceSetDamping(space_, std::exp(-spec.puck_drag));
    cpSpaceSetCollisionSlop(space_, 0.0);  // its default of 0.1 is in pixels
    cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space_);
    handler->beginFunc = on_begin;
    handler->userData = this;
    const double l = spec.field.length, w = spec.field.width, t = wall_thickness;
    for (const auto& [from, to] :
         std::array<std::array<cpVect, 2>, 4>{{{{{-t, -t}, {-t, w + t}}},
                                               {{{l + t, -t}, {l + t, w + t}}},
                                               {{{-t, -t}, {l + t, -t}}},
                                               {{{-t, w + t}, {l + t, w + t}}}}})
      add_shape(cpSegmentShapeNew(cpSpaceGetStaticBody(space_), from, to, t), wall_type);
  }
  ChipmunkWorld(const ChipmunkWorld&) = delete;
  ChipmunkWorld& operator=(const ChipmunkWorld&) = delete;
  ~ChipmunkWorld() override {
    for (cpShape* shape : shapes_)
      if (shape != nullptr) cpSpaceRemoveShape(space_, shape), cpShapeFree(shape);
    for (cpBody* body : bodies_)
      if (body != nullptr) free_body(body);
    cpSpaceFree(space_);
  }

 private:
  /// What a bat's own law of motion needs, since Chipmunk knows one drag for all and forgets a
  /// force after each frame.
  struct Driven {
    const ChipmunkWorld* world;
    std::size_t index;
  };

  void make(std::size_t index, const Outline& outline, const Vector2& position,
            const Vector2& velocity) override {
    assert(index == bodies_.size() && shapes_.size() == wall_count + index);
    const bool is_fixed = !std::isfinite(outline.mass);
    // An infinite moment: without friction nothing makes a body turn, and a bat must not.
    cpBody* body = is_fixed ? cpBodyNewStatic()
                            : cpBodyNew(outline.mass, std::numeric_limits<double>::infinity());
    cpBodySetPosition(body, to_vect(position));
    if (!is_fixed) cpBodySetVelocity(body, to_vect(velocity));
    cpSpaceAddBody(space_, body);
    bodies_.push_back(body);
    const Vector2 size = 2.0 * outline.half_extent;
    add_shape(outline.kind == BodyKind::bat ? cpBoxShapeNew(body, size.x(), size.y(), 0.0)
                                            : cpCircleShapeNew(body, outline.radius, cpvzero),
              static_cast<cpCollisionType>(outline.kind));
    if (outline.kind != BodyKind::bat) return;
    cpBodySetUserData(body, &driven_.emplace_back(Driven{this, index}));
    cpBodySetVelocityUpdateFunc(body, drive);
  }

  void destroy(std::size_t index) override {
    assert(index < bodies_.size() && bodies_[index] != nullptr);
    cpShape*& shape = shapes_[wall_count + index];
    cpSpaceRemoveShape(space_, shape);
    cpShapeFree(shape);
    free_body(bodies_[index]);
    shape = nullptr;
    bodies_[index] = nullptr;
  }

  Vector2 place_of(std::size_t index) const override {
    return to_vector(cpBodyGetPosition(bodies_[index]));
  }
  Vector2 velocity_of(std::size_t index) const override {
    return to_vector(cpBodyGetVelocity(bodies_[index]));
  }
  void step() override { cpSpaceStep(space_, dt()); }

  void add_shape(cpShape* shape, cpCollisionType type) {
    cpShapeSetElasticity(shape, elasticity_);  // Chipmunk multiplies the two
    cpShapeSetFriction(shape, 0.0);
    cpShapeSetCollisionType(shape, type);
    cpSpaceAddShape(space_, shape);
    shapes_.push_back(shape);
  }

  void free_body(cpBody* body) {
    cpSpaceRemoveBody(space_, body);
    cpBodyFree(body);
  }

  static void drive(cpBody* body, cpVect, cpFloat, cpFloat dt) {
    const auto& driven = *static_cast<const Driven*>(cpBodyGetUserData(body));
    assert(driven.world->bodies_[driven.index] == body);
    cpBodyUpdateVelocity(body, to_vect(driven.world->thrust_of(driven.index)),
                         driven.world->bat_damping_, dt);
  }

  static cpBool on_begin(cpArbiter* arbiter, cpSpace*, cpDataPointer self) {
    cpShape *a = nullptr, *b = nullptr;
    cpArbiterGetShapes(arbiter, &a, &b);
    const cpCollisionType first = cpShapeGetCollisionType(a), second = cpShapeGetCollisionType(b);
    auto& world = *static_cast<ChipmunkWorld*>(self);
    if (first == wall_type || second == wall_type) world.count_wall_impact();
    else world.count_impact(static_cast<BodyKind>(first), static_cast<BodyKind>(second));
    return cpTrue;
  }

  static constexpr std::size_t wall_count = 4;

  cpSpace* space_;
  double elasticity_, bat_damping_;
  std::vector<cpBody*> bodies_;
  std::vector<cpShape*> shapes_;  // the walls, then one for each body
  std::deque<Driven> driven_;     // Chipmunk holds pointers to them
};

}  // namespace

std::unique_ptr<physics::Simulator> make_chipmunk(const physics::WorldSpec& spec, double dt) {
  return std::make_unique<ChipmunkWorld>(spec, dt);
}

std::string chipmunk_version() { return cpVersionString; }

}  // namespace rink::peers
