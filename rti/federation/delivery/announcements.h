// Announces to a federate which objects come into its scope and which go out of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/ownership_service.h"
#include "rti/federation/services/update_requests.h"
#include "rti/wire/object_block.h"

namespace rink::rti {

class Announcements {
 public:
  struct Uses {
    DataDistribution& distribution;
    OwnershipService& owners;
    UpdateRequests& requests;
    const NewestStamps& newest;
  };
  Announcements(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  /// Writes the exits and gathers the entries, as many as fit into the frame up to `end`; the
  /// others stay unannounced until a later flush.
  void write(FlushContext& context, std::size_t end);
  /// True for an entry that was gathered and is not written yet.
  bool is_gathered(ObjectSlot object) const { return entering_.contains(object); }
  /// The caller writes the entry; true if the federate does not know the object yet.
  bool take(ObjectSlot object);
  /// Writes the gathered entries that nobody took, which come without values.
  void write_gathered(FlushContext& context);
  /// Bytes that these take at most.
  std::size_t gathered_bytes_max() const { return gathered_ * entry_bytes_max; }
  /// Notes this flush's changes of scope for the federate's next turn, which writes what they come
  /// to: nothing for an object that is out of scope and back.
  void postpone(FederateInterest& interest);
  /// A message in time-stamp order names the object: the next flush announces it and sends its
  /// state before all else.
  void send_state_now(std::uint32_t slot, ObjectSlot object);

 private:
  void write_postponed_exits(FlushContext& context);
  void write_postponed(FlushContext& context, std::size_t end);
  void write_event(FlushContext& context, const ScopeEvent& event, std::size_t end);
  void gather(FlushContext& context, ObjectSlot object);
  void put_gathered(GatheredFrame& frame);
  /// True if the federate does not know the object yet, which has its default name.
  bool introduce(std::uint32_t slot, ObjectSlot object, std::vector<std::byte>& bytes);
  /// True if the object may not be discovered any more.
  bool is_too_late(const FederateInterest& interest, ObjectSlot object) const {
    return basis_.objects[object].is_leaving && !interest.known.contains(object);
  }

  /// A discovery with a default name, and the object of a block of its own.
  static constexpr std::size_t entry_bytes_max = 16;

  FederationBasis basis_;
  Uses uses_;
  ObjectBlockWriter block_;         ///< of the frame at hand
  Bitmap entering_, undiscovered_;  ///< the entries gathered, and those of unknown objects
  std::size_t gathered_ = 0;        ///< in `entering_`
};

}  // namespace rink::rti
