// The encoding of a bat's input: most counts are small, and at most four keys are held.
#pragma once

#include <string>

#include "rti/fom/attribute_codec.h"

namespace rink::game {

/// Codes the object model's type Input: one varint, the keys held in its four low bits and the
/// count above, so 2 bytes up to 1,023 keys and 3 up to 131,071 instead of 5. One key more, after
/// another input, is 4 bits; keys that count nothing, as a plan's, are 5.
class InputCodec : public rti::AttributeCodec {
 public:
  std::string name() const override { return "rink-input-2"; }
  void encode(rti::Bytes value, double time, std::vector<std::byte>& coded) const override;
  std::optional<std::size_t> size(rti::Bytes coded) const override;
  bool decode(rti::Bytes coded, double time, std::vector<std::byte>& value) const override;
  bool has_residuals() const override { return true; }
  bool encode_residual(const rti::ResidualBasis& basis, rti::Bytes value, double time,
                       rti::BitWriter& bits) const override;
  bool decode_residual(const rti::ResidualBasis& basis, double time, rti::BitReader& bits,
                       std::vector<std::byte>& value) const override;
  void list_fields(rti::Bytes coded, const rti::FieldVisitor& visit) const override;
  bool list_residual_fields(rti::BitReader& bits, bool has_companion,
                            const rti::FieldVisitor& visit) const override;
};

}  // namespace rink::game
