// Checks regions and describes rejections.
#include "im/matching/rejection.h"

#include <cmath>

namespace rink::im {
namespace {

const char* name(Subject subject) {
  switch (subject) {
    case Subject::update_region:
      return "update region";
    case Subject::subscription_region:
      return "subscription region";
    case Subject::world:
      return "the world";
    case Subject::cells:
      return "the cell size";
    case Subject::heading:
      return "the heading of subscriber";
    case Subject::entity_flight:
      return "the flight of entity";
    case Subject::subscriber_flight:
      return "the flight of subscriber";
    case Subject::clock:
      return "the time";
  }
  return "";
}

const char* words(Fault fault) {
  switch (fault) {
    case Fault::inverted:
      return "is inverted: its low exceeds its high";
    case Fault::not_finite:
      return "is not finite: a coordinate is infinite or not a number";
    case Fault::unknown_id:
      return "is not known";
    case Fault::doubled_id:
      return "is there already";
    case Fault::id_too_large:
      return "has an id that is too large";
    case Fault::no_area:
      return "has no area";
    case Fault::bad_cell_size:
      return "is not a positive finite number";
    case Fault::too_fast:
      return "goes beyond 1e150, where its places have no numbers";
    case Fault::goes_back:
      return "is before the one before";
  }
  return "";
}

}  // namespace

std::string describe(const Rejection& rejection) {
  const bool is_numbered = rejection.subject != Subject::world &&
                           rejection.subject != Subject::cells &&
                           rejection.subject != Subject::clock;
  std::string text = name(rejection.subject);
  if (is_numbered) text.append(1, ' ').append(std::to_string(rejection.id));
  return text.append(1, ' ').append(words(rejection.fault));
}

std::optional<Fault> fault_of(const Region& region) {
  if (is_valid(region)) return std::nullopt;
  const bool is_finite = std::isfinite(region.low_x) && std::isfinite(region.low_y) &&
                         std::isfinite(region.high_x) && std::isfinite(region.high_y);
  return is_finite ? Fault::inverted : Fault::not_finite;
}

std::optional<Rejection> check_world(const Region& world) {
  if (const auto fault = fault_of(world)) return Rejection{*fault, Subject::world};
  // A side that underflows has no cells.
  if (!(world.high_x - world.low_x >= 1e-300 && world.high_y - world.low_y >= 1e-300))
    return Rejection{Fault::no_area, Subject::world};
  if (!std::isfinite(world.high_x - world.low_x) || !std::isfinite(world.high_y - world.low_y))
    return Rejection{Fault::not_finite, Subject::world};
  return std::nullopt;
}

}  // namespace rink::im
