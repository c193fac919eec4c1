// Knows the present ids and checks every argument before the filter gets it.
#include "im/checked_filter.h"

#include <cassert>
#include <cmath>
#include <initializer_list>

#include "im/matching/region_history.h"

namespace rink::im {
namespace {

bool contains(const std::vector<bool>& present, std::uint32_t id) {
  return id < present.size() && present[id];
}

/// With numbers up to this, no place of a flight within as many seconds overflows.
constexpr double flight_max = 1e150;

std::optional<Fault> fault_of(std::initializer_list<double> numbers) {
  for (const double number : numbers)
    if (!std::isfinite(number)) return Fault::not_finite;
  for (const double number : numbers)
    if (std::abs(number) > flight_max) return Fault::too_fast;
  return std::nullopt;
}

std::optional<Fault> fault_of(const Flight& flight) {
  return fault_of({flight.x, flight.y, flight.velocity_x, flight.velocity_y, flight.time});
}

}  // namespace

std::optional<Rejection> check(const FilterSettings& settings) {
  if (auto rejection = check_world(settings.world)) return rejection;
  if (!(settings.cell_size > 0.0) || !std::isfinite(settings.cell_size))
    return Rejection{Fault::bad_cell_size, Subject::cells};
  return std::nullopt;
}

CheckedFilter::CheckedFilter(std::unique_ptr<Filter> filter, std::uint32_t id_limit)
    : filter_(std::move(filter)), id_limit_(id_limit) {
  assert(filter_ != nullptr && id_limit_ <= RegionHistory::id_max);
}

void CheckedFilter::hand_in(Subject subject, std::uint32_t id, const Region& region) {
  assert(subject == Subject::update_region || subject == Subject::subscription_region);
  assert(id < id_limit_ && is_valid(region));
  if (subject == Subject::update_region) filter_->set_update_region(id, region);
  else filter_->set_subscription_region(id, region);
}

std::optional<Rejection> CheckedFilter::add(Subject subject, Presence& present, std::uint32_t id,
                                            const Region& region) {
  if (contains(present, id)) return Rejection{Fault::doubled_id, subject, id};
  if (id >= id_limit_) return Rejection{Fault::id_too_large, subject, id};
  if (const auto fault = fault_of(region)) return Rejection{*fault, subject, id};
  if (id >= present.size()) present.resize(id + std::size_t{1});
  present[id] = true;
  hand_in(subject, id, region);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::move(Subject subject, Presence& present, std::uint32_t id,
                                             const Region& region) {
  if (!contains(present, id)) return Rejection{Fault::unknown_id, subject, id};
  if (const auto fault = fault_of(region)) return Rejection{*fault, subject, id};
  hand_in(subject, id, region);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::take_away(Subject subject, Presence& present,
                                                  std::uint32_t id) {
  if (!contains(present, id)) return Rejection{Fault::unknown_id, subject, id};
  present[id] = false;
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::remove_entity(Entity entity) {
  auto rejection = take_away(Subject::update_region, entities_, entity);
  if (!rejection) filter_->remove_entity(entity);
  return rejection;
}

std::optional<Rejection> CheckedFilter::remove_subscriber(Subscriber subscriber) {
  auto rejection = take_away(Subject::subscription_region, subscribers_, subscriber);
  if (!rejection) filter_->remove_subscriber(subscriber);
  return rejection;
}

std::optional<Rejection> CheckedFilter::turn(Subscriber subscriber, const Heading& heading) {
  if (!contains(subscribers_, subscriber))
    return Rejection{Fault::unknown_id, Subject::subscription_region, subscriber};
  if (!std::isfinite(heading.x) || !std::isfinite(heading.y))
    return Rejection{Fault::not_finite, Subject::heading, subscriber};
  filter_->set_heading(subscriber, heading);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::set_entity_role(Entity entity, const Role& role) {
  if (!contains(entities_, entity))
    return Rejection{Fault::unknown_id, Subject::update_region, entity};
  filter_->set_entity_role(entity, role);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::set_subscriber_role(Subscriber subscriber,
                                                            const Role& role) {
  if (!contains(subscribers_, subscriber))
    return Rejection{Fault::unknown_id, Subject::subscription_region, subscriber};
  filter_->set_subscriber_role(subscriber, role);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::fly_entity(Entity entity, const Flight& flight) {
  if (!contains(entities_, entity))
    return Rejection{Fault::unknown_id, Subject::update_region, entity};
  if (const auto fault = fault_of(flight)) return Rejection{*fault, Subject::entity_flight, entity};
  filter_->set_flight(entity, flight);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::fly_subscriber(Subscriber subscriber,
                                                       const Flight& flight) {
  if (!contains(subscribers_, subscriber))
    return Rejection{Fault::unknown_id, Subject::subscription_region, subscriber};
  if (const auto fault = fault_of(flight))
    return Rejection{*fault, Subject::subscriber_flight, subscriber};
  filter_->set_subscriber_flight(subscriber, flight);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::note_update(Entity entity) {
  if (!contains(entities_, entity))
    return Rejection{Fault::unknown_id, Subject::update_region, entity};
  filter_->note_update(entity);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::set_time(double now) {
  if (const auto fault = fault_of({now})) return Rejection{*fault, Subject::clock};
  if (now < now_) return Rejection{Fault::goes_back, Subject::clock};
  filter_->set_time(now_ = now);
  return std::nullopt;
}

}  // namespace rink::im
