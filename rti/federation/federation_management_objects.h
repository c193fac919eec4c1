// The RTI as the owner of the management object model's objects (IEEE 1516.1-2010, clause 11); for
// the federation execution's own sources only.
#pragma once

#include <unordered_map>

#include "rti/federation/federation_parts.h"

namespace rink::rti {

/// Made when the first federate subscribes to HLAmanager.HLAfederation or HLAmanager.HLAfederate;
/// while nobody does, there is no object and nothing is worked out. It has a slot among the
/// federates, as the owner of objects, but has not joined: it is sent nothing, and nobody counts
/// it.
class FederationParts::ManagementObjects {
 public:
  explicit ManagementObjects(FederationParts& parts);

  /// Somebody's subscriptions changed: to whom it now hears anything, everything is up to date at
  /// the next flush.
  void subscribed(std::uint32_t slot);
  void joined(std::uint32_t slot);
  /// While it is still known what it was.
  void left(std::uint32_t slot);
  /// Its period of reports has changed: the next one is due a period from now.
  void timed(std::uint32_t slot) {
    told_of(slot).due_at = parts_.now_ + parts_.federates_[slot].report_period;
  }
  /// HLAautoProvide has changed.
  void switched() { federation_.is_due = static_cast<bool>(federation_.object); }
  /// Once per flush, before it.
  void tell();
  static bool is_heard(const FederationParts& parts);

 private:
  /// One object of ours.
  struct Told {
    ObjectHandle object;  ///< none: not registered
    AttributeSet asked;
    bool is_due = false;
    double due_at = 0.0;  ///< the next report, if a period is set [s]
    unsigned state = 0;   ///< of time management, as it was told: it is told when it changes
  };
  void begin();
  void end();
  void add(Told& told, ObjectClassHandle object_class);
  void remove(Told& told);
  /// They are told whether they have changed or not.
  void ask(ObjectHandle object, AttributeSet attributes);
  Told& told_of(std::uint32_t slot);
  void tell_federation();
  void tell_federate(std::uint32_t slot, Told& told);
  unsigned state_of(std::uint32_t slot) const;
  /// The values of the class's attributes are in `values_`, those of attribute k up to `ends_[k]`:
  /// tells those that differ from what was told, and those asked for.
  void update(Told& told);
  void begin_values(ObjectClassHandle object_class);
  template <class Write>
  void value(Write write);

  FederationParts& parts_;
  ObjectClassHandle federation_class_, federate_class_;
  std::uint32_t slot_;
  bool is_heard_ = false;
  Told federation_;
  std::vector<Told> federates_;  ///< by slot
  std::unordered_map<std::uint32_t, std::uint32_t>
      slots_;  ///< by object, of the federates that they are about
  std::vector<std::byte> values_, before_, changed_;
  std::vector<std::size_t> ends_;
  std::vector<std::uint32_t> deletable_;  ///< by slot: objects that it may delete, worked out once
                                          ///< per `tell` that needs it
  bool has_counted_ = false;
};

}  // namespace rink::rti
