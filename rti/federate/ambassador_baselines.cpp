// Periodic state as a federate hears it: differences to keyframes that it keeps and has
// acknowledged.
#include "rti/baselines/delta_bits.h"
#include "rti/federate/ambassador_services.h"
#include "rti/wire/baseline_messages.h"

namespace rink::rti {

bool AmbassadorParts::take_keyframe(Reader& reader) {
  BeginKeyframeMessage message;
  if (!exchange(reader, message)) return false;
  keyframes_.begin(message.number);
  return true;
}

void AmbassadorParts::end_keyframe() {
  if (!keyframes_.is_open()) return;
  const std::optional<std::uint16_t> number = keyframes_.seal();
  if (!phase_.is_joined()) return;
  frames_.enqueue(AcknowledgeKeyframeMessage{*number});
  ++counters_.keyframes_acknowledged;
}

bool AmbassadorParts::take_deltas(Reader& reader, const ReadContext& context) {
  DeltasMessage message;
  if (!exchange(reader, message) || !context.stamp ||
      message.object_class >= fom_.object_classes().size())
    return false;
  const std::optional<AttributeHandle> attribute = fom_.periodic_attribute({message.object_class});
  if (!attribute) return false;
  const QuantisedCodec& codec =
      *fom_.at(ObjectClassHandle{message.object_class}).attributes[attribute->value].baselines;
  BitReader bits(reader.rest());
  DeltaHeader header;
  if (!exchange(bits, header, codec.fields().size())) return false;
  if (header.has_baseline) keyframes_.drop_before(header.baseline);
  const Stamp stamp = *context.stamp;
  bool lacks_baseline = false;
  for (std::uint32_t object = 0;;) {
    const HandleReader::Next next = read_handle(bits, object);
    if (next == HandleReader::Next::end) break;
    if (next != HandleReader::Next::handle) return false;
    const KnownObject* known = objects_.find({object});
    const bool is_object_gone = known == nullptr && objects_.is_gone({object});
    if (!is_object_gone && (known == nullptr || known->object_class != message.object_class))
      return false;
    const DeltaOutcome outcome = take_periodic(bits, codec, header, object, stamp);
    if (outcome == DeltaOutcome::malformed) return false;
    if (outcome == DeltaOutcome::no_baseline) {
      lacks_baseline = true;
      ++counters_.differences_refused;
      continue;
    }
    if (is_object_gone) continue;
    ++counters_.updates_reflected;
    if (has_datagrams_)
      arrivals_.accept({object}, message.object_class, AttributeSet{*attribute},
                       order_of_frame(frames_heard_));
    callbacks_.reflect_attribute_values({object}, AttributeSet{*attribute}, decoded_, stamp);
    if (!phase_.is_joined()) return true;
  }
  if (lacks_baseline) frames_.enqueue(RefuseKeyframeMessage{header.baseline});
  Bytes read;
  return bits.finish() && reader.rest(read, bits.bytes_read());
}

/// Decodes one record into `decoded_` and keeps it if a keyframe is being told.
AmbassadorParts::DeltaOutcome AmbassadorParts::take_periodic(BitReader& bits,
                                                             const QuantisedCodec& codec,
                                                             const DeltaHeader& header,
                                                             std::uint32_t object,
                                                             const Stamp& stamp) {
  bool is_absolute = false;
  if (!bits.flag(is_absolute) || (!is_absolute && !header.has_baseline))
    return DeltaOutcome::malformed;
  decoded_.clear();
  QuantisedCodec::Counts counts{};
  if (is_absolute) {
    const std::optional<bool> is_quantised = codec.decode(bits, counts, decoded_);
    if (!is_quantised) return DeltaOutcome::malformed;
    if (!*is_quantised) return DeltaOutcome::decoded;  // in full: nobody's baseline
  } else {
    const std::optional<KeyframeMemory::Baseline> baseline =
        keyframes_.find(header.baseline, object);
    if (!baseline || baseline->counts.size() != codec.fields().size())
      return skip_differences(bits, codec, header.orders) ? DeltaOutcome::no_baseline
                                                          : DeltaOutcome::malformed;
    QuantisedCodec::Counts predicted{};
    predict(codec, baseline->counts, stamp.time - baseline->time, predicted);
    if (!exchange_differences(bits, codec, header.orders, predicted, counts))
      return DeltaOutcome::malformed;
    codec.append_value(counts, decoded_);
  }
  if (keyframes_.is_open())
    keyframes_.add(object, stamp.time, std::span(counts).first(codec.fields().size()));
  return DeltaOutcome::decoded;
}

}  // namespace rink::rti
