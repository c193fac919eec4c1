// The registry of schemes: one line each, from name to class.
#include "im/filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/composition/schemes.h"

// A new scheme adds its line here, in alphabetical order, and defines make_NAME_filter in its own
// file.
#define RINK_SCHEMES(SCHEME) \
  SCHEME(always)             \
  SCHEME(aura)               \
  SCHEME(cone)               \
  SCHEME(diamond)            \
  SCHEME(grid)               \
  SCHEME(hex)                \
  SCHEME(hierarchical)       \
  SCHEME(hybrid)             \
  SCHEME(nimbus)             \
  SCHEME(none)               \
  SCHEME(owner)              \
  SCHEME(pvs)                \
  SCHEME(region)             \
  SCHEME(sight)              \
  SCHEME(strips)             \
  SCHEME(team)               \
  SCHEME(tiles)              \
  SCHEME(zones)

namespace rink::im {

#define RINK_DECLARE(name) \
  std::unique_ptr<Filter> make_##name##_filter(const FilterSettings& settings);
RINK_SCHEMES(RINK_DECLARE)
#undef RINK_DECLARE

namespace {

struct Scheme {
  const char* name;
  std::unique_ptr<Filter> (*make)(const FilterSettings&);
};

#define RINK_REGISTER(name) Scheme{#name, make_##name##_filter},
constexpr Scheme schemes[] = {RINK_SCHEMES(RINK_REGISTER)};
#undef RINK_REGISTER

}  // namespace

bool is_valid(const Region& region) {
  return std::isfinite(region.low_x) && std::isfinite(region.low_y) &&
         std::isfinite(region.high_x) && std::isfinite(region.high_y) &&
         region.low_x <= region.high_x && region.low_y <= region.high_y;
}

double cell_size_of(const FilterSettings& settings) {
  assert(is_valid(settings.world) && std::isfinite(settings.cell_size));
  // At 5 % of a square world per subscription, 7 of these make its side and three quarters of what
  // is sent is wanted.
  constexpr double cells_across = 32.0;
  if (settings.cell_size > 0.0) return settings.cell_size;
  const double width = settings.world.high_x - settings.world.low_x,
               height = settings.world.high_y - settings.world.low_y;
  const double side =
      width > 0.0 && height > 0.0 ? std::sqrt(width) * std::sqrt(height) : std::max(width, height);
  return side > 0.0 ? side / cells_across : 1.0;
}

std::unique_ptr<Filter> make_scheme(const std::string& name, const FilterSettings& settings) {
  for (const Scheme& scheme : schemes)
    if (name == scheme.name) return scheme.make(settings);
  return nullptr;
}

std::vector<std::string> filter_names() {
  std::vector<std::string> names;
  for (const Scheme& scheme : schemes) names.emplace_back(scheme.name);
  return names;
}

}  // namespace rink::im
