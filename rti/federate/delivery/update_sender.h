// Sends updates to the RTI: by datagram where there is a channel, else by the stream, and never out
// of order between the two.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rti/buffering/datagram_batch.h"
#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/declared_classes.h"
#include "rti/federate/books/ownership_book.h"
#include "rti/federate/delivery/link_watch.h"
#include "rti/federate/delivery/sent_updates.h"
#include "rti/federate/delivery/update_arrivals.h"
#include "rti/wire/datagram.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class BestEffortOutbox;

/// Values are coded. Its buffers differ from those of receiving: callbacks may send.
class UpdateSender {
 public:
  struct Uses {
    const ObjectBook& objects;
    const OwnershipBook& ownership;
    const DeclaredClasses& classes;
    const UpdateArrivals& arrivals;
    const LinkWatch& watch;
    SentUpdates& sent;
  };
  UpdateSender(const AmbassadorBasis& basis, const Uses& uses);
  ~UpdateSender();

  /// Opens a channel for datagrams of at most so many bytes; 0 closes it.
  void expect_datagrams(std::size_t size_max);
  /// Sends each attribute by its own channel.
  void send(const UpdateHeader& header, ObjectHandle object, Bytes values);
  void send_by_stream(const UpdateHeader& header, ObjectHandle object, Bytes values);
  /// Call it before anything about these attributes is sent by the stream: it seals pending
  /// datagrams of them and ends the frame, so that both keep their order.
  void before_stream(ObjectHandle object, ObjectClassHandle object_class, AttributeSet attributes);

  /// Sends again by the stream what was sent by datagram, since it may outlive its owner or change
  /// owners: of an object, of a class, of all.
  void release(ObjectHandle object, AttributeSet attributes);
  void release(ObjectClassHandle object_class);
  void release_all();
  /// From now on everything is sent by the stream, since the federate uses time management.
  void keep_time();
  void make_reliable(ObjectHandle object, AttributeSet attributes);
  void make_best_effort(ObjectHandle object, AttributeSet attributes);
  void forget(ObjectHandle object);

  /// Sends the present values of what was lost again: by datagram or, if the channel has closed, by
  /// the stream.
  void repair();
  /// False if it acknowledges a datagram that was never sent.
  bool acknowledge(const AcknowledgeDatagramsMessage& message);
  /// The datagrams to send, `acknowledgement` first if it is not empty. Valid until
  /// `clear_datagrams`.
  std::span<const Datagram> datagrams(Bytes acknowledgement);
  void clear_datagrams();
  std::size_t memory_bytes() const;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, made_reliable_);
  }

 private:
  AttributeSet by_datagram(ObjectHandle object, ObjectClassHandle object_class) const;
  AttributeSet send_by_datagram(const UpdateHeader& header, ObjectHandle object, Bytes& values);

  AmbassadorBasis basis_;
  Uses uses_;
  std::unique_ptr<BestEffortOutbox> outbox_;  ///< null until there is a channel and something to
                                              ///< send
  ObjectMap<AttributeSet> made_reliable_;     ///< of own objects
  bool keeps_time_ = false;
  std::vector<std::byte> best_effort_values_, other_values_;  ///< parts of the update that is sent
  std::vector<Datagram> datagrams_;                           ///< that go out
};

}  // namespace rink::rti
