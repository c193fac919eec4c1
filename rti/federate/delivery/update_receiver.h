// Reads and decodes updates and interactions of others, and delivers them by callbacks.
#pragma once

#include <cstddef>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/object_book.h"
#include "rti/federate/delivery/residual_reader.h"
#include "rti/federate/delivery/update_arrivals.h"
#include "rti/federate/read_context.h"
#include "rti/wire/stamp_steps.h"

namespace rink::rti {

/// Its buffers differ from those of sending: a callback may send updates while it reads values.
class UpdateReceiver {
 public:
  UpdateReceiver(const AmbassadorBasis& basis, const ObjectBook& objects, UpdateArrivals& arrivals,
                 ResidualReader& residuals)
      : basis_(basis), objects_(objects), arrivals_(arrivals), residuals_(residuals) {}

  static bool handle_stamp(Reader& reader, ReadContext& context);
  bool handle_stamp_step(Reader& reader, ReadContext& context);
  /// Handles updates from a frame, which are newer than all that came before.
  bool handle_updates(Reader& reader, const ReadContext& context);
  /// Reflects the values of an object that a block of entries brought; false if they are malformed
  /// or the federate has left.
  bool reflect_entry(const EntriesMessage& block, ObjectHandle object, Bytes coded,
                     const ReadContext& context);
  /// The same of values that are as in memory, since the federate held them.
  bool reflect_held(const EntriesMessage& block, ObjectHandle object, Bytes values,
                    const ReadContext& context);
  /// Handles updates from a datagram: of its best-effort values, those that are not older than the
  /// known ones.
  bool handle_datagram_updates(Reader& reader, const DatagramHead& head,
                               const ReadContext& context);
  bool handle_interaction(Reader& reader, const ReadContext& context);
  std::size_t memory_bytes() const { return decoded_.capacity() + chosen_.capacity(); }

 private:
  struct Block {
    const ObjectClass& object_class;
    AttributeSet attributes;
    Stamp stamp;
  };
  /// What is done with each record of a block from a frame.
  struct FrameBlock {
    Block of;
    std::uint16_t number;  ///< of the class
    bool has_codec, has_residuals;
    const TimedStamp* timed;
  };
  FrameBlock frame_block(std::uint16_t number, AttributeSet attributes,
                         const ReadContext& context) const;
  bool reflect(const FrameBlock& block, ObjectHandle object, Bytes values);
  bool deliver(const FrameBlock& block, ObjectHandle object, Bytes values);
  bool reflect_datagram(const Block& block, ObjectHandle object, AttributeSet accepted,
                        Bytes values);
  Bytes choose(const Block& block, AttributeSet accepted, Bytes values);

  AmbassadorBasis basis_;
  const ObjectBook& objects_;
  UpdateArrivals& arrivals_;
  ResidualReader& residuals_;
  StampSteps stamp_steps_;
  std::vector<std::byte> decoded_;
  std::vector<std::byte> chosen_;  ///< of the values of a datagram
};

}  // namespace rink::rti
