// The lossless encoding of trajectories on the wire, as bits instead of nine doubles.
#pragma once

#include <span>
#include <string>

#include "rti/fom/attribute_codec.h"
#include "rti/fom/fom.h"

namespace rink::game {

/// Codes the object model's type Trajectory without loss (docs/replication.md, "The codec"):
/// rounded ones (game/replication/trajectory.h) in 5, 10, 13 or 14 bytes and more for unusual laws,
/// all others in full; after another one mostly as its residual.
class TrajectoryCodec : public rti::AttributeCodec {
 public:
  std::string name() const override { return "rink-trajectory-4"; }
  void encode(rti::Bytes value, double time, std::vector<std::byte>& coded) const override;
  std::optional<std::size_t> size(rti::Bytes coded) const override;
  bool decode(rti::Bytes coded, double time, std::vector<std::byte>& value) const override;
  bool has_residuals() const override { return true; }
  std::string_view context_type() const override { return "Shape"; }
  /// Two bodies that hit each other go on from one instant.
  std::optional<std::uint64_t> companion_key(rti::Bytes value) const override;
  bool encode_residual(const rti::ResidualBasis& basis, rti::Bytes value, double time,
                       rti::BitWriter& bits) const override;
  bool decode_residual(const rti::ResidualBasis& basis, double time, rti::BitReader& bits,
                       std::vector<std::byte>& value) const override;
  void list_fields(rti::Bytes coded, const rti::FieldVisitor& visit) const override;
  bool list_residual_fields(rti::BitReader& bits, bool has_companion,
                            const rti::FieldVisitor& visit) const override;
};

/// The object model at `path` with Rink's codecs. Throws rti::FileError.
rti::Fom load_rink_fom(const std::string& path);
/// Loads several modules, which merge.
rti::Fom load_rink_fom(std::span<const std::string> paths);

}  // namespace rink::game
