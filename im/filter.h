// The one interface of every interest-management scheme: regions in, changes of interest out.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rink::im {

/// A closed axis-aligned rectangle, in metres (touching is overlap). `low` never exceeds `high`; both are finite.
struct Region {
  double low_x = 0.0, low_y = 0.0, high_x = 0.0, high_y = 0.0;
  friend bool operator==(const Region&, const Region&) = default;
};

/// True if `region` is finite and not inverted, as every filter asserts of what it is given. For the edge, where regions come from strangers.
bool is_valid(const Region& region);

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

/// Small dense numbers chosen by the caller; they may be used again after removal.
using Entity = std::uint32_t;
using Subscriber = std::uint32_t;

enum class Transition : std::uint8_t { entered, left };

/// `entity` became relevant (or stopped being relevant) to `subscriber`.
struct Change {
  Subscriber subscriber;
  Entity entity;
  Transition transition;
  friend auto operator<=>(const Change&, const Change&) = default;
};

/// What a filter did since it was made; the proof that what did not move cost nothing.
struct FilterCounters {
  std::uint64_t regions_moved = 0;  ///< regions handed in that differed, to the scheme, from what they were (`grid`: other cells)
  std::uint64_t pairs_tested = 0;   ///< (subscriber, entity) pairs looked at one by one
  std::uint64_t changes = 0;        ///< transitions reported
};

/// Decides which entities matter to which subscribers, and says only what changed. Pure: no clock, no I/O; the same calls give the same changes.
/// "Net" compares the last match with this one: who enters and leaves again in between is not mentioned. An id that is removed and added again is a new
/// entity (or subscriber): it owes no `left` and has its `entered` reported afresh.
class Filter {
 public:
  virtual ~Filter() = default;

  /// Adds `entity` or moves it. A region equal to the present one costs nothing.
  virtual void set_update_region(Entity entity, const Region& region) = 0;
  /// Forgets `entity`; no `left` is reported for it, its caller knows. Unknown entities are ignored.
  virtual void remove_entity(Entity entity) = 0;

  /// Adds `subscriber` or moves its interest. A region equal to the present one costs nothing.
  virtual void set_subscription_region(Subscriber subscriber, const Region& region) = 0;
  /// Forgets `subscriber`; no `left` is reported for it.
  virtual void remove_subscriber(Subscriber subscriber) = 0;

  /// Says where `subscriber` looks, for schemes with a field of view. Until then, and after one of no length, it looks where its region last went: from its middle at one
  /// match to its middle at the next; before it has ever moved, everywhere. Finite. A subscriber that is not there is ignored; one that is forgotten looks nowhere.
  virtual void set_heading(Subscriber, const Heading&) {}

  /// The net changes since the last call, ordered by (subscriber, entity). Valid until the next call of any member.
  virtual std::span<const Change> match() = 0;

  virtual const FilterCounters& counters() const = 0;

  /// Side of the smallest cells that it decides by [m]; 0 if it has none. For who shows them.
  virtual double cell_size() const { return 0.0; }
};

/// What a scheme may need to know to start.
struct FilterSettings {
  Region world{0.0, 0.0, 1.0, 1.0};  ///< where entities are expected [m]; others are served too, only slower
  double cell_size = 0.0;            ///< side of the smallest cell [m]; 0 lets the scheme choose
  double half_angle_deg = 60.0;      ///< of a field of view, from its middle to either edge [degrees], 0 to 180; people see sharply over some 120 degrees
  std::vector<Disc> posts{};         ///< what blocks the view [m]
};

/// The scheme called `name`, or nothing if there is none. Names: see `filter_names`.
std::unique_ptr<Filter> make_filter(const std::string& name, const FilterSettings& settings);

/// Every registered scheme in alphabetical order.
std::vector<std::string> filter_names();

}  // namespace rink::im
