// Predicts by arithmetic that is equal everywhere, and codes the steps between prediction and
// truth.
#include "game/replication/trajectory_residual.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>

#include "im/basics/varint.h"

namespace rink::game {
namespace {

using physics::Vector2;
using Counts = std::array<std::int64_t, 2>;

/// Of the lateness of a trajectory in steps of time, and of places. Velocities have one of four
/// orders: a bat whose keys changed keeps its velocity, a graze changes it little, a hit a lot.
constexpr unsigned late_order = 4, position_order = 1, class_bits = 2, along_bits = 2,
                   along_part = 3, steps_bits = 8;
/// Of the velocity that a companion's momentum leaves open: a larger one is of two other impacts.
constexpr unsigned impact_order = 1, impact_bits_max = 16;
constexpr std::array<unsigned, 4> velocity_orders{1, 6, 9, 11};
constexpr std::int64_t late_max = 1 << 14;
constexpr double count_max = 0x1p40, instant_max = 1e12;

/// (1 - exp(-x))/x, (x - (1 - exp(-x)))/x^2 and exp(-x): by a short series for x/256, doubled
/// eight times.
struct Warp {
  double s, q, e;
};
Warp warp_of(double x) {
  constexpr int doublings = 8;
  const double y = x * 0x1p-8;
  Warp w{1.0 - y * (0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0))),
         0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0)), 0.0};
  w.e = 1.0 - y * w.s;
  for (int i = 0; i < doublings; ++i)
    w = {w.s * (1.0 + w.e) * 0.5, (2.0 * w.q + w.s * w.s) * 0.25, w.e * w.e};
  return w;
}

/// What a body under drag and friction keeps of its velocity, and how far that velocity leads it.
struct Slide {
  double kept, length;
};
Slide slide_of(double elapsed, double drag, double deceleration) {
  const Warp w = warp_of(drag * elapsed);
  return {w.e - deceleration * (elapsed * w.s),
          elapsed * w.s - deceleration * (elapsed * elapsed * w.q)};
}

/// Of a body that friction stops: until it lies still.
Slide slide_to_rest(double elapsed, double drag, double deceleration) {
  const Slide whole = slide_of(elapsed, drag, deceleration);
  if (!(whole.kept < 0.0)) return whole;
  double low = 0.0, high = elapsed;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    if (slide_of(middle, drag, deceleration).kept < 0.0) high = middle;
    else low = middle;
  }
  return {0.0, slide_of(low, drag, deceleration).length};
}

/// The multiple of `step` nearest to `led`, or `former`'s where `led` is no reasonable number.
std::int64_t count_of(double led, double former, double step) {
  const double steps = std::nearbyint(led / step);
  if (std::abs(steps) < count_max) return static_cast<std::int64_t>(steps);
  const double before = std::nearbyint(former / step);
  return std::abs(before) < count_max ? static_cast<std::int64_t>(before) : 0;
}
Counts counts_of(const Vector2& led, const Vector2& former, double step) {
  return {count_of(led.x(), former.x(), step), count_of(led.y(), former.y(), step)};
}

std::optional<std::int64_t> exact_count(double value, double step) {
  const double steps = value / step;
  if (!(std::abs(steps) < count_max) || steps != std::nearbyint(steps)) return std::nullopt;
  return static_cast<std::int64_t>(steps);
}
std::optional<Counts> exact_counts(const Vector2& value, double step) {
  const auto x = exact_count(value.x(), step), y = exact_count(value.y(), step);
  return x && y ? std::optional(Counts{*x, *y}) : std::nullopt;
}

std::int64_t time_count(double time) {
  return static_cast<std::int64_t>(std::floor(time / trajectory_time_step));
}

/// The law of a trajectory: as before, that of the held keys or of a push, or rest.
enum class Law : std::uint8_t { same, keys, rest };

