// What an entity is, as it travels.
#pragma once

#include "rti/fom/attribute_codec.h"

namespace rink::game {

/// Codes the object model's type Shape without loss: numbers of up to four decimals take one to
/// three bytes each instead of four, so that a puck is 12 bytes instead of 26.
class ShapeCodec : public rti::AttributeCodec {
 public:
  std::string name() const override { return "rink-shape-1"; }
  void encode(rti::Bytes value, double time, std::vector<std::byte>& coded) const override;
  std::optional<std::size_t> size(rti::Bytes coded) const override;
  bool decode(rti::Bytes coded, double time, std::vector<std::byte>& value) const override;
  void list_fields(rti::Bytes coded, const rti::FieldVisitor& visit) const override;
};

}  // namespace rink::game
