// Packs and unpacks trajectories; least significant bits first.
#include "game/replication/trajectory_codec.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>

#include "game/replication/attributes.h"
#include "game/replication/input_codec.h"
#include "game/replication/shape_codec.h"
#include "game/replication/trajectory.h"
#include "game/replication/trajectory_residual.h"
#include "rti/wire/bit_stream.h"

namespace rink::game {
namespace {

using physics::Vector2;

/// In two bits; a third one, behind that of `full`, makes it `driven`.
enum Form : std::uint8_t { resting, near, wide, full, driven = 7 };
constexpr unsigned form_bits = 2, time_bits = 14, near_position_bits = 17, near_velocity_bits = 14,
                   wide_position_bits = 24, wide_velocity_bits = 20;
constexpr double near_origin =
    1.0;  // m: bodies out of play are up to so far outside the field, on the low side
constexpr double time_ahead =
    0.5;  // s: a trajectory may start so far after the time by which it is read
constexpr double time_max = 1e12;  // s: beyond, multiples of the step are no longer exact
constexpr std::size_t full_size = 1 + 9 * sizeof(double);

using rti::BitReader, rti::BitWriter;

/// The `count` lowest bits of `value`.
void put(BitWriter& bits, std::uint64_t value, unsigned count) {
  assert(count > 0 && count < 64);
  bits.bits(value & ((std::uint64_t{1} << count) - 1), count);
}
/// `count` bits must be left.
std::uint64_t get(BitReader& bits, unsigned count) {
  std::uint64_t value = 0;
  [[maybe_unused]] const bool is_there = bits.bits(value, count);
  assert(is_there);
  return value;
}
std::int64_t get_signed(BitReader& bits, unsigned count) {
  assert(count > 0 && count < 64);
  const auto value = static_cast<std::int64_t>(get(bits, count));
  return value >> (count - 1) == 0 ? value : value - (std::int64_t{1} << count);
}

/// True if `value` is a multiple of `step` that fits `bits` as a signed number.
bool fits(double value, double step, unsigned bits) {
  const double count = value / step, limit = std::ldexp(1.0, static_cast<int>(bits) - 1);
  return count == std::nearbyint(count) && count >= -limit && count < limit;
}
bool fits(const Vector2& value, double step, unsigned bits) {
  return fits(value.x(), step, bits) && fits(value.y(), step, bits);
}

/// Near positions are counted from the middle of their range.
constexpr double near_middle =
    0.5 * (1u << near_position_bits) * trajectory_position_step - near_origin;
Vector2 from_middle(const Vector2& position) { return position - Vector2::Constant(near_middle); }
bool is_near(const Vector2& position) {
  const Vector2 offset = from_middle(position);
  return fits(position, trajectory_position_step, 40) &&
         fits(offset, trajectory_position_step, near_position_bits);
}

void put(BitWriter& bits, const Vector2& value, double step, unsigned count) {
  assert(fits(value, step, count));
  for (const double each : {value.x(), value.y()})
    put(bits, static_cast<std::uint64_t>(static_cast<std::int64_t>(each / step)), count);
}
Vector2 get(BitReader& bits, double step, unsigned count) {
  const double x = static_cast<double>(get_signed(bits, count)) * step,
               y = static_cast<double>(get_signed(bits, count)) * step;
  return {x, y};
}

bool is_of_its_kind(const Vector2& drag) {
  return drag == Vector2::Constant(Trajectory::of_its_kind);
}
bool is_single(double value) {
  return value == 0.0 ||
         (std::abs(value) > 1e-30 && std::abs(value) < 1e30 && single_precision(value) == value);
}
bool is_single(const Vector2& value) { return is_single(value.x()) && is_single(value.y()); }

/// True for the acceleration of one or two held keys: equal along both axes, or along one only.
bool is_push(const Vector2& acceleration) {
  const Vector2 size = acceleration.cwiseAbs();
  return !acceleration.isZero(0.0) && (size.x() == size.y() || size.x() == 0.0 || size.y() == 0.0);
}

/// The shortest form that loses nothing.
Form form_of(const Trajectory& t, double time) {
  const bool is_straight = t.acceleration.isZero(0.0) && is_of_its_kind(t.drag);
  if (is_straight && t.time == 0.0 && t.velocity.isZero(0.0) && is_near(t.position)) return resting;
  const bool is_timely = std::abs(time) < time_max && t.time <= time + time_ahead &&
                         t.time > time - 1.0 && fits(t.time, trajectory_time_step, 50);
  if (!is_timely || !is_single(t.acceleration)) return full;
  if (is_of_its_kind(t.drag) && is_near(t.position) &&
      fits(t.velocity, trajectory_velocity_step, near_velocity_bits)) {
    if (is_straight) return near;
    if (is_push(t.acceleration)) return driven;
  }
  return fits(t.position, trajectory_position_step, wide_position_bits) &&
                 fits(t.velocity, trajectory_velocity_step, wide_velocity_bits)
             ? wide
             : full;
}

void append(std::vector<std::byte>& bytes, Trajectory t) {
  rti::Writer writer(bytes);
  [[maybe_unused]] const bool is_sound = exchange(writer, t);
  assert(is_sound);
}

/// Unrounded values are not trusted.
bool has_sound_law(const Trajectory& t) {
  const auto is_drag = [](double drag) {
    return (std::isfinite(drag) && drag >= 0.0) || drag == Trajectory::of_its_kind;
  };
  return t.acceleration.allFinite() && is_drag(t.drag.x()) && is_drag(t.drag.y());
}

void encode_law(const Trajectory& t, std::vector<std::byte>& coded) {
  rti::Writer writer(coded);
  if (!t.acceleration.isZero(0.0))
    for (const double each : {t.acceleration.x(), t.acceleration.y()}) {
      float single = static_cast<float>(each);
      writer.number(single);
    }
  for (double each : {t.drag.x(), t.drag.y()})
    if (each != Trajectory::of_its_kind) writer.number(each);
}

constexpr std::size_t near_size = 10, wide_size = 14,
                      wide_flags_at =
                          form_bits + time_bits + 2 * wide_position_bits + 2 * wide_velocity_bits;
static_assert(wide_flags_at + 3 <= 8 * wide_size && form_bits + 2 * near_position_bits <= 8 * 5 &&
              form_bits + time_bits + 2 * near_position_bits + 2 * near_velocity_bits <=
                  8 * near_size);

constexpr unsigned push_bits = 2, push_short_at = 3 + time_bits + 2 * near_position_bits +
                                                  2 * near_velocity_bits + 2 * push_bits;
constexpr std::size_t driven_size = 11;  // and two or four bytes of acceleration
static_assert(push_short_at < 8 * driven_size);

/// Along each axis 0, 1 forwards or 2 backwards; then the size: the upper half of a float if the
/// lower one is 0.
void encode_push(const Vector2& acceleration, BitWriter& bits, std::vector<std::byte>& coded) {
  assert(is_push(acceleration));
  for (const double each : {acceleration.x(), acceleration.y()})
    put(bits, each == 0.0 ? 0u : each > 0.0 ? 1u : 2u, push_bits);
  const auto size =
      std::bit_cast<std::uint32_t>(static_cast<float>(acceleration.cwiseAbs().maxCoeff()));
  const bool is_short = (size & 0xffffu) == 0;
  put(bits, is_short, 1);
  bits.finish();
  rti::Writer writer(coded);
  auto upper = static_cast<std::uint16_t>(size >> 16), lower = static_cast<std::uint16_t>(size);
  writer.number(upper);
  if (!is_short) writer.number(lower);
}

bool decode_push(rti::Bytes coded, BitReader& bits, Vector2& acceleration) {
  const std::uint64_t along[2] = {get(bits, push_bits), get(bits, push_bits)};
  const bool is_short = get(bits, 1) != 0;
  rti::Reader reader(coded);
  std::uint16_t upper = 0, lower = 0;
  if (!reader.number(upper) || (!is_short && !reader.number(lower))) return false;
  const auto size =
      static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(upper) << 16 | lower));
  if (!std::isfinite(size) || size <= 0.0 || along[0] > 2 || along[1] > 2) return false;
  for (int axis = 0; axis < 2; ++axis)
    acceleration[axis] = along[axis] == 0 ? 0.0 : along[axis] == 1 ? size : -size;
  return true;
}

