// The bits of a block of periodic state: a header, then for each object a step to its handle and
// its state, as a difference to what its baseline predicts or absolute.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "rti/fom/quantised_codec.h"
#include "rti/wire/bit_stream.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

/// A golomb order for each field.
using Orders = std::array<std::uint8_t, QuantisedCodec::field_max>;

/// Which baseline the differences of a block refer to and how long they are, if there are any.
struct DeltaHeader {
  bool has_baseline = false;
  std::uint16_t baseline = 0;
  Orders orders{};
};
template <class Stream>
bool exchange(Stream& stream, DeltaHeader& header, std::size_t field_count) {
  assert(field_count <= QuantisedCodec::field_max);
  if (!stream.flag(header.has_baseline)) return false;
  if (!header.has_baseline) return true;
  bool is_whole = stream.bits(header.baseline, 16);
  for (std::size_t i = 0; is_whole && i < field_count; ++i)
    is_whole = stream.bits(header.orders[i], 5);
  return is_whole;
}

/// The next handle, or the end: 1 for the neighbour above, else 0 and the step
/// (rti/wire/update_block.h), whose 0 is the end.
inline constexpr unsigned handle_order = 4;
inline void write_handle(BitWriter& bits, std::uint32_t previous, std::uint32_t handle) {
  const bool is_next = handle == previous + 1;
  bits.flag(is_next);
  if (!is_next) bits.golomb(handle_step(previous, handle), handle_order);
}
inline void write_end(BitWriter& bits) {
  bits.flag(false);
  bits.golomb(0, handle_order);
}
inline HandleReader::Next read_handle(BitReader& bits, std::uint32_t& handle) {
  bool is_next = false;
  std::uint64_t step = 0;
  if (!bits.flag(is_next) || (!is_next && !bits.golomb(step, handle_order)))
    return HandleReader::Next::malformed;
  if (!is_next && step == 0) return HandleReader::Next::end;
  if (is_next) step = handle_step(0, 1);
  return follow_step(step, handle) ? HandleReader::Next::handle : HandleReader::Next::malformed;
}

/// What a baseline's counts become after `elapsed` s if every rate stays as it is. The same bits at
/// both ends: no sum is rounded twice.
inline void predict(const QuantisedCodec& codec, std::span<const std::int64_t> baseline,
                    double elapsed, QuantisedCodec::Counts& predicted) {
  const std::span<const QuantisedField> fields = codec.fields();
  assert(baseline.size() >= fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) predicted[i] = baseline[i];
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].rate_of) continue;
    const std::uint32_t moved = *fields[i].rate_of;
    const Quantisation& grid = *fields[moved].grid;
    const double steps = std::nearbyint(
        fields[i].grid->value(static_cast<std::uint64_t>(baseline[i])) * elapsed / grid.step);
    if (!(std::abs(steps) < 0x1p50)) continue;  // no meaningful instants; perhaps NaN
    predicted[moved] = std::clamp<std::int64_t>(predicted[moved] + static_cast<std::int64_t>(steps),
                                                0, static_cast<std::int64_t>(grid.last));
  }
}

/// The counts as differences to the predicted ones; a reader returns false if one leaves its range.
template <class Stream>
bool exchange_differences(Stream& stream, const QuantisedCodec& codec, const Orders& orders,
                          const QuantisedCodec::Counts& predicted, QuantisedCodec::Counts& counts) {
  const std::span<const QuantisedField> fields = codec.fields();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    std::uint64_t difference = Stream::is_reading ? 0 : zigzag(counts[i] - predicted[i]);
    if (!stream.golomb(difference, orders[i])) return false;
    if (!Stream::is_reading) continue;
    counts[i] = predicted[i] + from_zigzag(difference);
    if (counts[i] < 0 || counts[i] > static_cast<std::int64_t>(fields[i].grid->last)) return false;
  }
  return true;
}

/// Steps over the differences of one record, for a reader that lacks its baseline.
inline bool skip_differences(BitReader& bits, const QuantisedCodec& codec, const Orders& orders) {
  std::uint64_t difference = 0;
  for (std::size_t i = 0; i < codec.fields().size(); ++i)
    if (!bits.golomb(difference, orders[i])) return false;
  return true;
}

}  // namespace rink::rti
