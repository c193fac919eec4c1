// How one attribute's value travels: the seam by which a user of the RTI sends values smaller than
// the object model defines them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rti/wire/bytes.h"

namespace rink::rti {

class BitReader;
class BitWriter;

/// How the same attribute of another object, the companion, changed in the same block; as in
/// memory.
struct ResidualChange {
  Bytes former, context, value;
};

/// What both ends hold of an object when an attribute of it travels as a residual; as in memory.
struct ResidualBasis {
  Bytes former;   ///< the attribute's value before
  Bytes context;  ///< the value of the attribute that the codec names, empty if it names none
  const ResidualChange* companion = nullptr;  ///< if the residual refers to that, too
};

/// Receives the name of a field and how many bits it takes.
using FieldVisitor = std::function<void(std::string_view name, std::size_t bits)>;

/// Codes the values of one data type on their way. Federates give and receive values as the object
/// model defines them; only between them are values coded. Without a codec a value travels as it
/// is.
///
/// A coded value must show its own end and must be readable without any other: the RTI cuts blocks,
/// keeps the latest value and gives it to late joiners, and never decodes. So a codec depends on
/// the value and on logical time alone, never on what was sent before or to whom, and nothing
/// breaks when updates are left out. Residuals are the exception: the RTI gives them only to
/// federates that hold the value before (docs/wire.md, "Residuals").
class AttributeCodec {
 public:
  virtual ~AttributeCodec() = default;

  /// Becomes part of the model's hash, so that two ends whose codecs differ refuse each other.
  /// Change it with the coded form.
  virtual std::string name() const = 0;
  /// Appends the coded form of `value`, which fits the data type. `time` [s] is that of the
  /// update's stamp.
  virtual void encode(Bytes value, double time, std::vector<std::byte>& coded) const = 0;
  /// Bytes of the coded value that starts `coded`; nothing if it is malformed or not all there.
  /// A value with a size may still fail to decode.
  virtual std::optional<std::size_t> size(Bytes coded) const = 0;
  /// Appends the value; false if `coded`, whose size was found, is malformed. `time` [s] is that of
  /// the newest update known when it was sent on: never before that of `encode`, and much later for
  /// a receiver without updates for long.
  virtual bool decode(Bytes coded, double time, std::vector<std::byte>& value) const = 0;

  /// True of codecs that also code a value as bits that say what the basis does not tell.
  virtual bool has_residuals() const { return false; }
  /// The data type of the attribute of the same class that residuals need; empty for none. Types of
  /// varying size don't count.
  virtual std::string_view context_type() const { return {}; }
  /// Values of equal keys may be companions: two bodies that hit each other, for one. Nothing of a
  /// value that tells nothing about others.
  virtual std::optional<std::uint64_t> companion_key(Bytes /*value*/) const { return std::nullopt; }
  /// Appends the residual of `value`; false, with nothing appended, if it must travel whole. The
  /// result depends on the arguments alone, bit for bit, on any machine.
  virtual bool encode_residual(const ResidualBasis& /*basis*/, Bytes /*value*/, double /*time*/,
                               BitWriter& /*bits*/) const {
    return false;
  }
  /// Appends the value; false if the bits are malformed or not all there. `time` is that of
  /// `encode_residual`.
  virtual bool decode_residual(const ResidualBasis& /*basis*/, double /*time*/, BitReader& /*bits*/,
                               std::vector<std::byte>& /*value*/) const {
    return false;
  }

  /// Names the fields of a coded value, whose size was found, in their order: all of its bits. The
  /// names are literals, or live as long as the codec.
  virtual void list_fields(Bytes coded, const FieldVisitor& visit) const {
    visit({}, 8 * coded.size());
  }
  /// The same of a residual, whose bits it steps over without knowing what they refer to; false if
  /// they are malformed or not all there.
  virtual bool list_residual_fields(BitReader& /*bits*/, bool /*has_companion*/,
                                    const FieldVisitor& /*visit*/) const {
    return false;
  }
};

}  // namespace rink::rti
