// A rejected argument: its fault and its id.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "im/filter.h"

namespace rink::im {

enum class Fault : std::uint8_t {
  inverted,
  not_finite,
  unknown_id,
  doubled_id,
  id_too_large,
  no_area,
  bad_cell_size,
  too_fast,
  goes_back
};
enum class Subject : std::uint8_t {
  update_region,
  subscription_region,
  world,
  cells,
  heading,
  entity_flight,
  subscriber_flight,
  clock
};

struct Rejection {
  Fault fault;
  Subject subject;
  std::uint32_t id =
      0;  ///< of the region, subscriber or entity; the world, the cells and the clock have none
  friend bool operator==(const Rejection&, const Rejection&) = default;
};

/// A sentence that names the offender, such as "subscription region 7 is inverted: its low exceeds
/// its high".
std::string describe(const Rejection& rejection);

/// Nothing if `region` is finite and not inverted.
std::optional<Fault> fault_of(const Region& region);

/// Nothing if `world` is finite and has an area.
std::optional<Rejection> check_world(const Region& world);

}  // namespace rink::im
