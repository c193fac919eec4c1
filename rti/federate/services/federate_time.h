// The services of time management (IEEE 1516.1-2010, clause 8), and what is sent in time-stamp
// order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/services/federate_objects.h"
#include "rti/federate/services/federate_updates.h"
#include "rti/time/federate_clock.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class FederateTime {
 public:
  struct Uses {
    ObjectBook& book;
    const OwnershipBook& ownership;
    SentUpdates& sent;
    Sparing& sparing;
    UpdateSender& sender;
    FederateUpdates& updates;
    FederateObjects& objects;
  };
  /// When something is to be received, and the user's tag.
  struct Moment {
    LogicalTime time;
    std::uint64_t tag = 0;
  };
  FederateTime(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  const FederateClock& clock() const { return clock_; }
  void enable_regulation(double lookahead);
  void disable_regulation();
  void enable_constrained();
  void disable_constrained();
  void request_advance(AdvanceKind kind, LogicalTime time);
  void modify_lookahead(double lookahead);
  void query_bounds();
  void set_asynchronous(bool is_wanted) { clock_.ask_asynchronous(is_wanted); }

  /// In time-stamp order where that is what the object model or `change_order` says and the
  /// federate regulates: only then is there a handle. Messages in receive order are sent at once.
  RetractionHandle update(ObjectHandle object, AttributeSet attributes, Bytes values,
                          const Moment& moment);
  RetractionHandle send(InteractionClassHandle interaction_class, FederateHandle receiver,
                        Bytes parameters, const Moment& moment);
  RetractionHandle delete_instance(ObjectHandle object, const Moment& moment);
  void retract(const RetractionHandle& handle);
  void change_order(ObjectHandle object, AttributeSet attributes, Order order);
  void change_order(InteractionClassHandle interaction_class, Order order);

  bool handle_regulation_enabled(Reader& reader);
  bool handle_constrained_enabled(Reader& reader);
  bool handle_grant(Reader& reader);
  bool handle_retraction(Reader& reader);
  bool handle_bounds(Reader& reader);
  std::size_t memory_bytes() const { return content_.capacity(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, clock_, order_changes_, interaction_orders_, deletions_) &&
           (!Stream::is_reading || is_sound());
  }

 private:
  /// True if orders and deletions are of classes of the model.
  bool is_sound() const;
  const KnownObject& require_known(ObjectHandle object) const;
  void require_class(InteractionClassHandle interaction_class) const;
  AttributeSet timestamped(ObjectHandle object, ObjectClassHandle object_class) const;
  void write_update(const UpdateHeader& header, ObjectHandle object, Bytes values);
  RetractionHandle send_content(const Moment& moment);

  AmbassadorBasis basis_;
  Uses uses_;
  FederateClock clock_;
  std::vector<std::byte> content_;  ///< the message inside one in time-stamp order
  std::unordered_map<std::uint32_t, AttributeSet>
      order_changes_;  ///< objects with changed orders: the attributes in time-stamp order
  std::vector<Order> interaction_orders_;  ///< by class, once one differs from the model
  std::vector<TimedDeletion> deletions_;   ///< as long as they can be taken back
};

}  // namespace rink::rti
