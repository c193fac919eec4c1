// Reads a block of residuals, object by object.
#include "rti/federate/delivery/residual_reader.h"

namespace rink::rti {

bool ResidualReader::handle(Reader& reader, const ReadContext& context) {
  ResidualsMessage message;
  Bytes block;
  if (!exchange(reader, message) || !context.stamp || context.timed != nullptr ||
      message.object_class >= basis_.fom.object_classes().size() ||
      !reader.rest(block, message.size))
    return false;
  ResidualCursor cursor{model_.residual(message.object_class)};
  BitReader bits(block);
  if (cursor.residual.is_empty() || !bits.bits(cursor.order, gap_order_bits)) return false;
  do {
    if (!read_record(bits, message.object_class, cursor, *context.stamp)) return false;
    if (!basis_.phase.is_joined()) return true;
  } while (!is_block_end(bits));
  return true;
}

bool ResidualReader::read_record(BitReader& bits, std::uint16_t object_class,
                                 ResidualCursor& cursor, const Stamp& stamp) {
  std::uint32_t handle = 0;
  AttributeSet attributes;
  if (!exchange_handle(bits, cursor, handle) || !exchange_attributes(bits, cursor, attributes))
    return false;
  const ObjectHandle object{handle};
  const KnownObject* known = objects_.find(object);
  const bool is_gone = known == nullptr && objects_.is_gone(object);
  if (!is_gone && (known == nullptr || known->object_class != object_class)) return false;
  FormerValues* former = former_.find(object);
  values_.clear();
  if (former == nullptr ||
      !model_.decode({object_class, attributes, stamp.time}, *former, bits, values_))
    return ++basis_.counters.residuals_refused, false;
  if (is_gone) return true;
  ++basis_.counters.updates_reflected;
  ++basis_.counters.residuals_received;
  arrivals_.note_from_frame(object, object_class, attributes);
  basis_.callbacks.reflect_attribute_values(object, attributes, values_, stamp);
  return true;
}

std::size_t ResidualReader::memory_bytes() const {
  std::size_t size = former_.memory_bytes() + values_.capacity();
  former_.for_each(
      [&size](ObjectHandle, const FormerValues& each) { size += each.bytes.capacity(); });
  return size;
}

}  // namespace rink::rti
