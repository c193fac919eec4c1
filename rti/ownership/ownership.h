// The owner of each attribute of each object, offers and claims: clause 7 of IEEE 1516.1-2010 as
// one state machine, without messages.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/fom/fom.h"
#include "rti/objects/object_table.h"
#include "rti/wire/bytes.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// A notice that some federate must get. Views are valid until the next operation.
struct OwnershipEvent {
  enum class Kind : std::uint8_t {
    acquired,                ///< it owns these now
    unavailable,             ///< its claim to these has ended without success
    cancelled,               ///< its claim to these has ended as it asked
    release_requested,       ///< it owns these and another federate wants them
    confirmation_requested,  ///< it offers these and another federate wants them: it may confirm
    offered,  ///< these need an owner; `federate` is no_federate: notify all that may own them
  };
  Kind kind;
  std::uint32_t federate;   ///< its slot
  AttributeSet attributes;  ///< never empty
};

/// The RTI's record of ownership. An object whose attributes all belong to one federate, with no
/// negotiation about them, has only `Object::owner`; only other objects have a record, so those
/// that never change owners cost one comparison. All operations take sets, so a handover of many
/// attributes costs as much as one of one.
///
/// An attribute is unowned, or owned and then possibly *offered* (negotiated divestiture), of which
/// *confirming* (somebody takes it, its owner was asked to confirm). Each may have any number of
/// claims in the order in which they came: regular ones wait until they are met, denied or
/// cancelled; those *if available* only while the attribute is offered. Invariants: an unowned
/// attribute is not offered and has no claim; an offered one is confirming if and only if it has
/// one; one that is not offered has no claim if available. A federate loses an attribute only by
/// its own request or consent.
class Ownership {
 public:
  using Events = std::span<const OwnershipEvent>;
  Ownership(const Fom& fom, ObjectTable& objects) : fom_(fom), objects_(objects) {}

  /// All that can be owned of an object: the attributes of its class and the privilege to delete
  /// it.
  AttributeSet all(ObjectSlot object) const;
  AttributeSet owned_by(std::uint32_t federate, ObjectSlot object) const;
  AttributeSet unowned(ObjectSlot object) const;
  /// The attributes that federates other than `federate` own.
  AttributeSet owned_by_others(std::uint32_t federate, ObjectSlot object) const;
  /// The owner of one attribute, or no_federate.
  std::uint32_t owner_of(ObjectSlot object, AttributeHandle attribute) const;
  /// Calls `visit(federate)` for each owner of a divided object.
  template <class Visit>
  void for_each_owner(ObjectSlot object, Visit visit) const {
    const Record* record = find(object);
    assert(record != nullptr);
    for (const Share& each : record->shares) visit(each.federate);
  }
  AttributeSet offered(ObjectSlot object) const;
  /// Of the offered attributes, those whose owner was asked to confirm, since another federate
  /// wants them.
  AttributeSet confirming(ObjectSlot object) const;
  /// The attributes that `federate` waits for, by either kind of acquisition.
  AttributeSet sought_by(std::uint32_t federate, ObjectSlot object) const;
  /// The tag of the latest offer of this object.
  Bytes offer_tag(ObjectSlot object) const;

  /// Operations of an owner; `attributes` must have no others than it owns.
  Events divest(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);
  Events offer(std::uint32_t federate, ObjectSlot object, AttributeSet attributes, Bytes tag);
  Events withdraw_offer(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);
  Events deny_release(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);
  /// Gives each wanted attribute to the federate that asked first; the others stay. Both a
  /// confirmation and a divestiture if wanted do this.
  Events give(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);

  /// Operations of a claimant; attributes that it owns are left out here.
  Events acquire(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);
  Events acquire_if_available(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);
  Events cancel(std::uint32_t federate, ObjectSlot object, AttributeSet attributes);

  /// Ends the federate's claims without a notice to it.
  void forget_claims(std::uint32_t federate);
  /// Call it before the object is erased.
  void forget(ObjectSlot object);

  /// Calls `visit(object)` for each object that is divided or negotiated about. `visit` must not
  /// change ownership.
  template <class Visit>
  void for_each_record(Visit visit) const {
    for (const Record& each : records_)
      if (each.object != no_object) visit(each.object);
  }
  std::size_t record_count() const { return records_.size() - free_.size(); }
  /// Asserts the invariants above of all records, and that objects and records lead to each other.
  void check() const;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, records_, free_);
  }

 private:
  struct Share {
    std::uint32_t federate;
    AttributeSet attributes;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, federate, attributes);
    }
  };
  struct Claim {
    std::uint32_t federate;
    AttributeSet attributes;
    bool is_if_available;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, federate, attributes, is_if_available);
    }
  };
  struct Record {
    ObjectSlot object = no_object;
    std::vector<Share> shares;  ///< by owner; none is empty
    AttributeSet offered, confirming;
    std::vector<Claim> claims;  ///< in the order of asking; none is empty
    std::vector<std::byte> tag;
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, object, shares, offered, confirming, claims, tag);
    }
  };
  const Record* find(ObjectSlot object) const;
  void check(const Record& record) const;
  Record& open(ObjectSlot object);
  void close_if_settled(Record& record);
  void notify(OwnershipEvent::Kind kind, std::uint32_t federate, AttributeSet attributes);
  void notify_owners(OwnershipEvent::Kind kind, const Record& record, AttributeSet attributes);
  void transfer(Record& record, AttributeSet attributes, std::uint32_t to);
  AttributeSet give_to_claimants(Record& record, AttributeSet attributes);
  void end_claims(Record& record, AttributeSet attributes, bool also_regular);
  void drop_empty_claims(Record& record);

  const Fom& fom_;
  ObjectTable& objects_;
  std::vector<Record> records_;
  std::vector<std::uint32_t> free_;
  std::vector<OwnershipEvent> events_;
};

}  // namespace rink::rti
