// The services of data distribution management at the federate's side (IEEE 1516.1-2010, clause 9).
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "rti/distribution/region_book.h"
#include "rti/federate/ambassador_basis.h"
#include "rti/federate/services/federate_objects.h"
#include "rti/federate/services/federate_updates.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

class FederateRegions {
 public:
  struct Uses {
    RegionBook& book;
    const ObjectBook& objects;
    const OwnershipBook& ownership;
    FederateUpdates& updates;
    FederateObjects& registry;
  };
  FederateRegions(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  RegionHandle create();
  RegionHandle create(DimensionSet dimensions);
  void commit(std::span<const RegionHandle> regions);
  void commit(std::span<const RegionBounds> regions);
  void remove(RegionHandle region);
  void associate(ObjectHandle object, RegionHandle region);
  void associate(ObjectHandle object, std::span<const AttributeRegions> pairs, bool is_added);
  ObjectHandle register_instance(ObjectClassHandle object_class,
                                 std::span<const AttributeRegions> pairs, std::string_view name);
  void subscribe(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs,
                 RegionAction action);
  void subscribe(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions,
                 Listening listening);
  void send(InteractionClassHandle interaction_class, Bytes parameters,
            std::span<const RegionHandle> regions, const Stamp& stamp);
  void request_update(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs);
  std::size_t memory_bytes() const { return records_.capacity(); }

 private:
  void check(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs) const;
  void check(InteractionClassHandle interaction_class, std::span<const RegionHandle> regions) const;
  ObjectClassHandle require_own(ObjectHandle object) const;
  void send_class(ObjectClassHandle object_class, std::span<const AttributeRegions> pairs,
                  RegionAction action);
  template <class Send>
  void for_each_message(std::span<const AttributeRegions> pairs, Send send);
  void write_numbers(std::span<const RegionHandle> regions);

  AmbassadorBasis basis_;
  Uses uses_;
  std::vector<Range> ranges_;       ///< of one region
  std::vector<std::byte> records_;  ///< of one message
};

}  // namespace rink::rti
