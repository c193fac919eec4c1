// Reads updates that travel as residuals to the values before.
#pragma once

#include <cstddef>
#include <vector>

#include "rti/baselines/residual_bits.h"
#include "rti/baselines/residual_model.h"
#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/object_book.h"
#include "rti/federate/delivery/update_arrivals.h"
#include "rti/federate/read_context.h"
#include "rti/objects/object_map.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Keeps, of each object that has attributes with residuals, the values that the stream brought
/// last. The RTI knows which those are: a residual without them is no fault of the network.
class ResidualReader {
 public:
  ResidualReader(const AmbassadorBasis& basis, const ObjectBook& objects, UpdateArrivals& arrivals)
      : basis_(basis), objects_(objects), arrivals_(arrivals), model_(basis.fom) {}

  /// True if values of the class must be noted by `keep`.
  bool is_concerned(std::uint16_t object_class, AttributeSet attributes) const {
    return !(model_.kept(object_class) & attributes).is_empty();
  }
  void keep(ObjectHandle object, std::uint16_t object_class, AttributeSet attributes,
            Bytes values) {
    model_.keep(object_class, attributes, values, former_[object]);
  }
  /// Appends what was noted of the object; false unless that is all of `attributes`.
  bool append_held(ObjectHandle object, std::uint16_t object_class, AttributeSet attributes,
                   std::vector<std::byte>& values) const;
  bool handle(Reader& reader, const ReadContext& context);
  /// The RTI has removed the object.
  void forget(ObjectHandle object) { former_.erase(object); }
  std::size_t memory_bytes() const;
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, former_) && (!Stream::is_reading || is_sound());
  }

 private:
  /// True if all values are of known objects and of their classes.
  bool is_sound() const;
  struct Block {
    std::uint16_t object_class;
    const Stamp& stamp;
    BitReader& bits;
    ResidualCursor& cursor;
  };
  bool read_records(const Block& block);
  bool read_record(const Block& block, ObjectHandle object, const FormerChange* companion,
                   FormerChange* change);

  AmbassadorBasis basis_;
  const ObjectBook& objects_;
  UpdateArrivals& arrivals_;
  ResidualModel model_;
  ObjectMap<FormerValues> former_;
  std::vector<std::byte> values_;
  FormerChange change_;  ///< to which a companion refers
};

}  // namespace rink::rti
