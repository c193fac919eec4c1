// Each attribute is a function of one party or of two, applied to a column of pairs.
#include "im/pairs/attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace rink::im {
namespace attribute {  // short names, of which a translation unit has more
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double degrees = 180.0 / std::numbers::pi;

using OfOne = double (*)(const rink_party&);
using OfBoth = double (*)(const rink_party& me, const rink_party& its);

template <OfOne function>
void of_entity(const rink_pairs& pairs, double* out) {
  for (std::size_t i = 0; i < pairs.count; ++i)
    out[i] = function(pairs.entities[pairs.pairs[i].entity]);
}
template <OfOne function>
void of_subscriber(const rink_pairs& pairs, double* out) {
  for (std::size_t i = 0; i < pairs.count; ++i)
    out[i] = function(pairs.subscribers[pairs.pairs[i].subscriber]);
}
template <OfBoth function>
void of_both(const rink_pairs& pairs, double* out) {
  for (std::size_t i = 0; i < pairs.count; ++i)
    out[i] = function(pairs.subscribers[pairs.pairs[i].subscriber],
                      pairs.entities[pairs.pairs[i].entity]);
}

double x(const rink_party& party) { return party.x; }
double y(const rink_party& party) { return party.y; }
double width(const rink_party& party) { return party.high_x - party.low_x; }
double height(const rink_party& party) { return party.high_y - party.low_y; }
double size(const rink_party& party) { return std::max(width(party), height(party)); }
double velocity_x(const rink_party& party) { return party.velocity_x; }
double velocity_y(const rink_party& party) { return party.velocity_y; }
double speed(const rink_party& party) {
  return std::sqrt(party.velocity_x * party.velocity_x + party.velocity_y * party.velocity_y);
}
bool has_heading(const rink_party& party) {
  return party.heading_x != 0.0 || party.heading_y != 0.0;
}
double heading(const rink_party& party) {
  return has_heading(party) ? degrees * std::atan2(party.heading_y, party.heading_x) : unknown;
}
double age(const rink_party& party) { return party.age; }
double team(const rink_party& party) { return party.team; }
double owner(const rink_party& party) { return party.owner; }
double kind(const rink_party& party) { return party.kind; }
double always(const rink_party& party) { return party.is_always_relevant; }

double offset_x(const rink_party& me, const rink_party& its) { return its.x - me.x; }
double offset_y(const rink_party& me, const rink_party& its) { return its.y - me.y; }
double distance(const rink_party& me, const rink_party& its) {
  const double across = its.x - me.x, up = its.y - me.y;
  return std::sqrt(across * across + up * up);
}
double gap(const rink_party& me, const rink_party& its) {
  const double across = std::clamp(me.x, its.low_x, its.high_x) - me.x,
               up = std::clamp(me.y, its.low_y, its.high_y) - me.y;
  return std::sqrt(across * across + up * up);
}
double reach(const rink_party& me, const rink_party&) {
  return 0.5 * std::min(width(me), height(me));
}
double closing(const rink_party& me, const rink_party& its) {
  const double across = its.x - me.x, up = its.y - me.y,
               away = std::sqrt(across * across + up * up);
  return away > 0.0 ? -(across * (its.velocity_x - me.velocity_x) +
                        up * (its.velocity_y - me.velocity_y)) /
                          away
                    : 0.0;
}
double angle(const rink_party& me, const rink_party& its) {
  const double across = its.x - me.x, up = its.y - me.y;
  if (!has_heading(me) || (across == 0.0 && up == 0.0)) return unknown;
  return degrees * std::atan2(std::abs(me.heading_x * up - me.heading_y * across),
                              me.heading_x * across + me.heading_y * up);
}

constexpr PairUses places{}, roles{.roles = true}, motion{.motion = true}, ages{.age = true};

template <OfOne function>
constexpr NamedAttribute own(const char* name, ValueType type, const PairUses& uses) {
  return {name, type, uses, of_entity<function>, of_subscriber<function>};
}
template <OfBoth function>
constexpr NamedAttribute common(const char* name, const PairUses& uses) {
  return {name, ValueType::number, uses, of_both<function>, nullptr};
}

constexpr std::array all{own<age>("age", ValueType::number, ages),
                         own<always>("always", ValueType::truth, roles),
                         common<angle>("angle", motion),
                         common<closing>("closing", motion),
                         common<distance>("distance", places),
                         common<gap>("gap", places),
                         own<heading>("heading", ValueType::number, motion),
                         own<height>("height", ValueType::number, places),
                         own<kind>("kind", ValueType::kind, motion),
                         common<offset_x>("offset_x", places),
                         common<offset_y>("offset_y", places),
                         own<owner>("owner", ValueType::owner, roles),
                         common<reach>("reach", places),
                         own<size>("size", ValueType::number, places),
                         own<speed>("speed", ValueType::number, motion),
                         own<team>("team", ValueType::team, roles),
                         own<velocity_x>("velocity_x", ValueType::number, motion),
                         own<velocity_y>("velocity_y", ValueType::number, motion),
                         own<width>("width", ValueType::number, places),
                         own<x>("x", ValueType::number, places),
                         own<y>("y", ValueType::number, places)};

constexpr std::array kinds{NamedKind{"puck", EntityKind::puck}, NamedKind{"bat", EntityKind::bat},
                           NamedKind{"post", EntityKind::post}};

}  // namespace
}  // namespace attribute

const char* text_of(ValueType type) {
  switch (type) {
    case ValueType::truth:
      return "true or false";
    case ValueType::team:
      return "a team";
    case ValueType::owner:
      return "an owner";
    case ValueType::kind:
      return "a kind";
    case ValueType::number:
      break;
  }
  return "a number";
}

std::span<const NamedAttribute> named_attributes() { return attribute::all; }
std::span<const NamedKind> named_kinds() { return attribute::kinds; }

}  // namespace rink::im
