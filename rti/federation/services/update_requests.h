// Forwards requests for the values of attributes to their owners (IEEE 1516.1-2010, 6.19 and 6.20).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/status.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// However many requests there are, each owner gets one per object, flush and tag.
class UpdateRequests {
 public:
  UpdateRequests(const FederationBasis& basis, const Ownership& ownership,
                 DataDistribution& distribution, KnownObjects& known)
      : basis_(basis),
        ownership_(ownership),
        distribution_(distribution),
        known_(known),
        is_auto_providing_(basis.fom.switches().auto_provide) {}

  Status handle(std::uint32_t slot, Reader& reader);
  /// Requests attributes that overlap a region of the requesting federate.
  void ask_within(std::uint32_t slot, RegionHandle region, std::uint16_t object_class,
                  AttributeSet attributes);
  /// Settles requests within a region that is about to be deleted. A federate that makes regions,
  /// requests and deletes faster than objects can be searched breaks a limit.
  Status settle_within(std::uint32_t slot, RegionHandle region);
  /// Finds the objects of all requests, and asks their owners. Called once per flush.
  void settle();
  /// Resets the number of objects that may be searched for each federate.
  void flushed();
  /// The federate is about to discover the object.
  void discovered(std::uint32_t slot, ObjectSlot object, AttributeSet discovered_set) {
    if (is_auto_providing_) ask(slot, object, discovered_set, {});
  }
  void joined(std::uint32_t slot);
  void left(std::uint32_t slot);

  bool is_auto_providing() const { return is_auto_providing_; }
  void provide_automatically(bool is_on) { is_auto_providing_ = is_on; }
  /// Requests are settled before their state is kept.
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, is_auto_providing_);
  }
  /// A request to the RTI itself, as the owner of the management objects.
  struct Asked {
    ObjectHandle object;
    AttributeSet attributes;
  };
  std::vector<Asked> take_asked_of_rti() { return std::exchange(asked_of_rti_, {}); }

 private:
  static constexpr std::size_t looked_at_max =
      1u
      << 19;  ///< objects for one federate's requests in one flush; the rest waits for the next one
  void ask(std::uint32_t slot, ObjectSlot object, AttributeSet attributes, Bytes tag);
  void find_owners(std::uint32_t slot, ObjectClassHandle object_class, AttributeSet attributes,
                   RegionHandle region, Bytes tag);

  FederationBasis basis_;
  const Ownership& ownership_;
  DataDistribution& distribution_;
  KnownObjects& known_;
  bool is_auto_providing_;
  std::vector<std::size_t> looked_at_;  ///< by slot: objects since the last flush
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint16_t, std::string>, AttributeSet>
      requests_;  ///< by asking federate's slot, region, class and tag
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::string>, AttributeSet>
      to_provide_;  ///< by owner's slot, object and tag
  std::vector<Asked> asked_of_rti_;
};

}  // namespace rink::rti
