// The register of schemes: one line each, from name to class.
#include "im/filter.h"

#include <cassert>
#include <cmath>

// A new scheme adds its line here, in alphabetical order, and defines make_NAME_filter in its own file.
#define RINK_SCHEMES(SCHEME) \
  SCHEME(aura)               \
  SCHEME(cone)               \
  SCHEME(grid)               \
  SCHEME(hex)                \
  SCHEME(hierarchical)       \
  SCHEME(hybrid)             \
  SCHEME(none)               \
  SCHEME(region)             \
  SCHEME(sight)

namespace rink::im {

#define RINK_DECLARE(name) std::unique_ptr<Filter> make_##name##_filter(const FilterSettings& settings);
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
  return std::isfinite(region.low_x) && std::isfinite(region.low_y) && std::isfinite(region.high_x) && std::isfinite(region.high_y) &&
         region.low_x <= region.high_x && region.low_y <= region.high_y;
}

std::unique_ptr<Filter> make_filter(const std::string& name, const FilterSettings& settings) {
  assert(is_valid(settings.world) && std::isfinite(settings.cell_size) && settings.cell_size >= 0.0);
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
