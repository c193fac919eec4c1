// The bit-packed form of values whose data types state a range and a resolution.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rti/fom/attribute_codec.h"
#include "rti/wire/bit_stream.h"

namespace rink::rti {

/// One field of a fixed record, nested records laid flat.
struct QuantisedField {
  enum class Form : std::uint8_t { octets, float32, float64, integer16, integer32 };
  Form form = Form::octets;
  bool is_big_endian = false;
  std::uint32_t size = 0;                  ///< of the uncoded field [bytes]
  std::optional<Quantisation> grid{};      ///< nothing: every bit of it travels
  std::optional<std::uint32_t> rate_of{};  ///< the field whose change per second this one is
  std::uint32_t padding = 0;  ///< between the field before it and this one [bytes]; read as zeros
  std::string name{};         ///< in its record; of a nested one "outer.inner"
};

/// Codes records by rounding each field to its grid: |decoded - value| <= half a step <= half the
/// resolution that the object model states. A value with a field out of its range (or not a number)
/// travels in full, every bit of it. Bits: 0 and the fields' counts, or 1 and the fields' bytes,
/// padding left out; zeros fill the last byte up (docs/wire.md).
class QuantisedCodec : public AttributeCodec {
 public:
  static constexpr std::size_t field_max = 32;
  /// By field; those without a grid have 0.
  using Counts = std::array<std::int64_t, field_max>;

  /// At most `field_max` fields, at least one of which has a grid that its form holds exactly.
  explicit QuantisedCodec(std::vector<QuantisedField> fields);

  std::span<const QuantisedField> fields() const { return fields_; }
  /// True if every field has a grid, so that counts alone tell a value.
  bool is_all_quantised() const { return is_all_quantised_; }
  /// Bits of a value whose fields are in range, with the first one that marks it.
  std::size_t packed_bits() const { return packed_bits_; }
  /// Bits of the coded value that starts with `is_full`.
  std::size_t coded_bits(bool is_full) const {
    return is_full ? 1 + 8 * fields_size_ : packed_bits_;
  }

  /// The counts of a coded value of a record that `is_all_quantised`; false if it travels in full.
  /// `coded` must have its size.
  bool read_counts(Bytes coded, Counts& counts) const;
  /// Reads or writes the counts alone; a reader returns false if one is out of its range.
  template <class Stream>
  bool exchange_counts(Stream& stream, Counts& counts) const {
    assert(is_all_quantised_);
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (!stream.ranged(counts[i], 0, static_cast<std::int64_t>(fields_[i].grid->last)))
        return false;
    return true;
  }
  /// Appends the value of a record that `is_all_quantised`.
  void append_value(const Counts& counts, std::vector<std::byte>& value) const;
  /// Reads one coded value of such a record from the middle of a stream and appends it; nothing if
  /// it is malformed, false if it travels in full and thus has no counts.
  std::optional<bool> decode(BitReader& reader, Counts& counts,
                             std::vector<std::byte>& value) const;

  std::string name() const override;
  void encode(Bytes value, double time, std::vector<std::byte>& coded) const override;
  /// Checks the counts too, so that a forwarded value can be decoded.
  std::optional<std::size_t> size(Bytes coded) const override;
  bool decode(Bytes coded, double time, std::vector<std::byte>& value) const override;
  void list_fields(Bytes coded, const FieldVisitor& visit) const override;

 private:
  bool is_in_range(Bytes value) const;
  bool decode(BitReader& reader, std::vector<std::byte>& value) const;
  bool read_in_full(BitReader& reader, std::vector<std::byte>& value) const;
  bool is_sound(BitReader reader) const;

  std::vector<QuantisedField> fields_;
  std::size_t fields_size_ = 0, packed_bits_ = 1;  ///< padding left out [bytes, bits]
  bool is_all_quantised_ = true;
};

}  // namespace rink::rti
