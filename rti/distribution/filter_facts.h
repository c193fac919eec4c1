// What the filter knows beside regions: roles, headings and motions of objects and federates, and
// from roles which objects belong to a federate's owner.
#pragma once

#include <cstdint>
#include <vector>

#include "im/filter.h"
#include "rti/distribution/distributed_region.h"

namespace rink::rti {

/// The filter forgets all about a federate or object that it drops, so what is new to it is passed
/// anew.
class FilterFacts {
 public:
  /// `filter` must outlive it.
  explicit FilterFacts(im::Filter& filter) : filter_(filter), traits_(filter.traits()) {}

  bool are_roles_used() const { return traits_.uses_roles; }
  bool are_flights_used() const { return traits_.uses_flights; }
  bool are_facts_used() const { return traits_.uses_facts; }

  void add_federate(std::uint32_t federate);
  const im::Role& role_of(std::uint32_t federate) const { return federates_[federate].role; }
  void set_federate_role(std::uint32_t federate, const im::Role& role) {
    federates_[federate].role = role;
  }
  /// False if the federate has that heading already.
  bool set_heading(std::uint32_t federate, const im::Heading& heading);
  /// False if the federate has those facts already, or the filter ignores them.
  bool set_federate_facts(std::uint32_t federate, const im::Facts& facts);
  /// Passes a federate's role, heading and facts for one of its subscriptions.
  void inform_subscriber(std::uint32_t federate, im::Subscriber subscriber) const;
  void inform_facts(std::uint32_t federate, im::Subscriber subscriber) const;
  /// Passes the heading alone.
  void inform_heading(std::uint32_t federate, im::Subscriber subscriber) const;

  im::Role object_role(ObjectSlot object) const {
    return object < objects_.size() ? objects_[object] : im::Role{};
  }
  void set_object_role(ObjectSlot object, const im::Role& role);
  /// The object is gone; the slot's next object has no role.
  void forget(ObjectSlot object) {
    if (object < objects_.size()) objects_[object] = {};
  }
  /// Passes what is known of the objects that use the region.
  void inform_entity(const DistributedRegion& region) const;
  void set_flight(const DistributedRegion& region, const im::Flight& flight) const;
  void set_facts(const DistributedRegion& region, const im::Facts& facts) const;
  void set_time(double now) const {
    if (traits_.uses_flights || traits_.uses_time) filter_.set_time(now);
  }

  /// True if the object and the federate have the same owner.
  bool is_own(std::uint32_t federate, ObjectSlot object) const {
    const std::uint32_t owner = federates_[federate].role.owner;
    return owner != im::Role::none && object < objects_.size() && objects_[object].owner == owner;
  }

 private:
  struct Known {
    im::Role role;
    im::Heading heading;
    im::Facts facts;
  };

  im::Filter& filter_;
  const im::Traits traits_;
  std::vector<Known> federates_;   ///< by slot
  std::vector<im::Role> objects_;  ///< by slot; as long as the last object with a role
};

}  // namespace rink::rti
