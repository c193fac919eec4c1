// Which attributes of a model may travel as residuals, and what both ends keep of an object for
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/fom/attribute_codec.h"
#include "rti/fom/fom.h"
#include "rti/wire/bit_stream.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// The values of one object that residuals refer to, as in memory. Both ends change it by the same
/// updates in the same order, so that it is equal at both.
struct FormerValues {
  AttributeSet held;
  std::vector<std::byte> bytes;  ///< at the class's offsets
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, held, bytes);
  }
};

/// An update of one object that residuals of others may refer to.
struct FormerChange {
  AttributeSet attributes;
  FormerValues before;
  std::vector<std::byte> after;  ///< at the class's offsets
};

/// What an update is about, but for its values.
struct ResidualUpdate {
  std::uint16_t object_class = 0;
  AttributeSet attributes;
  double time = 0.0;                        ///< of its stamp [s]
  const FormerChange* companion = nullptr;  ///< of an object of the same class
};

/// Immutable; refers to the model.
class ResidualModel {
 public:
  explicit ResidualModel(const Fom& fom);

  /// The attributes of the class that may travel as residuals, all of them reliable; empty for most
  /// models.
  AttributeSet residual(std::uint16_t object_class) const {
    return classes_[object_class].residual;
  }
  /// These and the attributes whose values they need.
  AttributeSet kept(std::uint16_t object_class) const { return classes_[object_class].kept; }

  /// True if `former` can be of an object of the class.
  bool is_sound(std::uint16_t object_class, const FormerValues& former) const {
    const Class& of = classes_[object_class];
    return former.held.is_empty() ||
           (of.kept.includes(former.held) && former.bytes.size() == of.size);
  }
  /// Notes the values of `set`, as in memory.
  void keep(std::uint16_t object_class, AttributeSet set, Bytes values, FormerValues& former) const;
  /// Appends the values of `set`, as in memory; false if some of them are not held.
  bool append(std::uint16_t object_class, AttributeSet set, const FormerValues& former,
              std::vector<std::byte>& values) const;
  /// The key of the first of the values that has one.
  std::optional<std::uint64_t> companion_key(std::uint16_t object_class, AttributeSet set,
                                             Bytes values) const;
  /// Appends the residuals of the values to what is held; false, with some of them perhaps
  /// appended, if one of them must travel whole. The attributes must be residual.
  bool encode(const ResidualUpdate& update, Bytes values, const FormerValues& former,
              BitWriter& bits) const;
  /// Appends the values, as in memory, and notes them; false if what they need is not held or the
  /// bits are malformed.
  bool decode(const ResidualUpdate& update, FormerValues& former, BitReader& bits,
              std::vector<std::byte>& values) const;

 private:
  struct Kept {
    std::uint32_t offset = 0, size = 0;  ///< in `FormerValues::bytes`
    std::optional<std::uint32_t> context;
  };
  struct Class {
    AttributeSet residual, kept;
    std::vector<Kept> attributes;  ///< by handle
    std::uint32_t size = 0;
  };
  static std::optional<ResidualBasis> basis(const Class& of, std::uint32_t attribute,
                                            const FormerValues& former);
  static std::optional<ResidualChange> change(const Class& of, std::uint32_t attribute,
                                              const FormerChange* companion);
  const AttributeCodec& codec(std::uint16_t object_class, std::uint32_t attribute) const {
    return *fom_.object_classes()[object_class].attributes[attribute].codec;
  }

  const Fom& fom_;
  std::vector<Class> classes_;
};

}  // namespace rink::rti