/// What so many steps of a push give of `thrust` [m/s^2], as trajectories tell accelerations.
double acceleration_of(int steps, double thrust) {
  return static_cast<double>(static_cast<float>(thrust * share_of_thrust(steps)));
}
/// The steps that give `acceleration`, nothing if none do.
std::optional<int> steps_of(double acceleration, double thrust) {
  if (acceleration == 0.0) return 0;
  if (!(thrust > 0.0) || !(std::abs(acceleration) <= thrust)) return std::nullopt;
  const int steps = static_cast<int>(std::lround(acceleration / thrust * Push::whole));
  return steps != 0 && acceleration_of(steps, thrust) == acceleration ? std::optional(steps)
                                                                      : std::nullopt;
}

std::optional<Law> law_of(const Trajectory& t, const Trajectory& former, const Shape& shape) {
  if (t == Trajectory{.position = t.position}) return Law::rest;
  if (t.acceleration == former.acceleration && t.drag == former.drag) return Law::same;
  const auto thrust = static_cast<double>(shape.thrust);
  const bool is_own = t.drag == Vector2::Constant(Trajectory::of_its_kind);
  return is_own && steps_of(t.acceleration.x(), thrust) && steps_of(t.acceleration.y(), thrust)
             ? std::optional(Law::keys)
             : std::nullopt;
}

/// One bit for the law before, two for others; held keys add two bits an axis, and a part of the
/// thrust eight more.
void write_law(rti::BitWriter& bits, Law law, const Vector2& acceleration, double thrust) {
  bits.flag(law == Law::same);
  if (law == Law::same) return;
  bits.flag(law == Law::keys);
  if (law != Law::keys) return;
  for (const double each : {acceleration.x(), acceleration.y()}) {
    const int steps = *steps_of(each, thrust);
    const bool is_part = steps != 0 && std::abs(steps) != Push::whole;
    bits.bits(is_part ? along_part : steps == 0 ? 0u : steps > 0 ? 1u : 2u, along_bits);
    if (is_part) bits.bits(static_cast<unsigned>(steps + Push::whole), steps_bits);
  }
}

std::optional<Law> read_law(rti::BitReader& bits, const Shape& shape, Trajectory& t) {
  bool is_set = false;
  if (!bits.flag(is_set)) return std::nullopt;
  if (is_set) return Law::same;
  if (!bits.flag(is_set)) return std::nullopt;
  if (!is_set) return Law::rest;
  const auto thrust = static_cast<double>(shape.thrust);
  for (int axis = 0; axis < 2; ++axis) {
    unsigned along = 0;
    if (!bits.bits(along, along_bits)) return std::nullopt;
    t.acceleration[axis] = along == 0 ? 0.0 : along == 1 ? thrust : -thrust;
    if (along != along_part) continue;
    unsigned biased = 0;
    if (!bits.bits(biased, steps_bits)) return std::nullopt;
    const int steps = static_cast<int>(biased) - Push::whole;
    if (steps == 0 || std::abs(steps) >= Push::whole) return std::nullopt;
    t.acceleration[axis] = acceleration_of(steps, thrust);
  }
  return Law::keys;
}

unsigned size_of(const Counts& residual, unsigned order) {
  return rti::golomb_size(zigzag(residual[0]), order) +
         rti::golomb_size(zigzag(residual[1]), order);
}
void write(rti::BitWriter& bits, const Counts& residual, unsigned order) {
  for (const std::int64_t each : residual) bits.golomb(zigzag(each), order);
}
/// Adds what is read to `counts`.
bool read(rti::BitReader& bits, Counts& counts, unsigned order) {
  for (std::int64_t& each : counts) {
    std::uint64_t residual = 0;
    if (!bits.golomb(residual, order)) return false;
    each += from_zigzag(residual);
    if (!(std::abs(static_cast<double>(each)) < count_max)) return false;
  }
  return true;
}
Counts difference(const Counts& a, const Counts& b) { return {a[0] - b[0], a[1] - b[1]}; }
Vector2 value_of(const Counts& counts, double step) {
  return {static_cast<double>(counts[0]) * step, static_cast<double>(counts[1]) * step};
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool is_same(const Vector2& a, const Vector2& b) {
  return is_same(a.x(), b.x()) && is_same(a.y(), b.y());
}

/// True if they have the same bits: zeros, for one, have two signs.
bool is_same(const Trajectory& a, const Trajectory& b) {
  return is_same(a.time, b.time) && is_same(a.position, b.position) &&
         is_same(a.velocity, b.velocity) && is_same(a.acceleration, b.acceleration) &&
         is_same(a.drag, b.drag);
}
/// The law that a reader gets.
void follow_law(Law law, const Trajectory& former, const Trajectory& sent, Trajectory& read) {
  if (law == Law::same) read.acceleration = former.acceleration, read.drag = former.drag;
  if (law == Law::keys) read.acceleration = sent.acceleration + Vector2(0.0, 0.0);
}

std::size_t velocity_class(const Counts& residual) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < velocity_orders.size(); ++k)
    if (size_of(residual, velocity_orders[k]) < size_of(residual, velocity_orders[best])) best = k;
  return best;
}

}  // namespace

