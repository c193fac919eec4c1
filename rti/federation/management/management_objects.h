// The RTI as the owner of the management object model's objects (IEEE 1516.1-2010, clause 11).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "rti/buffering/buffering.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/declarations.h"
#include "rti/federation/services/object_service.h"
#include "rti/federation/services/update_requests.h"
#include "rti/federation/time/time_service.h"
#include "rti/management/management_handles.h"
#include "rti/management/management_values.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// While nobody subscribes to HLAmanager.HLAfederation or HLAmanager.HLAfederate, there is no
/// object and no cost. From the first subscription on the RTI has a slot among the federates, as
/// the owner of objects, but has not joined: it is sent nothing and not counted.
class ManagementObjects {
 public:
  struct Uses {
    DataDistribution& distribution;
    const Ownership& ownership;
    const Declarations& declarations;
    ObjectService& objects;
    UpdateRequests& requests;
    const TimeService& time;
    Buffering& buffering;
  };
  ManagementObjects(const FederationBasis& basis, const Uses& uses,
                    const ManagementHandles& handles)
      : basis_(basis),
        uses_(uses),
        federation_class_(handles.federation),
        federate_class_(handles.federate) {}

  /// A federate's subscriptions changed: a new subscriber gets all values with the next flush.
  void subscribed(std::uint32_t slot);
  void joined(std::uint32_t slot);
  /// Call it while the federate's record still exists.
  void left(std::uint32_t slot);
  /// The federate's period of reports has changed [s], 0 for none: the next one is due a period
  /// from now.
  void timed(std::uint32_t slot, double period);
  /// HLAautoProvide has changed.
  void switched() { federation_.is_due = static_cast<bool>(federation_.object); }
  /// Sends due reports; called once before each flush.
  void notify();
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, slot_, is_subscribed_, federation_, federates_, periods_, slots_);
  }

 private:
  /// One object of the RTI's.
  struct ReportedObject {
    ObjectHandle object;  ///< none: not registered
    AttributeSet asked;
    bool is_due = false;
    double due_at = 0.0;  ///< the next report, if a period is set [s]
    unsigned state = 0;   ///< of time management, as last reported: a change is reported
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, object, asked, is_due, state);
    }
  };
  void begin();
  void end();
  /// Without a block of handles that is left, there is no object.
  void add(ReportedObject& reported, ObjectClassHandle object_class);
  void remove(ReportedObject& reported);
  /// Marks attributes to be reported whether they have changed or not.
  void ask(ObjectHandle object, AttributeSet attributes);
  ReportedObject& reported_of(std::uint32_t slot);
  void report_federation();
  void report_federate(std::uint32_t slot, ReportedObject& reported);
  unsigned state_of(std::uint32_t slot) const;
  std::vector<std::uint32_t> count_deletable() const;
  bool is_any_subscribed() const;
  bool receives(std::uint32_t slot) const;
  void value_counts(std::uint32_t slot);
  void value_times(std::uint32_t slot, unsigned state);
  /// Sends those values that differ from the last report and those that were requested. The values
  /// are in `values_`, those of attribute k up to `ends_[k]`.
  void update(ReportedObject& reported);
  void begin_values(ObjectClassHandle object_class);
  template <class Write>
  void value(Write write);

  FederationBasis basis_;
  Uses uses_;
  ObjectClassHandle federation_class_, federate_class_;
  std::optional<std::uint32_t> slot_;  ///< once it has one
  bool is_subscribed_ = false;
  ReportedObject federation_;
  std::vector<ReportedObject> federates_;  ///< by slot
  std::vector<double> periods_;            ///< by slot: of their reports [s]; 0: none
  std::unordered_map<std::uint32_t, std::uint32_t>
      slots_;  ///< by object, of the federates that they are about
  std::vector<std::byte> values_, before_, changed_;
  std::vector<std::size_t> ends_;
  std::vector<std::uint32_t> deletable_;  ///< by slot: objects that it may delete, counted once per
                                          ///< `notify` that needs it
  bool has_counted_ = false;
};

}  // namespace rink::rti
