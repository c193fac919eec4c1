// What the stepped engines share: bodies that an integrator carries through frames of fixed length,
// the answers to all questions, and impulses.
#pragma once

#include <limits>
#include <vector>

#include "game/physics/bodies/event_record.h"
#include "game/physics/paper/frame_grid.h"
#include "game/physics/paper/frame_impact.h"
#include "game/physics/paper/frame_steps.h"
#include "game/physics/simulator.h"

namespace rink::physics::paper {

/// Frame k lasts from k dt to (k + 1) dt, whoever asks what in between: questions within a frame
/// are answered by a shorter step from the body's last state and change nothing. A key within a
/// frame takes effect at its own instant: from there its bat, and nobody else, is stepped anew.
/// Method and errors: docs/paper-engine.md.
class FrameSimulator : public Simulator {
 public:
  BodyId add(const PuckSpec& spec) override;
  BodyId add(const BatSpec& spec) override;
  BodyId add(const PostSpec& spec) override;
  void remove(BodyId body) override;
  void set_thrust(BodyId bat, const Vector2& acceleration) override;
  void place(BodyId puck, const Vector2& position, const Vector2& velocity) override;
  std::optional<Goal> advance(double until) override;

  void record_events(bool is_wanted) override { record_.keep(is_wanted); }
  std::span<const Event> events() const override { return record_.events(); }
  void forget_events() override { record_.forget(); }

  const WorldSpec& spec() const override { return spec_; }
  double now() const override { return now_; }
  std::uint32_t body_count() const override { return static_cast<std::uint32_t>(bodies_.size()); }
  BodyKind kind(BodyId body) const override { return bodies_[body.index].kind; }
  double radius(BodyId body) const override { return bodies_[body.index].radius; }
  Vector2 half_extent(BodyId body) const override { return bodies_[body.index].extent(); }
  double mass(BodyId body) const override { return bodies_[body.index].mass; }
  bool is_in_play(BodyId body) const override { return bodies_[body.index].is_in_play; }
  Vector2 position(BodyId body) const override {
    return steps_.phase_at(bodies_[body.index], now_).position;
  }
  Vector2 velocity(BodyId body) const override {
    return steps_.phase_at(bodies_[body.index], now_).velocity;
  }
  bool is_free(const Vector2& centre, double radius) const override;
  bool is_free(const Vector2& centre, const Vector2& half_extent) const override;

  const Counters& counters() const override { return record_.counters(); }
  double spin(BodyId body) const override { return bodies_[body.index].spin; }
  double kinetic_energy() const override;
  double energy_introduced() const override { return spec_.accounts_energy ? introduced_ : 0.0; }
  double work_of_thrust() const override;
  /// The rest of the balance: what drag, friction and impacts took, and what the integrator lost or
  /// made up.
  double dissipated() const override {
    return spec_.accounts_energy ? energy_introduced() + work_of_thrust() - kinetic_energy() : 0.0;
  }
  Vector2 momentum() const override;
  double max_overlap() const override;
  std::uint64_t hash() const override;

 protected:
  FrameSimulator(const WorldSpec& spec, Integrator integrator, double dt);

  using Body = FrameBody;
  /// Parts of the field, as partners.
  static constexpr Partner wall = 0xffffffff, goal_edge = 0xfffffffe, goal_line = 0xfffffffd;

  /// All bodies were stepped; within a frame the following two keep up with them.
  virtual void begin() = 0;
  /// `body` has come, or goes another way from now on.
  virtual void turned(std::uint32_t body) = 0;
  /// Whatever happens up to and including `until`, which lies within the frame, or up to the first
  /// goal.
  virtual std::optional<Goal> play(double until) = 0;

  /// Steps `body` from its last state to the end of the frame.
  void plan(Body& body);
  /// The state at `time` becomes the last one.
  void rebase(Body& body, double time);
  /// Puts a puck out of play at its last state.
  Goal score(std::uint32_t body);
  /// Impulse and momentum along `normal`, the unit vector from `partner` to `body`, both at their
  /// last states. Records the impact at `time`.
  void respond(std::uint32_t body, Partner partner, const Vector2& normal, double time);
  /// Whether `centre` is between the edges of a goal.
  bool is_in_opening(double y) const {
    return std::abs(y - 0.5 * spec_.field.width) < 0.5 * spec_.field.goal_width;
  }

  WorldSpec spec_;
  FrameSteps steps_;
  double now_ = 0.0;
  std::vector<Body> bodies_;
  EventRecord record_;

 private:
  BodyId add(Body body);
  void begin_frame();
  void finish_frame();
  EventKind kind_of_impact(std::uint32_t body, Partner partner) const;
  bool is_free(const Vector2& centre, const Vector2& half_extent, double radius) const;

  double introduced_ = 0.0, work_ = 0.0;  ///< J
};

}  // namespace rink::physics::paper