/// The latest time of that residue that is no more than `time_ahead` after `time`.
double resolved(std::uint64_t residue, double time) {
  const auto latest =
      static_cast<std::int64_t>(std::floor((time + time_ahead) / trajectory_time_step));
  const std::int64_t behind =
      (latest - static_cast<std::int64_t>(residue)) & ((1 << time_bits) - 1);
  assert(residue < 1u << time_bits && behind >= 0);
  return static_cast<double>(latest - behind) * trajectory_time_step;
}

bool decode_law(rti::Bytes coded, bool has_acceleration, const bool (&is_own)[2], Trajectory& t) {
  rti::Reader reader(coded);
  for (int axis = 0; has_acceleration && axis < 2; ++axis) {
    float single = 0.0f;
    if (!reader.number(single)) return false;
    t.acceleration[axis] = static_cast<double>(single);
  }
  for (int axis = 0; axis < 2; ++axis)
    if (!is_own[axis] && !reader.number(t.drag[axis])) return false;
  return reader.is_at_end();
}

/// The size by the first bytes, whether or not the rest is there.
std::optional<std::size_t> sent_size(rti::Bytes coded) {
  if (coded.empty()) return std::nullopt;
  const unsigned first = static_cast<unsigned>(coded[0]),
                 form = (first & 7u) == driven ? first & 7u : first & 3u;
  if (form == resting) return 5;
  if (form == near) return near_size;
  if (form == full) return full_size;
  if (form == driven) {
    if (coded.size() < driven_size) return std::nullopt;
    return driven_size +
           ((static_cast<unsigned>(coded[push_short_at / 8]) >> push_short_at % 8 & 1u) != 0 ? 2u
                                                                                             : 4u);
  }
  if (coded.size() < wide_size) return std::nullopt;
  const auto flags = static_cast<unsigned>(coded[wide_flags_at / 8]) >> wide_flags_at % 8;
  return wide_size + ((flags & 1u) != 0 ? 8u : 0u) + ((flags & 2u) != 0 ? 0u : 8u) +
         ((flags & 4u) != 0 ? 0u : 8u);
}

}  // namespace

