// Periodic state as a federate receives it: differences to keyframes that it keeps and has
// acknowledged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/baselines/keyframe_memory.h"
#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/object_book.h"
#include "rti/federate/delivery/update_arrivals.h"
#include "rti/federate/read_context.h"
#include "rti/fom/quantised_codec.h"
#include "rti/wire/bit_stream.h"

namespace rink::rti {

struct DeltaHeader;

class KeyframeReader {
 public:
  KeyframeReader(const AmbassadorBasis& basis, const ObjectBook& objects, UpdateArrivals& arrivals)
      : basis_(basis), objects_(objects), arrivals_(arrivals) {}

  bool handle_begin(Reader& reader);
  bool handle_deltas(Reader& reader, const ReadContext& context);
  /// The frame has ended, and with it the keyframe in it, if any.
  void end_frame();
  /// Keyframes of a restored federation have numbers of their own.
  void forget_all() { keyframes_ = {}; }
  std::size_t memory_bytes() const { return keyframes_.memory_bytes() + decoded_.capacity(); }

 private:
  enum class Status : std::uint8_t { decoded, no_baseline, malformed };
  /// The common header of the records of one message.
  struct Block {
    std::uint16_t object_class;
    AttributeHandle attribute;
    const QuantisedCodec& codec;
    const DeltaHeader& header;
    Stamp stamp;
  };
  std::optional<bool> read_records(BitReader& bits, const Block& block);
  Status read_record(BitReader& bits, const Block& block, std::uint32_t object);
  Status read_differences(BitReader& bits, const Block& block, std::uint32_t object,
                          QuantisedCodec::Counts& counts);
  void reflect(const Block& block, ObjectHandle object);

  AmbassadorBasis basis_;
  const ObjectBook& objects_;
  UpdateArrivals& arrivals_;
  KeyframeMemory keyframes_;
  std::vector<std::byte> decoded_;  ///< the value of the record that is read
};

}  // namespace rink::rti
