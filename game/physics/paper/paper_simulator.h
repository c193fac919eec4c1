// The paper's engine: step a frame, look for contacts on the straight paths, roll those who meet
// back to the time of impact, respond, spend the remainder.
#pragma once

#include <vector>

#include "game/physics/collision/dynamic_tests.h"
#include "game/physics/paper/frame_simulator.h"

namespace rink::physics::paper {

/// What a disc meets at the corner of a bat: as the paper, the edges moved outwards by the radius,
/// or the true arc.
enum class Corners : std::uint8_t { sharp, rounded };

class PaperSimulator final : public FrameSimulator {
 public:
  PaperSimulator(const WorldSpec& spec, Integrator integrator, double dt, Corners corners)
      : FrameSimulator(spec, integrator, dt), corners_(corners) {}

  /// A body that suffers more impacts in one frame stays where it is until the next: pressed
  /// contact would otherwise never let the frame end.
  static constexpr std::uint32_t impact_max = 20;

 private:
  struct PredictedImpact {
    double time;
    std::uint32_t body;
    Partner partner;
    std::uint32_t body_version, partner_version;
    Vector2 normal;  ///< from the partner to the body
  };
  static bool is_later(const PredictedImpact& a, const PredictedImpact& b);

  void begin() override;
  void turned(std::uint32_t body) override;
  std::optional<Goal> play(double until) override;

  Extent swept_box(const Body& body) const;
  collision::Disc<double> swept_circle(const Body& body) const;
  bool may_meet(const Body& a, const Body& b) const;
  void test_pair(std::uint32_t a, std::uint32_t b);
  collision::MaybeContact<double> first_touch(const Body& a, const Body& b, double start) const;
  void test_field(std::uint32_t body);
  void test_end(std::uint32_t body, const collision::Plane<double>& wall, double goal_line);
  void test_plane(std::uint32_t body, const collision::Plane<double>& plane);
  void test_goal_edges(std::uint32_t body);
  void expect(std::uint32_t body, Partner partner, double start,
              const collision::Contact<double>& contact);
  bool is_stale(const PredictedImpact& impact) const;
  void meet(const PredictedImpact& impact);

  Corners corners_;
  FrameGrid grid_;
  std::vector<PredictedImpact> impacts_;  ///< of this frame: a heap, earliest first
};

}  // namespace rink::physics::paper
