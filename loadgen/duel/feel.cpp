// Notes what is shown, frame by frame, and afterwards replays the record to each of these instants.
#include "loadgen/duel/feel.h"

#include <algorithm>
#include <cmath>

#include "game/control/replay.h"

namespace rink::loadgen {
namespace {

enum class Role : std::uint8_t { own, other, puck };

struct Shown {
  double time;
  std::size_t body;  ///< bats, then pucks
  game::Vector2 position;
  Role role;
};

ShownError error_of(std::vector<double>& errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  ShownError error{.count = errors.size(), .greatest = errors.back()};
  for (const double each : errors) error.mean += each / static_cast<double>(errors.size());
  const auto at = [&](double fraction) {
    return errors[static_cast<std::size_t>(fraction * static_cast<double>(errors.size() - 1))];
  };
  error.p50 = at(0.5);
  error.p90 = at(0.9);
  error.p99 = at(0.99);
  return error;
}

class TruthComparison {
 public:
  explicit TruthComparison(Duel& duel) : duel_(duel) {}

  void note(std::size_t k) {
    game::NetworkMatch& match = duel_.client(k);
    const game::PredictedRink* rink = match.prediction();
    if (rink == nullptr || match.sight().phase != game::MatchPhase::playing ||
        match.client().replicas().match().number != 1)
      return;
    for (std::size_t bat = 0; bat < rink->bats().size(); ++bat)
      add(rink->bats()[bat], bat, bat == match.player() ? Role::own : Role::other);
    for (std::size_t puck = 0; puck < rink->pucks().size(); ++puck)
      add(rink->pucks()[puck], rink->bats().size() + puck, Role::puck);
  }

  /// Plays `log` and fills in the errors of `feel`.
  void compare(const game::KeyLog& log, const game::Scene& scene, Feel& feel) {
    game::Game game(scene);
    for (const game::InputEvent& event : log.events) game.submit(event);
    std::stable_sort(shown_.begin(), shown_.end(),
                     [](const Shown& a, const Shown& b) { return a.time < b.time; });
    std::vector<game::EntityId> bodies;
    for (const auto kind : {physics::BodyKind::bat, physics::BodyKind::puck})
      for (const game::Entity& entity : game.entities())
        if (entity.kind == kind) bodies.push_back(entity.id);
    std::array<std::vector<double>, 3> errors;
    for (const Shown& shown : shown_) {
      if (shown.time < 0.0 || shown.time > *log.until) continue;
      game.advance(std::max(game.now(), shown.time));
      errors[static_cast<std::size_t>(shown.role)].push_back(
          (game.position(bodies[shown.body]) - shown.position).norm());
    }
    feel.own = error_of(errors[0]);
    feel.other = error_of(errors[1]);
    feel.puck = error_of(errors[2]);
  }

 private:
  void add(const game::ShownBody& body, std::size_t number, Role role) {
    shown_.push_back({body.time, number, body.position, role});
  }

  Duel& duel_;
  std::vector<Shown> shown_;
};

void add_corrections(Duel& duel, Feel& feel) {
  const double minutes = 2.0 * feel.played_s / 60.0;
  game::Corrections own, other, puck;
  const auto sum = [](game::Corrections& all, const game::Corrections& one) {
    all.visible_count += one.visible_count;
    all.sum += one.sum;
    all.greatest = std::max(all.greatest, one.greatest);
  };
  for (std::size_t k = 0; k < 2; ++k) {
    const game::PredictedRink& rink = *duel.client(k).prediction();
    sum(own, rink.own_corrections()), sum(other, rink.other_corrections()),
        sum(puck, rink.puck_corrections());
    feel.lead_s = std::max(feel.lead_s, 1e-3 * duel.client(k).sight().link->lead_ms);
  }
  const auto mean = [](const game::Corrections& all) {
    return all.visible_count == 0 ? 0.0 : all.sum / static_cast<double>(all.visible_count);
  };
  feel.corrections_per_min = static_cast<double>(own.visible_count) / minutes;
  feel.correction_mean = mean(own);
  feel.correction_greatest = own.greatest;
  feel.puck_corrections_per_min = static_cast<double>(puck.visible_count) / minutes;
  feel.puck_correction_mean = mean(puck);
  feel.other_corrections_per_min = static_cast<double>(other.visible_count) / minutes;
  feel.other_correction_mean = mean(other);
}

}  // namespace

Feel feel_of(const rti::Fom& fom, const game::Scene& scene, const std::string& scene_text,
             const DuelSettings& settings, double seconds) {
  Duel duel(fom, scene, scene_text, settings);
  TruthComparison comparison(duel);
  duel.watch = [&](std::size_t k) { comparison.note(k); };
  for (std::size_t k = 0; k < 2; ++k) duel.connect(k);
  duel.run_until([&] { return duel.server().hosted()->state().phase == game::MatchPhase::playing; },
                 30.0);
  std::array<std::uint64_t, 2> bytes{}, sent{};
  const double from_s = duel.now_s();
  for (std::size_t k = 0; k < 2; ++k) {
    bytes[k] = duel.client(k).client().ambassador().counters().bytes_received;
    sent[k] = duel.client(k).client().ambassador().counters().bytes_sent;
  }
  duel.run_until([&] { return duel.server().hosted()->state().phase == game::MatchPhase::over; },
                 seconds);
  Feel feel;
  const double passed_s = duel.now_s() - from_s;
  for (std::size_t k = 0; k < 2; ++k) {
    feel.payload_bytes_per_s +=
        0.5 *
        static_cast<double>(duel.client(k).client().ambassador().counters().bytes_received -
                            bytes[k]) /
        passed_s;
    feel.sent_bytes_per_s +=
        0.5 *
        static_cast<double>(duel.client(k).client().ambassador().counters().bytes_sent - sent[k]) /
        passed_s;
    feel.keys += duel.client(k).client().keys_sent();
  }
  feel.pushes = duel.server().keys().counters().pushes;
  feel.late_keys = duel.server().keys().counters().late;
  feel.played_s = duel.server().game().now();
  add_corrections(duel, feel);
  duel.server().finish_record();
  for (const game::KeyLog& log : duel.server().hosted()->take_finished()) {
    feel.is_replayed = game::replay(log, scene) == *log.hash;
    comparison.compare(log, scene, feel);
  }
  return feel;
}

}  // namespace rink::loadgen
