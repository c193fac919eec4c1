// What federates declared to the RTI's own data distribution: regions, subscriptions and the
// regions of objects.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/distribution/interest.h"
#include "rti/federation/federate_table.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// The scope that follows from it is not kept: the next match decides it again.
class KeptDistribution {
 public:
  /// Notes what the joined federates declared.
  void gather(const Interest& interest, const FederateTable& federates);
  /// True if it is that of these federates, by slot.
  bool is_of(const FederateTable& federates) const;
  /// Declares it again to `interest`, which must know the federates and no regions. False if the
  /// declarations contradict each other or the model.
  bool apply(const Fom& fom, const ObjectTable& objects, Interest& interest) const;

  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federates_, associations_);
  }

 private:
  struct KeptRegion {
    RegionHandle handle;
    DimensionSet dimensions;
    bool is_planar = false, is_committed = false;
    im::Region plane;
    std::vector<Range> ranges;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, handle, dimensions, is_planar, is_committed, plane, ranges);
    }
  };
  /// Without a region: everywhere.
  struct ClassSubscription {
    std::uint16_t object_class = 0;
    RegionHandle region;
    Subscription subscription;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, object_class, region, subscription);
    }
  };
  struct InteractionSubscription {
    std::uint16_t interaction_class = 0;
    RegionHandle region;
    bool is_passive = false;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, interaction_class, region, is_passive);
    }
  };
  struct Federate {
    std::uint32_t slot = 0, region_count = 0;  ///< handles below the count were used
    std::vector<KeptRegion> regions;
    std::vector<ClassSubscription> classes;
    std::vector<InteractionSubscription> interactions;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, slot, region_count, regions, classes, interactions);
    }
  };
  /// Attributes of an object that use a region of `maker`.
  struct KeptAssociation {
    ObjectSlot object = no_object;
    std::uint32_t maker = 0;
    RegionHandle region;
    AttributeSet attributes;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, object, maker, region, attributes);
    }
  };
  void gather_classes(const ClassInterest& classes, RegionHandle region, Federate& kept) const;
  static bool apply_regions(const Fom& fom, const Federate& kept, Interest& interest);
  static bool apply_subscriptions(const Fom& fom, const Federate& kept, Interest& interest);

  std::vector<Federate> federates_;
  std::vector<KeptAssociation> associations_;
};

}  // namespace rink::rti
