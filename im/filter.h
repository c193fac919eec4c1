// The one interface of every interest-management scheme: regions (im/region.h) in, changes of
// interest (im/change.h) out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "im/change.h"
#include "im/region.h"

namespace rink::im {

/// A direction; its length means nothing, and one of no length is no direction.
struct Heading {
  double x = 0.0, y = 0.0;
  friend bool operator==(const Heading&, const Heading&) = default;
};

/// A disc, in metres.
struct Disc {
  double x = 0.0, y = 0.0, radius = 0.0;
  friend bool operator==(const Disc&, const Disc&) = default;
};

class Worker;

/// What a filter did since it was made; the proof that what did not move cost nothing.
struct FilterCounters {
  std::uint64_t regions_moved = 0;  ///< regions handed in that differed, to the scheme, from what
                                    ///< they were (`grid`: other cells)
  std::uint64_t pairs_tested = 0;   ///< (subscriber, entity) pairs looked at one by one
  std::uint64_t changes = 0;        ///< transitions reported
  std::uint64_t entries = 0;  ///< of these `entered`: each wants an entity's whole state, where
                              ///< others go on with updates
};

/// What else than its place makes an entity relevant. Ones that differ in `team` or `owner` have
/// nothing to do with each other; by default nobody has either.
struct Role {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t team = none, owner = none;
  bool is_always_relevant = false;  ///< of an entity
  friend bool operator==(const Role&, const Role&) = default;
};

/// What a filter makes of what it may be told beside regions, and whether it says tiers: who hands
/// in or expects anything else works for nothing.
struct Traits {
  bool uses_roles = false, uses_headings = false, uses_flights = false, says_tiers = false;
};

/// How something moves until its next flight: its middle from (x, y) at `time` [s] on with that
/// velocity [m/s] against the drag of the settings.
struct Flight {
  double x = 0.0, y = 0.0, velocity_x = 0.0, velocity_y = 0.0, time = 0.0;
  friend bool operator==(const Flight&, const Flight&) = default;
};

/// When an entity is relevant to a subscriber if both move on as they do now: from `enters`
/// to `leaves` [s], both included, infinite if always; never if `enters > leaves`.
struct RelevanceInterval {
  Subscriber subscriber;
  Entity entity;
  double enters, leaves;
};

/// One figure of what a stage did since it was made.
struct StageCount {
  const char *stage, *what;
  std::uint64_t count;
};

class PriorityOrder;

/// Decides which entities matter to which subscribers, and says only what changed. Pure: no clock,
/// no I/O; the same calls give the same changes. "Net" compares the last match with this one: who
/// enters and leaves again in between is not mentioned. An id that is removed and added again is a
/// new entity (or subscriber): it owes no `left` and has its `entered` reported afresh.
class Filter {
 public:
  virtual ~Filter() = default;

  /// Adds `entity` or moves it. A region equal to the present one costs nothing.
  virtual void set_update_region(Entity entity, const Region& region) = 0;
  /// Forgets `entity`; no `left` is reported for it, its caller knows. Unknown entities are
  /// ignored.
  virtual void remove_entity(Entity entity) = 0;

  /// Adds `subscriber` or moves its interest. A region equal to the present one costs nothing.
  virtual void set_subscription_region(Subscriber subscriber, const Region& region) = 0;
  /// Forgets `subscriber`; no `left` is reported for it.
  virtual void remove_subscriber(Subscriber subscriber) = 0;

  /// Says where `subscriber` looks, for schemes with a field of view. Until then, and after one of
  /// no length, it looks where its region last went: from its middle at one match to its middle at
  /// the next; before it has ever moved, everywhere. Finite. A subscriber that is not there is
  /// ignored; one that is forgotten looks nowhere.
  virtual void set_heading(Subscriber, const Heading&) {}

  /// Says who is of which team and whose, for the schemes `always`, `team` and `owner`. Who is not
  /// there is ignored; who is forgotten loses his role.
  virtual void set_entity_role(Entity, const Role&) {}
  virtual void set_subscriber_role(Subscriber, const Role&) {}

