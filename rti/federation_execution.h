// The RTI's central component: one federation execution. Bytes and time in, bytes out; no I/O, no
// clock, no thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "im/filter.h"
#include "rti/baselines/baseline_counters.h"
#include "rti/central_component.h"
#include "rti/federate_ambassador.h"
#include "rti/federation_counters.h"
#include "rti/federation_services.h"
#include "rti/federation_settings.h"
#include "rti/fom/fom.h"
#include "rti/management/federation_report.h"
#include "rti/objects/bitmap.h"
#include "rti/objects/object_table.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

class FederationParts;

/// A region that a federate subscribes with, as it last committed it.
struct SubscribedRegion {
  FederateHandle federate;
  im::Region bounds;
};

/// Owns federates, declarations, objects with their latest values, synchronisation points and
/// regions. A tick is: any number of `receive`, then `match`, which alone decides who receives
/// what, then `flush`. Connections that break a rule are forgotten at once, counted by reason, and
/// passed to `Outlet::drop` by the next flush; the others see no more than a lost federate.
class FederationExecution final : public CentralComponent {
 public:
  /// `fom` must outlive it. Throws std::invalid_argument naming the known filters if there is none
  /// called `settings.filter`.
  FederationExecution(const Fom& fom, const FederationSettings& settings,
                      const FederationServices& services = {});
  ~FederationExecution() override;
  FederationExecution(const FederationExecution&) = delete;
  FederationExecution& operator=(const FederationExecution&) = delete;

  /// Connection ids may be any numbers that are not connected now; small ones are dense.
  void connect(ConnectionId connection) override;
  void receive(ConnectionId connection, Bytes bytes) override;
  void receive_datagram(ConnectionId connection, Bytes datagram) override;
  void disconnect(ConnectionId connection, std::string_view why) override;
  std::optional<ConnectionId> oldest_stranger(const ConnectionTest& test) const override;
  /// Drops connections that have been silent for too long.
  void advance_clock(double now, bool is_behind) override;
  using CentralComponent::advance_clock;
  /// What the host of a federation knows and the filter may use (docs/rti.md, "What a filter knows
  /// beside regions"): teams, owners, and which objects are always relevant. A federate receives
  /// every object that has its owner's number, whatever the filter decides. A role of something
  /// that does not exist is ignored; a role ends with its bearer.
  void set_object_role(ObjectHandle object, const im::Role& role);
  void set_federate_role(FederateHandle federate, const im::Role& role);
  /// The direction in which a federate looks, the motion of an object since it last committed its
  /// region, and the time [s]: all are finite, and time never goes back.
  void set_federate_heading(FederateHandle federate, const im::Heading& heading);
  void set_object_flight(ObjectHandle object, const im::Flight& flight);
  /// What conditions may ask (im/filter.h): of an object since it last committed its region.
  void set_object_facts(ObjectHandle object, const im::Facts& facts);
  void set_federate_facts(FederateHandle federate, const im::Facts& facts);
  void set_time(double now);
  /// Runs the filter and turns its changes into scope changes.
  void match() override;
  void flush(Outlet& outlet) override;

  const std::string& name() const;
  const Fom& fom() const;
  std::size_t federate_count() const;
  std::size_t object_count() const;
  /// True if `object` is in `federate`'s scope since the last match; for tests against brute force.
  bool is_in_scope(FederateHandle federate, ObjectHandle object) const;
  /// Appends every object that is in `federate`'s scope since the last match, in no particular
  /// order.
  void list_scope(FederateHandle federate, std::vector<ObjectHandle>& objects) const;
  /// How many flushes have sent `federate` values at its turn since it joined; 0 if it left.
  std::uint64_t times_updated(FederateHandle federate) const;
  /// Appends every region with bounds that a federate subscribes with.
  void list_subscribed_regions(std::vector<SubscribedRegion>& regions) const;
  /// Sends `content`, at most HostMessage::size_max bytes (asserted), to one federate behind all
  /// else of the next flush; the RTI does not look into it. A federate that left is sent nothing.
  void send_host_message(FederateHandle federate, Bytes content);
  /// Changes of scope and values go to `federate` at this rate from now on, all else at once
  /// (docs/rti.md, "Update rates"). Throws std::invalid_argument if `rate` is not
  /// valid. Not for federates that are constrained by time, which never wait.
  void set_update_rate(FederateHandle federate, UpdateRate rate);
  /// Updates of `object` with any of `attributes` go to `federate` at once, whatever its rate: one
  /// object each, its own. What does not exist is ignored.
  void send_at_once(FederateHandle federate, ObjectHandle object, AttributeSet attributes);
  /// Whether the federate has sent the host a notice (Ambassador::notify_host) since the last call.
  bool take_notice(FederateHandle federate);
  /// From now on the host itself tells `federate` of the objects of `object_class`: their scope is
  /// decided as before, but neither discoveries, changes of scope nor values are sent. With an
  /// empty handle all in scope is announced and sent anew.
  void serve_by_host(FederateHandle federate, ObjectClassHandle object_class);
  /// The slots of the objects in `federate`'s scope since the last match; null if it left. Valid
  /// until the next match.
  const Bitmap* scope(FederateHandle federate) const;
  /// `no_object` if there is none; used again some time after the object is gone.
  ObjectSlot slot_of(ObjectHandle object) const;
  /// Appends who subscribes to an attribute of the class, with whatever regions.
  void list_subscribers(ObjectClassHandle object_class, AttributeHandle attribute,
                        std::vector<FederateHandle>& federates) const;
  const FederationCounters& counters() const;
  const BaselineCounters& baseline_counters() const;
  /// Computed on the call, by counting objects and scopes one by one; includes the outlet's queues
  /// if there is an outlet.
  FederationReport report(const Outlet* outlet = nullptr) const;
  const im::Filter& filter() const;
  const DataDistribution& distribution() const;

 private:
  std::unique_ptr<FederationParts> make(const Fom& fom, const FederationSettings& settings,
                                        const FederationServices& services);

  std::unique_ptr<FederationParts> parts_,
      prepared_;  ///< of the save that is being restored
};

}  // namespace rink::rti
