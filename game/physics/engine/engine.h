// The event loop behind World: bodies at their own last events, one earliest event per body, rest
// contacts and pressed clusters.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "game/physics/bodies/before_images.h"
#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/body_records.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/energy_ledger.h"
#include "game/physics/bodies/event_record.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/observers.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/bodies/world_mark.h"
#include "game/physics/bodies/world_state.h"
#include "game/physics/engine/contact_detection.h"
#include "game/physics/engine/free_impact.h"
#include "game/physics/engine/impact.h"
#include "game/physics/engine/look_ahead.h"
#include "game/physics/engine/next_events.h"
#include "game/physics/engine/places.h"
#include "game/physics/engine/prediction.h"
#include "game/physics/engine/questions.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/event.h"
#include "game/physics/event_budget.h"
#include "game/physics/flight/impact_time.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// All state is in `Real`; specs are in double, whose values every wider scalar holds exactly.
class Engine {
 public:
  explicit Engine(const WorldSpec& spec);

  /// For who plays windows of time in another order (slabs/).
  struct Parts {
    const WorldSpec& spec;
    Clock& clock;
    Observers& observers;
    EventRecord& record;
    EnergyLedger& ledger;
    Bodies& bodies;
    ImpactHistory& history;
    Jams& jams;
    Places& places;
    RestContacts& rests;
    NextEvents& events;
  };
  Parts parts() {
    return {spec_,    clock_, observers_, record_, ledger_, bodies_,
            history_, jams_,  places_,    rests_,  events_};
  }
  void require_prediction(std::uint32_t body);  ///< its next event is predicted anew
  void predict_pending();
  /// The first event of all, that of `body`.
  void process(std::uint32_t body, Real time);
  /// All that follows from the last-event states.
  void rebuild_from_state();

  BodyId add(BodyState state);  ///< at now; the law, the time and 1/mass follow
  void remove(std::uint32_t body);
  void set_thrust(std::uint32_t bat, const RealVector& acceleration);
  void place(std::uint32_t puck, const RealVector& position, const RealVector& velocity);
  struct Moved {
    RealVector position, velocity;
    Real spin;
  };
  /// Elsewhere, and otherwise, at now: a body in play that nothing holds. The place must be free.
  void move(std::uint32_t body, const Moved& moved);
  /// As World's, whose `budget` is null here without one.
  std::optional<Goal> advance(Real until, EventBudget* budget = nullptr);

  WorldState state() const;
  /// Goes on from there, with the same bits.
  void restore(WorldState state);

  const WorldSpec& spec() const { return spec_; }
  const Clock& clock() const { return clock_; }
  const Bodies& bodies() const { return bodies_; }
  const EnergyLedger& ledger() const { return ledger_; }
  Present present() const { return {spec_.field, bodies_, places_, clock_.now}; }
  /// For observers, who may forget.
  EventRecord& record() { return record_; }
  ChangeLog& changes() { return bodies_.changes(); }

  // engine_slots.cpp: for a subdomain of a world (subdomain.h), between its windows
  /// These are told from now on, and must outlive the engine or be replaced.
  void observe(const Observers& observers) { observers_ = observers; }
  BeforeImages images(std::uint32_t body_count) const {
    return {bodies_, history_, jams_, body_count};
  }
  BodyState body_state(std::uint32_t body) const;
  /// Another state, or another body, in the slot of that number. Holds are set apart.
  void put(std::uint32_t body, const BodyState& state);
  /// The slot is blank from now on.
  void drop(std::uint32_t body);
  const std::vector<RestContact>& rest_contacts() const { return rests_.rest_contacts(); }
  /// In any order; whoever is in one must be there.
  void set_rest_contacts(std::vector<RestContact> rest_contacts);
  /// Those of dropped bodies end, before another body may be put into their slots.
  void drop_blank_contacts();
  /// All in rest contact or in one jam with `body`, directly or through others, itself first.
  std::vector<std::uint32_t> group_of(std::uint32_t body) const;
  WorldMark mark() const;
  /// Back to `mark`; `before` holds what bodies were then.
  void undo(const WorldMark& mark, const BeforeImages& before);

 private:
  // engine.cpp: bodies and the loop
  void list(std::uint32_t body, const RealVector& position);
  void rebuild_grid();
  void enter_mouth_if_inside(std::uint32_t body);
  [[gnu::always_inline]] inline void cross_cell(std::uint32_t body);
  /// As process(body, time of its event), which is then charged.
  void process(std::uint32_t body, EventBudget& budget);
  void settle();
  void count_event(Real time);
  void score(std::uint32_t body, Real time);
  void stop(std::uint32_t body, Real time);

  void write(std::uint32_t body, const BodyState& state);

  WorldSpec spec_;
  Clock clock_;
  Observers observers_;
  EventRecord record_;
  EnergyLedger ledger_;
  Bodies bodies_;
  ImpactHistory history_;
  Jams jams_;
  Places places_;
  RestContacts rests_;
  ContactDetection detection_;
  NextEvents events_;
  Prediction prediction_;
  Impact impact_;
  FreeImpact free_impact_;
  LookAhead look_ahead_;
  bool is_everything_pending_ = false;
  std::vector<std::uint32_t> pending_;
  std::optional<Goal> goal_;
};

}  // namespace rink::physics::inline RINK_PRECISION