Lead lead_of(const Trajectory& former, const Shape& shape, double instant) {
  if (former.is_resting()) return {former.position, {0.0, 0.0}};
  const double elapsed = instant > former.time ? instant - former.time : 0.0;
  const auto own = static_cast<double>(shape.drag), friction = static_cast<double>(shape.friction);
  const Vector2 &v = former.velocity, &a = former.acceleration;
  const double speed = std::sqrt(v.x() * v.x() + v.y() * v.y());
  if (friction > 0.0 && speed > 0.0 && a.isZero(0.0)) {
    const Slide slide = slide_to_rest(elapsed, own, friction / speed);
    return {
        {former.position.x() + v.x() * slide.length, former.position.y() + v.y() * slide.length},
        {v.x() * slide.kept, v.y() * slide.kept}};
  }
  Lead lead;
  for (int axis = 0; axis < 2; ++axis) {
    const double drag = former.drag[axis] == Trajectory::of_its_kind ? own : former.drag[axis];
    const Warp w = warp_of(drag * elapsed);
    const double s = elapsed * w.s, q = elapsed * elapsed * w.q;
    lead.position[axis] = former.position[axis] + v[axis] * s + a[axis] * q;
    lead.velocity[axis] = v[axis] * w.e + a[axis] * s;
  }
  return lead;
}

namespace {

/// Where the trajectory leads, with the momentum that the other body lost.
Lead lead_after(const TrajectoryBasis& basis, double instant) {
  Lead lead = lead_of(basis.former, basis.shape, instant);
  if (basis.impact == nullptr) return lead;
  const Lead other = lead_of(basis.impact->former, basis.impact->shape, instant);
  const double ratio =
      static_cast<double>(basis.impact->shape.mass) / static_cast<double>(basis.shape.mass);
  const Vector2& after = basis.impact->after.velocity;
  lead.velocity = {lead.velocity.x() + ratio * (other.velocity.x() - after.x()),
                   lead.velocity.y() + ratio * (other.velocity.y() - after.y())};
  return lead;
}

/// What is hit has a mass and an instant.
bool is_sound(const Impact& impact, const Shape& shape, double time) {
  return impact.shape.mass > 0.0f && shape.mass > 0.0f && !impact.after.is_resting() &&
         std::abs(impact.after.time) < instant_max && impact.after.time <= time;
}

}  // namespace

