// Updates on their way to the RTI: by datagram where there is a way, else by the stream, and never
// out of order between the two.
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

namespace rink::rti {

class BestEffortOutbox;

/// Values are coded. Its buffers are not those of what is received: callbacks may send.
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

  /// There is a way for datagrams of at most so many bytes; 0: none any more.
  void expect_datagrams(std::size_t size_max);
  /// By whichever way each attribute goes.
  void send(const UpdateHeader& header, ObjectHandle object, Bytes values);
  void send_by_stream(const UpdateHeader& header, ObjectHandle object, Bytes values);
  /// Something about these attributes goes by the stream. What was sent of any by datagram was sent
  /// before: in a frame that is over.
  void before_stream(ObjectHandle object, ObjectClassHandle object_class, AttributeSet attributes);

  /// Sends by the stream what went by datagram, for it may outlive its owner or go to another: of
  /// an object, of a class, of all.
  void release(ObjectHandle object, AttributeSet attributes);
  void release(ObjectClassHandle object_class);
  void release_all();
  /// Who keeps time sends everything by the stream.
  void keep_time();
  void make_reliable(ObjectHandle object, AttributeSet attributes);
  void make_best_effort(ObjectHandle object, AttributeSet attributes);
  void forget(ObjectHandle object);

  /// What was lost is sent again as it is now: by datagram or, if there is no way any more, by the
  /// stream.
  void repair();
  /// False if it acknowledges what was never sent.
  bool acknowledge(const AcknowledgeDatagramsMessage& message);
  /// An acknowledgement of ours goes first, if there is one. Valid until `clear_datagrams`.
  std::span<const Datagram> datagrams(Bytes acknowledgement);
  void clear_datagrams();
  std::size_t memory_bytes() const;

 private:
  AttributeSet by_datagram(ObjectHandle object, ObjectClassHandle object_class) const;
  AttributeSet send_by_datagram(const UpdateHeader& header, ObjectHandle object, Bytes& values);

  AmbassadorBasis basis_;
  Uses uses_;
  std::unique_ptr<BestEffortOutbox> outbox_;  ///< null until there is a way and something to send
  ObjectMap<AttributeSet> made_reliable_;     ///< of objects of ours
  bool keeps_time_ = false;
  std::vector<std::byte> best_effort_values_, other_values_;  ///< of the update at hand, parted
  std::vector<Datagram> datagrams_;                           ///< that go out
};

}  // namespace rink::rti