void TrajectoryCodec::encode(rti::Bytes value, double time, std::vector<std::byte>& coded) const {
  Trajectory t;
  [[maybe_unused]] const bool is_sound = game::decode(value, t);
  assert(is_sound);
  const Form form = form_of(t, time);
  BitWriter bits(coded);
  put(bits, form, form == driven ? form_bits + 1 : form_bits);
  if (form == full) {
    bits.finish();
    return append(coded, t);
  }
  if (form != resting)
    put(bits, static_cast<std::uint64_t>(static_cast<std::int64_t>(t.time / trajectory_time_step)),
        time_bits);
  if (form == wide) put(bits, t.position, trajectory_position_step, wide_position_bits);
  else put(bits, from_middle(t.position), trajectory_position_step, near_position_bits);
  if (form == near) put(bits, t.velocity, trajectory_velocity_step, near_velocity_bits);
  if (form == driven)
    put(bits, t.velocity, trajectory_velocity_step, near_velocity_bits),
        encode_push(t.acceleration, bits, coded);
  if (form != wide) return;
  put(bits, t.velocity, trajectory_velocity_step, wide_velocity_bits);
  put(bits, !t.acceleration.isZero(0.0), 1);
  for (const double each : {t.drag.x(), t.drag.y()}) put(bits, each == Trajectory::of_its_kind, 1);
  bits.finish();
  encode_law(t, coded);
}

std::optional<std::size_t> TrajectoryCodec::size(rti::Bytes coded) const {
  const std::optional<std::size_t> sent = sent_size(coded);
  return sent && *sent <= coded.size() ? sent : std::nullopt;
}

bool TrajectoryCodec::decode(rti::Bytes coded, double time, std::vector<std::byte>& value) const {
  if (size(coded) != coded.size()) return false;
  BitReader bits(coded);
  auto form = static_cast<Form>(get(bits, form_bits));
  if (form == full && get(bits, 1) != 0) form = driven;
  Trajectory t;
  if (form == full) {
    if (!game::decode(coded.subspan(1), t)) return false;
    append(value, t);
    return true;
  }
  if (form != resting && !(std::abs(time) < 2.0 * time_max)) return false;
  if (form != resting) t.time = resolved(get(bits, time_bits), time);
  t.position = form == wide ? get(bits, trajectory_position_step, wide_position_bits)
                            : Vector2(get(bits, trajectory_position_step, near_position_bits) +
                                      Vector2::Constant(near_middle));
  if (form != resting)
    t.velocity =
        get(bits, trajectory_velocity_step, form == wide ? wide_velocity_bits : near_velocity_bits);
  if (form == driven && !decode_push(coded.subspan(driven_size), bits, t.acceleration))
    return false;
  if (form == wide) {
    const bool has_acceleration = get(bits, 1) != 0, is_own_x = get(bits, 1) != 0,
               is_own_y = get(bits, 1) != 0;
    if (!decode_law(coded.subspan(wide_size), has_acceleration, {is_own_x, is_own_y}, t))
      return false;
  }
  if (!has_sound_law(t)) return false;
  append(value, t);
  return true;
}