  /// Says how it moves on and which time it is [s], for the stage `swept`. Who is not there is
  /// ignored. A region handed in afterwards ends a flight.
  virtual void set_flight(Entity, const Flight&) {}
  virtual void set_subscriber_flight(Subscriber, const Flight&) {}
  virtual void set_time(double) {}

  /// As the two setters above, of what flies in a straight line from `from` to `to`, rectangles of
  /// one size: all that could be relevant with it anywhere in between is, and perhaps more. By
  /// default that is the rectangle around both; a scheme whose shape in it would leave some of them
  /// out says more (docs/im.md, "Swept").
  virtual void set_swept_update_region(Entity entity, const Region& from, const Region& to) {
    set_update_region(entity, hull_of(from, to));
  }
  virtual void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                             const Region& to) {
    set_subscription_region(subscriber, hull_of(from, to));
  }

  /// The net changes since the last call, ordered by (subscriber, entity). Valid until the next
  /// call of any member.
  virtual std::span<const Change> match() = 0;

  /// From the last match, by the stage `swept`: stays of pairs let through whose flights it had not
  /// seen together, ordered by (subscriber, entity).
  virtual std::span<const RelevanceInterval> relevance_intervals() const { return {}; }
  /// Who is to be sent first, if the outermost stage that says so is `priority`; else nothing.
  virtual PriorityOrder* priority() { return nullptr; }

  virtual Traits traits() const { return {}; }

  virtual const FilterCounters& counters() const = 0;
  /// Appends what each stage did.
  virtual void list_counts(std::vector<StageCount>&) const {}

  /// Side of the smallest cells that it decides by [m]; 0 if it has none. For who shows them.
  virtual double cell_size() const { return 0.0; }

  /// Who may take half of a match from now on, where that pays (im/worker.h); null: nobody. It must
  /// outlive the filter. The changes are the same, bit for bit.
  virtual void share_with(Worker*) {}
};

/// What a scheme may need to know to start.
struct FilterSettings {
  Region world{0.0, 0.0, 1.0,
               1.0};       ///< where entities are expected [m]; others are served too, only slower
  double cell_size = 0.0;  ///< side of the smallest cell [m]; 0 lets the scheme choose
  double half_angle_deg = 60.0;  ///< of a field of view, from its middle to either edge [degrees],
                                 ///< 0 to 180; people see sharply over some 120 degrees
  std::vector<Disc> posts{};     ///< what blocks the view [m]
  double drag = 0.0;             ///< of all flights: dv/dt = -drag v [1/s]
};

/// The scheme that `expression` says, or nothing if it says none. Schemes by name (see
/// `filter_names`) with parameters, composed with `and`, `or`, `not` and parentheses, followed by
/// stages: "aura and not sight", "grid(cell_size=2) or always with hysteresis(margin=0.5) with
/// dwell(matches=10)" (docs/im.md).
std::unique_ptr<Filter> make_filter(const std::string& expression, const FilterSettings& settings);

/// What is wrong with `expression` or `settings`, naming the offender; nothing if `make_filter`
/// takes them.
std::optional<std::string> complaint_about(const std::string& expression,
                                           const FilterSettings& settings);

/// True if both are expressions and differ in nothing but how they are written: spaces,
/// parentheses, digits.
bool say_the_same(const std::string& expression, const std::string& other);

/// True if `expression` has a scheme with cells whose size it does not give, so that they have the
/// settings': what else they are told changes nothing.
bool takes_cell_size(const std::string& expression);

/// True if the scheme called `name` is one of those that `expression` is made of.
bool names_scheme(const std::string& expression, const std::string& name);

/// `expression` as part of a file's name: without spaces and parentheses.
std::string file_name_of(const std::string& expression);

/// Every registered scheme in alphabetical order.
std::vector<std::string> filter_names();
/// Every stage in alphabetical order.
std::vector<std::string> stage_names();

}  // namespace rink::im
