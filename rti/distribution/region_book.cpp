// Templates, uses and checks of a federate's own regions.
#include "rti/distribution/region_book.h"

#include <algorithm>
#include <cmath>

#include "im/basics/fnv_hash.h"
#include "rti/wire/message.h"

namespace rink::rti {

namespace {

static_assert(region_max == 1u << RegionBook::number_bits);
constexpr std::uint64_t is_interaction = std::uint64_t{1} << 63;

std::uint64_t key_of(ObjectClassHandle object_class, std::uint32_t region) {
  return std::uint64_t{object_class.value} << 32 | region;
}
std::uint64_t key_of(InteractionClassHandle interaction_class, std::uint32_t region) {
  return is_interaction | std::uint64_t{interaction_class.value} << 32 | region;
}

}  // namespace

void RegionBook::sign(std::string_view federate_name) {
  mark_ = hash_of<Fnv32>(federate_name) %
          ((1u << (32 - number_bits)) - 1);  // never all ones, as the empty handle's is
}

std::string RegionBook::name(RegionHandle region) {
  return "region " + std::to_string(region.value & number_mask);
}

RegionHandle RegionBook::create(DimensionSet dimensions) {
  auto number = static_cast<std::uint32_t>(entries_.size());
  if (free_.empty()) {
    if (number == region_max) return {};
    entries_.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  const auto x = fom_.dimension("X"), y = fom_.dimension("Y");
  const bool is_planar = dimensions.is_empty() || (x && y && dimensions == DimensionSet{*x, *y});
  entries_[number] = {{}, 0, true, is_planar};
  if (!is_planar)
    templates_[number] = {dimensions, std::vector<std::optional<Range>>(dimensions.count())};
  return {mark_ << number_bits | number};
}

std::uint32_t RegionBook::check(RegionHandle region) const {
  if (!region) throw RtiException(HlaError::invalid_region, "the empty handle names no region");
  if (region.value >> number_bits != mark_)
    throw RtiException(HlaError::region_not_created_by_this_federate,
                       name(region) + " is another federate's");
  const std::uint32_t number = region.value & number_mask;
  if (number >= entries_.size() || !entries_[number].exists)
    throw RtiException(HlaError::invalid_region, name(region) + " does not exist");
  return number;
}

DimensionSet RegionBook::dimensions(RegionHandle region) const {
  const std::uint32_t number = check(region);
  if (!entries_[number].is_planar) return templates_.at(number).dimensions;
  const auto x = fom_.dimension("X"), y = fom_.dimension("Y");
  return x && y ? DimensionSet{*x, *y} : DimensionSet();
}

void RegionBook::set_plane(RegionHandle region, const im::Region& bounds) {
  const std::uint32_t number = check(region);
  if (!entries_[number].is_planar)
    throw RtiException(HlaError::invalid_region_context,
                       name(region) + " is not over X and Y alone; set its ranges one by one");
  if (!im::is_valid(bounds))
    throw RtiException(HlaError::invalid_range_bound,
                       name(region) + " needs finite bounds, low <= high");
  entries_[number].plane = bounds;
}

std::size_t RegionBook::rank(const Template& all, RegionHandle region,
                             DimensionHandle dimension) const {
  if (dimension.value >= fom_.dimensions().size())
    throw RtiException(HlaError::invalid_dimension_handle,
                       "the model has no dimension " + std::to_string(dimension.value));
  if (!all.dimensions.contains(dimension))
    throw RtiException(HlaError::region_does_not_contain_specified_dimension,
                       name(region) + " is not over '" + fom_.at(dimension).name + "'");
  return all.dimensions.rank(dimension);
}

void RegionBook::set_range(RegionHandle region, DimensionHandle dimension, const Range& range) {
  const std::uint32_t number = check(region);
  Entry& entry = entries_[number];
  const std::size_t at =
      rank(entry.is_planar ? Template{dimensions(region), {}} : templates_.at(number), region,
           dimension);
  const std::optional<std::uint32_t> bound = fom_.at(dimension).upper_bound;
  const bool is_whole = range.low == std::floor(range.low) && range.high == std::floor(range.high);
  if (bound && !(is_whole && range.low >= 0.0 && range.low < range.high && range.high <= *bound))
    throw RtiException(
        HlaError::invalid_range_bound,
        "dimension '" + fom_.at(dimension).name +
            "' takes whole numbers with 0 <= lower < upper <= " + std::to_string(*bound));
  if (!bound && !(std::isfinite(range.low) && std::isfinite(range.high) && range.low <= range.high))
    throw RtiException(
        HlaError::invalid_range_bound,
        "dimension '" + fom_.at(dimension).name + "' takes finite numbers with lower <= upper");
  if (!entry.is_planar) templates_.at(number).ranges[at] = range;
  else if (fom_.at(dimension).name == "X")
    entry.plane.low_x = range.low, entry.plane.high_x = range.high;
  else entry.plane.low_y = range.low, entry.plane.high_y = range.high;
}

Range RegionBook::range(RegionHandle region, DimensionHandle dimension) const {
  const std::uint32_t number = check(region);
  const Entry& entry = entries_[number];
  const Template& all = entry.is_planar ? Template{dimensions(region), {}} : templates_.at(number);
  const std::size_t at = rank(all, region, dimension);
  if (entry.is_planar)
    return fom_.at(dimension).name == "X" ? Range{entry.plane.low_x, entry.plane.high_x}
                                          : Range{entry.plane.low_y, entry.plane.high_y};
  if (all.ranges[at]) return *all.ranges[at];
  const std::optional<std::uint32_t> bound = fom_.at(dimension).upper_bound;
  if (!bound)
    throw RtiException(HlaError::invalid_region, name(region) + " has no range in '" +
                                                     fom_.at(dimension).name +
                                                     "', which has no upper bound to fill it with");
  return {0.0, static_cast<double>(*bound)};
}

void RegionBook::closed_ranges(RegionHandle region, std::vector<Range>& ranges) const {
  ranges.clear();
  dimensions(region).for_each([&](DimensionHandle dimension) {
    Range each = range(region, dimension);
    if (fom_.at(dimension).upper_bound) each.high -= 1.0;
    ranges.push_back(each);
  });
}

void RegionBook::check_context(RegionHandle region, DimensionSet available,
                               std::string_view of) const {
  const DimensionSet all = dimensions(region);
  if (available.includes(all) && !all.is_empty()) return;
  std::string foreign;
  all.for_each([&](DimensionHandle each) {
    if (!available.contains(each))
      foreign += (foreign.empty() ? "'" : ", '") + fom_.at(each).name + "'";
  });
  throw RtiException(HlaError::invalid_region_context,
                     name(region) + " is over " + (foreign.empty() ? "no dimension" : foreign) +
                         ", which " + std::string(of) + " has not");
}

void RegionBook::set_subscription(std::uint64_t key, AttributeSet attributes) {
  Entry& entry = entries_[key & number_mask];
  const auto known = subscriptions_.find(key);
  if (attributes.is_empty()) {
    if (known == subscriptions_.end()) return;
    subscriptions_.erase(known);
    --entry.use_count;
    return;
  }
  if (known == subscriptions_.end()) ++entry.use_count;
  subscriptions_[key] = attributes;
}

void RegionBook::subscribe(ObjectClassHandle object_class, AttributeSet attributes,
                           RegionHandle region, bool is_added) {
  const std::uint64_t key = key_of(object_class, number(region));
  const auto known = subscriptions_.find(key);
  const AttributeSet now = known == subscriptions_.end() ? AttributeSet() : known->second;
  set_subscription(key, is_added ? now | attributes : now.without(attributes));
}

void RegionBook::replace_subscription(ObjectClassHandle object_class, AttributeSet attributes,
                                      RegionHandle region) {
  set_subscription(key_of(object_class, number(region)), attributes);
}

void RegionBook::subscribe(InteractionClassHandle interaction_class, RegionHandle region,
                           bool is_added) {
  set_subscription(key_of(interaction_class, number(region)), AttributeSet(is_added ? 1u : 0u));
}

void RegionBook::associate(ObjectHandle object, RegionHandle region) {
  forget(object);
  if (!region) return;
  whole_[object] = number(region);
  ++entries_[number(region)].use_count;
}

void RegionBook::associate(ObjectHandle object, AttributeSet all, AttributeSet attributes,
                           RegionHandle region, bool is_added) {
  auto& associations = partial_[object.value];
  if (const std::uint32_t* whole = whole_.find(object)) {
    associations.push_back({*whole, all});
    whole_.erase(object);
  }
  auto found = std::ranges::find(associations, number(region), &Association::region);
  if (found == associations.end()) {
    associations.push_back({number(region), {}});
    found = associations.end() - 1;
    ++entries_[number(region)].use_count;
  }
  found->attributes =
      is_added ? found->attributes | attributes : found->attributes.without(attributes);
  if (found->attributes.is_empty()) {
    associations.erase(found);
    --entries_[number(region)].use_count;
  }
  if (associations.empty()) partial_.erase(object.value);
}

void RegionBook::forget(ObjectHandle object) {
  if (const std::uint32_t* whole = whole_.find(object)) {
    --entries_[*whole].use_count;
    whole_.erase(object);
  }
  const auto known = partial_.find(object.value);
  if (known == partial_.end()) return;
  for (const Association& each : known->second) --entries_[each.region].use_count;
  partial_.erase(known);
}

std::vector<ObjectHandle> RegionBook::users_of(std::uint32_t number) const {
  std::vector<ObjectHandle> users;
  whole_.for_each([&](ObjectHandle object, std::uint32_t region) {
    if (region == number) users.push_back(object);
  });
  for (const auto& [object, associations] : partial_)
    if (std::ranges::find(associations, number, &Association::region) != associations.end())
      users.push_back({object});
  return users;
}

void RegionBook::release(std::uint32_t number) {
  entries_[number] = {};
  templates_.erase(number);
  free_.push_back(number);
}

bool RegionBook::is_sound() const {
  const auto exists = [&](std::uint32_t number) {
    return number < entries_.size() && entries_[number].exists;
  };
  std::vector<bool> is_free(entries_.size());
  for (const std::uint32_t number : free_) {
    if (number >= entries_.size() || entries_[number].exists || is_free[number]) return false;
    is_free[number] = true;
  }
  std::size_t templates = 0;
  for (const Entry& each : entries_) templates += each.exists && !each.is_planar ? 1 : 0;
  bool is_sound = entries_.size() <= region_max && templates == templates_.size();
  for (const auto& [number, all] : templates_) {
    is_sound &= exists(number) && !entries_[number].is_planar &&
                all.ranges.size() == all.dimensions.count();
    all.dimensions.for_each(
        [&](DimensionHandle each) { is_sound &= each.value < fom_.dimensions().size(); });
  }
  whole_.for_each([&](ObjectHandle, std::uint32_t number) { is_sound &= exists(number); });
  for (const auto& [object, associations] : partial_)
    for (const Association& each : associations) is_sound &= exists(each.region);
  return is_sound;
}

std::size_t RegionBook::memory_bytes() const {
  constexpr std::size_t node_size = 16;  // about what a map adds to each element
  return entries_.capacity() * sizeof entries_[0] + free_.capacity() * sizeof free_[0] +
         whole_.memory_bytes() + templates_.size() * (sizeof(Template) + node_size) +
         subscriptions_.size() * (sizeof(std::uint64_t) * 2 + node_size) +
         partial_.size() * (sizeof(Association) + node_size);
}

}  // namespace rink::rti