std::optional<std::uint64_t> TrajectoryCodec::companion_key(rti::Bytes value) const {
  Trajectory t;
  if (!game::decode(value, t) || t.is_resting()) return std::nullopt;
  return std::bit_cast<std::uint64_t>(t.time);
}

namespace {

/// False if the values are malformed.
bool read_basis(const rti::ResidualBasis& from, TrajectoryBasis& basis, Impact& impact) {
  if (!game::decode(from.former, basis.former) || !game::decode(from.context, basis.shape))
    return false;
  if (from.companion == nullptr) return true;
  basis.impact = &impact;
  return game::decode(from.companion->former, impact.former) &&
         game::decode(from.companion->context, impact.shape) &&
         game::decode(from.companion->value, impact.after);
}

}  // namespace

bool TrajectoryCodec::encode_residual(const rti::ResidualBasis& from, rti::Bytes value, double time,
                                      rti::BitWriter& bits) const {
  TrajectoryBasis basis;
  basis.time = time;
  Impact impact;
  Trajectory t;
  return read_basis(from, basis, impact) && game::decode(value, t) &&
         write_residual(bits, basis, t);
}

bool TrajectoryCodec::decode_residual(const rti::ResidualBasis& from, double time,
                                      rti::BitReader& bits, std::vector<std::byte>& value) const {
  TrajectoryBasis basis;
  basis.time = time;
  Impact impact;
  Trajectory t;
  if (!read_basis(from, basis, impact) || !read_residual(bits, basis, t)) return false;
  append(value, t);
  return true;
}

void TrajectoryCodec::list_fields(rti::Bytes coded, const rti::FieldVisitor& visit) const {
  BitReader bits(coded);
  auto form = static_cast<Form>(get(bits, form_bits));
  if (form == full && get(bits, 1) != 0) form = driven;
  visit("form", form == full || form == driven ? form_bits + 1 : form_bits);
  if (form == full) {
    visit("fill", 8 - form_bits - 1);
    constexpr std::size_t pair_bits = 2 * 64;
    visit("time", 64);
    for (const char* each : {"position", "velocity", "acceleration", "drag"})
      visit(each, pair_bits);
    return;
  }
  std::size_t used = form == driven ? form_bits + 1 : form_bits;
  const auto add = [&](const char* name, std::size_t size) {
    visit(name, size);
    used += size;
  };
  if (form != resting) add("time", time_bits);
  add("position", 2 * (form == wide ? wide_position_bits : near_position_bits));
  if (form != resting)
    add("velocity", 2 * (form == wide ? wide_velocity_bits : near_velocity_bits));
  if (form == driven) add("acceleration", 2 * push_bits + 1);
  bool has_acceleration = false;
  std::size_t drags = 0;
  if (form == wide) {
    add("law", 3);
    bits = BitReader(coded, wide_flags_at);
    has_acceleration = get(bits, 1) != 0;
    for (int axis = 0; axis < 2; ++axis) drags += 1 - get(bits, 1);
  }
  const std::size_t packed = form == resting  ? 5
                             : form == near   ? near_size
                             : form == driven ? driven_size
                                              : wide_size;
  visit("fill", 8 * packed - used);
  if (form == driven) visit("acceleration", 8 * (coded.size() - packed));
  if (has_acceleration) visit("acceleration", 2 * 32);
  if (drags > 0) visit("drag", 64 * drags);
}

bool TrajectoryCodec::list_residual_fields(rti::BitReader& bits, bool has_companion,
                                           const rti::FieldVisitor& visit) const {
  return list_residual(bits, has_companion, visit);
}

rti::Fom load_rink_fom(const std::string& path) { return load_rink_fom(std::span(&path, 1)); }

rti::Fom load_rink_fom(std::span<const std::string> paths) {
  rti::Fom fom = rti::Fom::load(paths);
  fom.use_codec("Trajectory", std::make_shared<TrajectoryCodec>());
  fom.use_codec("Input", std::make_shared<InputCodec>());
  fom.use_codec("Shape", std::make_shared<ShapeCodec>());
  return fom;
}

}  // namespace rink::game