bool write_residual(rti::BitWriter& bits, const TrajectoryBasis& basis, const Trajectory& t) {
  const std::optional<Law> law = law_of(t, basis.former, basis.shape);
  if (!law || !(std::abs(basis.time) < instant_max)) return false;
  const bool is_resting = *law == Law::rest;
  const Impact* impact = basis.impact;
  if (impact != nullptr &&
      (is_resting || !is_sound(*impact, basis.shape, basis.time) || t.time != impact->after.time))
    return false;
  const auto position = exact_counts(t.position, trajectory_position_step),
             velocity = exact_counts(t.velocity, trajectory_velocity_step);
  const auto started = exact_count(t.time, trajectory_time_step);
  const std::int64_t late = is_resting || !started ? 0 : time_count(basis.time) - *started;
  if (!position || !velocity || !started || late < 0 || late > late_max) return false;
  const double instant = static_cast<double>(time_count(basis.time) - late) * trajectory_time_step;
  Trajectory read{.time = is_resting ? 0.0 : instant,
                  .position = value_of(*position, trajectory_position_step),
                  .velocity = value_of(*velocity, trajectory_velocity_step)};
  follow_law(*law, basis.former, t, read);
  if (!is_same(read, t)) return false;
  const Lead lead = lead_after(basis, instant);
  const Counts moved = difference(*position, counts_of(lead.position, basis.former.position,
                                                       trajectory_position_step)),
               turned = difference(*velocity, counts_of(lead.velocity, basis.former.velocity,
                                                        trajectory_velocity_step));
  if (impact != nullptr && size_of(turned, impact_order) > impact_bits_max) return false;
  write_law(bits, *law, t.acceleration, static_cast<double>(basis.shape.thrust));
  if (!is_resting && impact == nullptr) bits.golomb(static_cast<std::uint64_t>(late), late_order);
  write(bits, moved, position_order);
  if (is_resting) return true;
  if (impact != nullptr) return write(bits, turned, impact_order), true;
  const std::size_t k = velocity_class(turned);
  bits.bits(k, class_bits);
  write(bits, turned, velocity_orders[k]);
  return true;
}

bool read_residual(rti::BitReader& bits, const TrajectoryBasis& basis, Trajectory& t) {
  const Trajectory& former = basis.former;
  const Impact* impact = basis.impact;
  if (!(std::abs(basis.time) < instant_max)) return false;
  t = {.acceleration = former.acceleration, .drag = former.drag};
  const std::optional<Law> law = read_law(bits, basis.shape, t);
  if (!law) return false;
  const bool is_resting = *law == Law::rest;
  if (impact != nullptr && (is_resting || !is_sound(*impact, basis.shape, basis.time)))
    return false;
  if (*law != Law::same) t.drag = Vector2::Constant(Trajectory::of_its_kind);
  if (is_resting) t.acceleration = {0.0, 0.0};
  std::uint64_t late = 0;
  if (!is_resting && impact == nullptr &&
      (!bits.golomb(late, late_order) || late > static_cast<std::uint64_t>(late_max)))
    return false;
  const double instant =
      impact != nullptr
          ? impact->after.time
          : static_cast<double>(time_count(basis.time) - static_cast<std::int64_t>(late)) *
                trajectory_time_step;
  const Lead lead = lead_after(basis, instant);
  Counts position = counts_of(lead.position, former.position, trajectory_position_step),
         velocity = counts_of(lead.velocity, former.velocity, trajectory_velocity_step);
  std::size_t k = 0;
  if (!read(bits, position, position_order)) return false;
  if (!is_resting && impact == nullptr && !bits.bits(k, class_bits)) return false;
  if (!is_resting && !read(bits, velocity, impact != nullptr ? impact_order : velocity_orders[k]))
    return false;
  t.position = value_of(position, trajectory_position_step);
  if (is_resting) return true;
  t.time = instant;
  t.velocity = value_of(velocity, trajectory_velocity_step);
  return true;
}

bool list_residual(rti::BitReader& bits, bool is_of_impact, const rti::FieldVisitor& visit) {
  std::size_t from = bits.at();
  const auto end = [&](const char* name) {
    visit(name, bits.at() - from);
    from = bits.at();
    return true;
  };
  const auto skip = [&bits](unsigned order) {
    std::uint64_t number = 0;
    return bits.golomb(number, order);
  };
  Trajectory t;
  const Shape pushing{.thrust = 1.0f};
  const std::optional<Law> law = read_law(bits, pushing, t);
  if (!law || (is_of_impact && *law == Law::rest) || !end("law")) return false;
  const bool has_velocity = *law != Law::rest;
  if (has_velocity && !is_of_impact && (!skip(late_order) || !end("late"))) return false;
  if (!skip(position_order) || !skip(position_order) || !end("position")) return false;
  if (!has_velocity) return true;
  std::size_t k = 0;
  if (!is_of_impact && (!bits.bits(k, class_bits) || !end("order"))) return false;
  const unsigned order = is_of_impact ? impact_order : velocity_orders[k];
  return skip(order) && skip(order) && end("velocity");
}

}  // namespace rink::game
