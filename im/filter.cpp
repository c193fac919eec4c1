// The registry of schemes: one line each, from name to class.
#include "im/filter.h"

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
  SCHEME(none)               \
  SCHEME(owner)              \
  SCHEME(region)             \
  SCHEME(sight)              \
  SCHEME(strips)             \
  SCHEME(team)

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
