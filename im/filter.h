// The one interface of every interest-management scheme: regions (im/region.h) in, changes of
// interest (im/change.h) out.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "im/change.h"
#include "im/region.h"

struct rink_plugin;  // im/pairs/rink_plugin.h

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

/// What a filter did since it was made; tests prove by it that what did not move cost nothing.
struct FilterCounters {
  std::uint64_t regions_moved = 0;  ///< regions that differed for the scheme from the ones before
                                    ///< (`grid`: other cells)
  std::uint64_t pairs_tested = 0;   ///< (subscriber, entity) pairs looked at one by one
  std::uint64_t changes = 0;        ///< transitions reported
  std::uint64_t entries = 0;  ///< of these `entered`: each wants an entity's whole state, where
                              ///< others go on with updates
};

/// What makes an entity relevant apart from its place. Only equal teams or owners match; by default
/// there is neither.
struct Role {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t team = none, owner = none;
  bool is_always_relevant = false;  ///< of an entity
  friend bool operator==(const Role&, const Role&) = default;
};

/// The facts beside regions that a filter uses, and whether it decides tiers. Callers may omit all
/// other facts.
struct Traits {
  bool uses_roles = false, uses_headings = false, uses_flights = false, decides_tiers = false;
  bool uses_facts = false,    ///< `Facts`
      uses_time = false,      ///< the time of `set_time`, against which the facts' times count
      holds_updates = false;  ///< updates of relevant pairs wait until the pair is `due`
  bool depends_on_crowd = false;  ///< its shapes follow from where all entities are
};

/// The kinds of things that conditions tell apart (docs/im.md, "Conditions").
enum class EntityKind : std::uint8_t { unknown, puck, bat, post };

/// What conditions and scores may ask beside region and role.
struct Facts {
  double velocity_x = 0.0, velocity_y = 0.0;  ///< m/s
  Heading heading{};                          ///< of no length: that of the velocity
  EntityKind kind = EntityKind::unknown;
  double changed_at = -std::numeric_limits<double>::infinity();  ///< when its motion last changed
                                                                 ///< by contact or key [s]
  friend bool operator==(const Facts&, const Facts&) = default;
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

/// One figure of a stage's work since it was made.
struct StageCount {
  const char *stage, *what;
  std::uint64_t count;
};

class PriorityOrder;

/// Decides which entities matter to which subscribers, and reports only changes. Pure: no clock, no
/// I/O; the same calls give the same changes. "Net" compares the last match with this one: an
/// entity that enters and leaves again in between is not reported. An id that is removed and added
/// again is a new entity (or subscriber): no `left` is reported for the old one, and `entered` is
/// reported for the new one.
class Filter {
 public:
  virtual ~Filter() = default;

  /// Adds `entity` or moves it. A region equal to the present one costs nothing.
  virtual void set_update_region(Entity entity, const Region& region) = 0;
  /// Forgets `entity`; no `left` is reported for it. Unknown entities are ignored.
  virtual void remove_entity(Entity entity) = 0;

  /// Adds `subscriber` or moves its interest. A region equal to the present one costs nothing.
  virtual void set_subscription_region(Subscriber subscriber, const Region& region) = 0;
  /// Forgets `subscriber`; no `left` is reported for it.
  virtual void remove_subscriber(Subscriber subscriber) = 0;

  /// Sets the direction in which `subscriber` looks, for schemes with a field of view. Without one,
  /// or with one of no length, it looks where its region last moved: from its middle at one match
  /// to its middle at the next; before its first move it looks everywhere. The heading is finite.
  /// An unknown subscriber is ignored; forgetting a subscriber forgets its heading.
  virtual void set_heading(Subscriber, const Heading&) {}

  /// Sets the role for the schemes `always`, `team` and `owner`. Unknown ids are ignored;
  /// forgetting an id forgets its role.
  virtual void set_entity_role(Entity, const Role&) {}
  virtual void set_subscriber_role(Subscriber, const Role&) {}

  /// Set motions and the time [s] for the stage `swept`. Unknown ids are ignored. A region that is
  /// set afterwards ends a flight.
  virtual void set_flight(Entity, const Flight&) {}
  virtual void set_subscriber_flight(Subscriber, const Flight&) {}
  virtual void set_time(double) {}

