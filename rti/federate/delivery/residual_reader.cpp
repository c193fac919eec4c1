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
  if (cursor.residual.is_empty() || !bits.bits(cursor.order, gap_order_bits) ||
      !bits.bits(cursor.companion_order, gap_order_bits))
    return false;
  const Block of{message.object_class, *context.stamp, bits, cursor};
  do {
    if (!read_records(of)) return false;
    if (!basis_.phase.is_joined()) return true;
  } while (!is_block_end(bits));
  return true;
}

/// Reads a record and its companion, if one follows.
bool ResidualReader::read_records(const Block& block) {
  std::uint32_t handle = 0;
  bool has_companion = false;
  if (!exchange_handle(block.bits, block.cursor, handle) || !block.bits.flag(has_companion))
    return false;
  if (!has_companion) return read_record(block, {handle}, nullptr, nullptr);
  if (!read_record(block, {handle}, nullptr, &change_)) return false;
  if (!basis_.phase.is_joined()) return true;
  return exchange_companion(block.bits, block.cursor, handle) &&
         read_record(block, {handle}, &change_, nullptr);
}

/// Notes the change if `change` is there.
bool ResidualReader::read_record(const Block& block, ObjectHandle object,
                                 const FormerChange* companion, FormerChange* change) {
  AttributeSet attributes;
  if (!exchange_attributes(block.bits, block.cursor, attributes)) return false;
  const KnownObject* known = objects_.find(object);
  const bool is_gone = known == nullptr && objects_.is_gone(object);
  if (!is_gone && (known == nullptr || known->object_class != block.object_class)) return false;
  FormerValues* former = former_.find(object);
  if (former != nullptr && change != nullptr) change->before = *former;
  values_.clear();
  if (former == nullptr ||
      !model_.decode({block.object_class, attributes, block.stamp.time, companion}, *former,
                     block.bits, values_))
    return ++basis_.counters.residuals_refused, false;
  if (change != nullptr) change->attributes = attributes, change->after = former->bytes;
  if (is_gone) return true;
  ++basis_.counters.updates_reflected;
  ++basis_.counters.residuals_received;
  arrivals_.note_from_frame(object, block.object_class, attributes);
  basis_.callbacks.reflect_attribute_values(object, attributes, values_, block.stamp);
  return true;
}

bool ResidualReader::append_held(ObjectHandle object, std::uint16_t object_class,
                                 AttributeSet attributes, std::vector<std::byte>& values) const {
  const FormerValues* former = former_.find(object);
  return former != nullptr && model_.append(object_class, attributes, *former, values);
}

std::size_t ResidualReader::memory_bytes() const {
  std::size_t size = former_.memory_bytes() + values_.capacity() + change_.before.bytes.capacity() +
                     change_.after.capacity();
  former_.for_each(
      [&size](ObjectHandle, const FormerValues& each) { size += each.bytes.capacity(); });
  return size;
}

bool ResidualReader::is_sound() const {
  bool is_sound = true;
  former_.for_each([&](ObjectHandle object, const FormerValues& former) {
    const KnownObject* const known = objects_.find(object);
    is_sound &= former.held.is_empty() ||
                (known != nullptr && known->object_class < basis_.fom.object_classes().size() &&
                 model_.is_sound(known->object_class, former));
  });
  return is_sound;
}

}  // namespace rink::rti
