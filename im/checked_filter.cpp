// Knows who is there and judges regions before the filter sees them.
#include "im/checked_filter.h"

#include <cmath>

namespace rink::im {
namespace {

bool contains(const std::vector<bool>& present, std::uint32_t id) { return id < present.size() && present[id]; }

}  // namespace

std::optional<Rejection> check(const FilterSettings& settings) {
  if (auto rejection = check_world(settings.world)) return rejection;
  if (!(settings.cell_size > 0.0) || !std::isfinite(settings.cell_size)) return Rejection{Fault::bad_cell_size, Subject::cells};
  return std::nullopt;
}

void CheckedFilter::hand_in(Subject subject, std::uint32_t id, const Region& region) {
  if (subject == Subject::update_region) filter_->set_update_region(id, region);
  else filter_->set_subscription_region(id, region);
}

std::optional<Rejection> CheckedFilter::add(Subject subject, Presence& present, std::uint32_t id, const Region& region) {
  if (contains(present, id)) return Rejection{Fault::doubled_id, subject, id};
  if (id >= id_limit_) return Rejection{Fault::id_too_large, subject, id};
  if (const auto fault = fault_of(region)) return Rejection{*fault, subject, id};
  if (id >= present.size()) present.resize(id + std::size_t{1});
  present[id] = true;
  hand_in(subject, id, region);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::move(Subject subject, Presence& present, std::uint32_t id, const Region& region) {
  if (!contains(present, id)) return Rejection{Fault::unknown_id, subject, id};
  if (const auto fault = fault_of(region)) return Rejection{*fault, subject, id};
  hand_in(subject, id, region);
  return std::nullopt;
}

std::optional<Rejection> CheckedFilter::take_away(Subject subject, Presence& present, std::uint32_t id) {
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

}  // namespace rink::im