  /// Set facts for conditions and scores. Unknown ids are ignored; forgetting an id forgets them.
  virtual void set_entity_facts(Entity, const Facts&) {}
  virtual void set_subscriber_facts(Subscriber, const Facts&) {}

  /// Something of `entity` was updated since the last match, for stages that hold updates back. An
  /// unknown entity is ignored; so is one that is new, of which all is told.
  virtual void note_update(Entity) {}

  /// Sets a region that sweeps in a straight line from `from` to `to`, rectangles of one size:
  /// every pair that would be relevant anywhere in between is relevant, and perhaps more. By
  /// default the region is the rectangle around both; a scheme whose shape in it would miss some
  /// pairs overrides this (docs/im.md, "Swept").
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

  /// Intervals of relevance that the stage `swept` predicted at the last match, for relevant pairs
  /// with new flights, ordered by (subscriber, entity).
  virtual std::span<const RelevanceInterval> relevance_intervals() const { return {}; }
  /// The order of sending, if the outermost stage that decides one is `priority`; else null.
  virtual PriorityOrder* priority() { return nullptr; }

  virtual Traits traits() const { return {}; }

  virtual const FilterCounters& counters() const = 0;
  /// Appends the figures of each stage.
  virtual void list_counts(std::vector<StageCount>&) const {}

  /// Side of the smallest cells of the scheme [m], for displays; 0 if it has none.
  virtual double cell_size() const { return 0.0; }

  /// Sets a worker that takes half of a match where that pays (im/worker.h), or null for none. It
  /// must outlive the filter. The changes are the same, bit for bit.
  virtual void share_with(Worker*) {}
};

/// Settings that a scheme may need to start.
struct FilterSettings {
  Region world{0.0, 0.0, 1.0,
               1.0};       ///< where entities are expected [m]; others are served too, only slower
  double cell_size = 0.0;  ///< side of the smallest cell [m]; 0 lets the scheme choose
  double half_angle_deg = 60.0;  ///< of a field of view, from its middle to either edge [degrees],
                                 ///< 0 to 180; people see sharply over some 120 degrees
  double nimbus_radius = 0.0;    ///< of the scheme `nimbus` [m]; 0: that of the focus
  double awareness = 0.0;        ///< at which an entity matters there, 0 to 1
  std::uint32_t tile_steps = 4;  ///< of the scheme `tiles`, up to 64
  std::uint32_t zone_capacity = 32;  ///< of the scheme `zones`: with more entities a zone is cut
  std::vector<Disc> posts{};         ///< discs that block the view [m]
  double drag = 0.0;                 ///< of all flights: dv/dt = -drag v [1/s]
  std::span<const rink_plugin* const> plugins{};  ///< that expressions may name; they outlive the
                                                  ///< filter
};

/// The side of cells that `settings` give, or the square root of their world's area divided by 32
/// [m]: that of a scheme before it knows subscriptions, and of programs that must agree on one in
/// advance.
double cell_size_of(const FilterSettings& settings);

/// Makes the filter that `expression` describes, or null if it is faulty. Schemes by name (see
/// `filter_names`) with parameters, composed with `and`, `or`, `not` and parentheses, followed by
/// stages: "aura and not sight", "grid(cell_size=2) or always with hysteresis(margin=0.5) with
/// dwell(matches=10)" (docs/im.md).
std::unique_ptr<Filter> make_filter(const std::string& expression, const FilterSettings& settings);

/// The fault of `expression` or `settings`, naming the faulty part; nothing if `make_filter` takes
/// them.
std::optional<std::string> complaint_about(const std::string& expression,
                                           const FilterSettings& settings);

/// True if both are valid expressions that differ only in spelling: spaces, parentheses, digits.
bool are_equivalent(const std::string& expression, const std::string& other);

/// True if `expression` has a scheme with cells whose size it does not give, so that the settings'
/// size applies.
bool takes_cell_size(const std::string& expression);

/// True if `expression` contains the scheme called `name`.
bool names_scheme(const std::string& expression, const std::string& name);

/// `expression` as part of a file's name: without spaces and parentheses.
std::string file_name_of(const std::string& expression);

/// Every registered scheme in alphabetical order.
std::vector<std::string> filter_names();
/// Every stage in alphabetical order.
std::vector<std::string> stage_names();

}  // namespace rink::im
