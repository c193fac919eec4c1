// Reads records of periodic state, each a value in full or differences to a keyframe.
#include "rti/federate/delivery/keyframe_reader.h"

#include <cassert>

#include "rti/baselines/delta_bits.h"
#include "rti/wire/baseline_messages.h"

namespace rink::rti {

bool KeyframeReader::handle_begin(Reader& reader) {
  BeginKeyframeMessage message;
  if (!exchange(reader, message)) return false;
  keyframes_.begin(message.number);
  return true;
}

void KeyframeReader::end_frame() {
  if (!keyframes_.is_open()) return;
  const std::optional<std::uint16_t> number = keyframes_.seal();
  if (!basis_.phase.is_joined()) return;
  assert(number);
  basis_.frames.enqueue(AcknowledgeKeyframeMessage{*number});
  ++basis_.counters.keyframes_acknowledged;
}

bool KeyframeReader::handle_deltas(Reader& reader, const ReadContext& context) {
  DeltasMessage message;
  if (!exchange(reader, message) || !context.stamp ||
      message.object_class >= basis_.fom.object_classes().size())
    return false;
  const ObjectClassHandle handle{message.object_class};
  const std::optional<AttributeHandle> attribute = basis_.fom.periodic_attribute(handle);
  if (!attribute) return false;
  const QuantisedCodec& codec = *basis_.fom.at(handle).attributes[attribute->value].baselines;
  BitReader bits(reader.rest());
  DeltaHeader header;
  if (!exchange(bits, header, codec.fields().size())) return false;
  if (header.has_baseline) keyframes_.drop_before(header.baseline);
  const std::optional<bool> has_baselines =
      read_records(bits, {message.object_class, *attribute, codec, header, *context.stamp});
  if (!has_baselines) return false;
  if (!basis_.phase.is_joined()) return true;
  if (!*has_baselines) basis_.frames.enqueue(RefuseKeyframeMessage{header.baseline});
  Bytes read;
  return bits.finish() && reader.rest(read, bits.bytes_read());
}

/// True if every baseline was known; nothing if the block is malformed. Stops where a callback
/// resigns.
std::optional<bool> KeyframeReader::read_records(BitReader& bits, const Block& block) {
  bool has_baselines = true;
  for (std::uint32_t object = 0;;) {
    const HandleReader::Next next = read_handle(bits, object);
    if (next == HandleReader::Next::end) return has_baselines;
    if (next != HandleReader::Next::handle) return std::nullopt;
    const KnownObject* known = objects_.find({object});
    const bool is_gone = known == nullptr && objects_.is_gone({object});
    if (!is_gone && (known == nullptr || known->object_class != block.object_class))
      return std::nullopt;
    const Status status = read_record(bits, block, object);
    if (status == Status::malformed) return std::nullopt;
    if (status == Status::no_baseline) {
      has_baselines = false;
      ++basis_.counters.differences_refused;
    } else if (!is_gone) {
      reflect(block, {object});
      if (!basis_.phase.is_joined()) return has_baselines;
    }
  }
}

void KeyframeReader::reflect(const Block& block, ObjectHandle object) {
  ++basis_.counters.updates_reflected;
  const AttributeSet attributes{block.attribute};
  arrivals_.note_from_frame(object, block.object_class, attributes);
  basis_.callbacks.reflect_attribute_values(object, attributes, decoded_, block.stamp);
}

/// Decodes one record into `decoded_` and keeps it if it belongs to a keyframe.
KeyframeReader::Status KeyframeReader::read_record(BitReader& bits, const Block& block,
                                                   std::uint32_t object) {
  bool is_absolute = false;
  if (!bits.flag(is_absolute) || (!is_absolute && !block.header.has_baseline))
    return Status::malformed;
  decoded_.clear();
  QuantisedCodec::Counts counts{};
  if (is_absolute) {
    const std::optional<bool> is_quantised = block.codec.decode(bits, counts, decoded_);
    if (!is_quantised) return Status::malformed;
    if (!*is_quantised) return Status::decoded;  // in full: no baseline for later differences
  } else {
    const Status status = read_differences(bits, block, object, counts);
    if (status != Status::decoded) return status;
  }
  if (keyframes_.is_open())
    keyframes_.add(object, block.stamp.time, std::span(counts).first(block.codec.fields().size()));
  return Status::decoded;
}

KeyframeReader::Status KeyframeReader::read_differences(BitReader& bits, const Block& block,
                                                        std::uint32_t object,
                                                        QuantisedCodec::Counts& counts) {
  assert(block.header.has_baseline);
  const std::optional<KeyframeMemory::Baseline> baseline =
      keyframes_.find(block.header.baseline, object);
  if (!baseline || baseline->counts.size() != block.codec.fields().size())
    return skip_differences(bits, block.codec, block.header.orders) ? Status::no_baseline
                                                                    : Status::malformed;
  QuantisedCodec::Counts predicted{};
  predict(block.codec, baseline->counts, block.stamp.time - baseline->time, predicted);
  if (!exchange_differences(bits, block.codec, block.header.orders, predicted, counts))
    return Status::malformed;
  block.codec.append_value(counts, decoded_);
  return Status::decoded;
}

}  // namespace rink::rti
