// Work is force times way, exact while the thrust is constant, which it is between two looks.
#include "bench/accuracy/stability.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/accuracy/guarded.h"
#include "bench/accuracy/run_time.h"
#include "bench/peers/overlap.h"

namespace rink::accuracy {
namespace {

using physics::BodyId;
using physics::Simulator;

std::vector<peers::Outline> outlines_of(const Simulator& world) {
  std::vector<peers::Outline> outlines;
  for (BodyId body; body.index < world.body_count(); ++body.index) {
    const bool is_bat = world.kind(body) == physics::BodyKind::bat;
    outlines.push_back({world.kind(body), world.radius(body),
                        is_bat ? world.half_extent(body) : Vector2(0.0, 0.0), world.mass(body)});
  }
  return outlines;
}

std::vector<Vector2> places_of(const Simulator& world) {
  std::vector<Vector2> places;
  for (BodyId body; body.index < world.body_count(); ++body.index)
    places.push_back(world.position(body));
  return places;
}

/// Follows energy and work from look to look.
class Balance {
 public:
  Balance(const Simulator& world, bool is_conservative)
      : world_(world),
        places_(places_of(world)),
        is_conservative_(is_conservative),
        start_(world.kinetic_energy()),
        scale_(start_) {}

  /// `thrusts` were acting since the last look.
  void look(const std::vector<Vector2>& thrusts, std::vector<Vector2> places) {
    assert(thrusts.size() == places.size() && places.size() == places_.size());
    double work = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!thrusts[i].isZero(0.0))
        work +=
            world_.mass({static_cast<std::uint32_t>(i)}) * thrusts[i].dot(places[i] - places_[i]);
    work_ += work;
    scale_ += std::abs(work);
    places_ = std::move(places);
    const double gain = world_.kinetic_energy() - start_ - work_,
                 error = is_conservative_ ? std::abs(gain) : std::max(gain, 0.0);
    assert(!(error < 0.0));
    worst_ = std::max(worst_, error);
    is_finite_ = is_finite_ && std::isfinite(gain);
  }
  /// Relative to all that there was and that was put in until now.
  double worst() const { return scale_ > 0.0 ? worst_ / scale_ : 0.0; }
  bool is_finite() const { return is_finite_; }

 private:
  const Simulator& world_;
  std::vector<Vector2> places_;
  bool is_conservative_, is_finite_ = true;
  double start_, scale_, work_ = 0.0, worst_ = 0.0;
};

bool are_finite(const std::vector<Vector2>& places) {
  return std::ranges::all_of(places, [](const Vector2& place) { return place.allFinite(); });
}

}  // namespace

Wear endure(const Trial& trial, const Contender& contender, double dt) {
  assert(trial.horizon > 0.0 && dt > 0.0);
  const auto world = make_world(trial, contender, dt);
  assert(world->body_count() == trial.body_count());
  const std::vector<peers::Outline> outlines = outlines_of(*world);
  Wear wear;
  wear.start_overlap = peers::deepest_overlap(trial.world.field, outlines, places_of(*world));
  Balance balance(*world, trial.is_conservative());
  Play play(trial, *world);
  const int frames = static_cast<int>(std::lround(trial.horizon / frame));
  assert(std::abs(at_frame(frames) - trial.horizon) < 1e-9);  // horizons lie on whole frames
  for (int k = 1; k <= frames; ++k) {
    const Stopwatch watch;
    play.advance(at_frame(k));
    wear.run_s += watch.passed().processor_s;
    std::vector<Vector2> places = places_of(*world);
    wear.is_finite = wear.is_finite && are_finite(places);
    wear.overlap =
        std::max(wear.overlap, peers::deepest_overlap(trial.world.field, outlines, places));
    balance.look(play.thrusts(), std::move(places));
  }
  wear.run_s /= trial.horizon;
  wear.is_finite = wear.is_finite && balance.is_finite();
  wear.energy_error = balance.worst();
  wear.escapes = physics::escape_count(*world);
  wear.events_per_s = static_cast<double>(world->counters().events()) / trial.horizon;
  return wear;
}

Survival try_to_survive(const Trial& trial, const Contender& contender, double dt, double limit_s,
                        const std::atomic<bool>& is_interrupted) {
  const Outcome outcome =
      guarded([&] { return to_bytes(endure(trial, contender, dt)); }, limit_s, &is_interrupted);
  Survival survival{.contender = contender, .dt = contender.is_stepped() ? dt : 0.0};
  const auto wear = outcome.output ? from_bytes<Wear>(*outcome.output) : std::nullopt;
  if (wear) survival.is_done = true, survival.wear = *wear;
  else survival.why_not = outcome.why_not;
  return survival;
}

std::string Survival::verdict() const {
  if (!is_done) return "no: " + why_not;
  if (!wear.is_finite) return "no: not numbers";
  if (wear.escapes > 0) return "no: " + std::to_string(wear.escapes) + " escaped";
  return "yes";
}

}  // namespace rink::accuracy
