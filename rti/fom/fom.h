// The federation object model: the classes of objects and interactions, read from an IEEE 1516.2
// OMT XML file.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rti/fom/fom_module.h"
#include "rti/fom/fom_switches.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

class AttributeCodec;
class QuantisedCodec;

struct Attribute {
  std::string name;
  std::string data_type;
  std::optional<std::uint32_t> size;  ///< encoded size [bytes]; nothing if it varies
  Transportation transportation = Transportation::reliable;
  Order order = Order::receive;
  bool is_static = false;                       ///< given one value for good
  DimensionSet dimensions;                      ///< the dimensions of its regions
  std::shared_ptr<const AttributeCodec> codec;  ///< null: values travel as they are
  std::shared_ptr<const QuantisedCodec>
      baselines;  ///< not null: periodic state, which travels as differences to acknowledged
                  ///< baselines (rti/baselines)
};
/// Adds one to a class's attributes. Where it would get the number of the privilege to delete, an
/// entry of that name without data goes before it, so that handles stay indices.
void add_attribute(std::vector<Attribute>& attributes, Attribute attribute);
/// Bytes of the uncoded value that starts `values` (its length word included if its size varies),
/// or nothing if it isn't all there.
std::optional<std::size_t> plain_size(const Attribute& attribute, Bytes values);

struct Parameter {
  std::string name;
  std::string data_type;
  std::optional<std::uint32_t> size;  ///< encoded size [bytes]; nothing if it varies
};

struct ObjectClass {
  std::string name;          ///< unqualified, as in the file
  ObjectClassHandle parent;  ///< empty for the root
  std::vector<Attribute>
      attributes;  ///< inherited ones first, so a handle means the same in every subclass; the
                   ///< privilege to delete is among them only where there are others beyond it
  AttributeSet all = {};  ///< their handles, without the privilege to delete
};

struct InteractionClass {
  std::string name;
  InteractionClassHandle parent;
  std::vector<Parameter> parameters;  ///< inherited ones first
  Transportation transportation = Transportation::reliable;
  Order order = Order::receive;
  DimensionSet dimensions;
};

/// One with an upper bound is the standard's: ranges are [lower, upper) over the integers from 0 to
/// the bound. One without is measured: closed ranges of doubles in the unit of its data type, not
/// normalised; so are X and Y [m], over which filters decide.
struct Dimension {
  std::string name;
  std::optional<std::uint32_t> upper_bound;
};

/// Immutable once loaded and given its codecs; handles are indices into its arrays, equal for all
/// federates that loaded an equal model.
class Fom {
 public:
  /// Throws `FileError`.
  static Fom load(const std::string& path);
  /// The same from text; `source` stands for the file's name in errors.
  static Fom parse(std::string_view xml, const std::string& source);
  /// Merges several modules: repeated definitions must be the same; classes are numbered as they
  /// first appear.
  static Fom load(std::span<const std::string> paths);
  static Fom parse(std::span<const FomModule> modules);

  /// Makes values of `data_type` travel as `codec` encodes them. Call it before the model is used.
  /// Throws `FileError` if no attribute is of that type.
  void use_codec(std::string_view data_type, const std::shared_ptr<const AttributeCodec>& codec);

  const std::string& name() const { return name_; }
  const std::vector<ObjectClass>& object_classes() const { return object_classes_; }
  const std::vector<InteractionClass>& interaction_classes() const { return interaction_classes_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  const FomSwitches& switches() const { return switches_; }
  /// What the model asks for and this RTI does otherwise, each with file, line and element; not
  /// part of the hash. Programs that load a model print them.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// True of a class of the management object model, which every model has behind its own
  /// (docs/rti.md, "Management"): only the RTI sends them.
  bool is_management(ObjectClassHandle handle) const { return handle.value >= own_object_classes_; }
  bool is_management(InteractionClassHandle handle) const {
    return handle.value >= own_interaction_classes_;
  }
  /// True of those management interactions that federates send to the RTI.
  bool is_for_rti(InteractionClassHandle handle) const;

  /// Look-ups by name. A class may be named alone where that is unambiguous, or qualified from the
  /// root ("HLAobjectRoot.Entity"). Nothing if there is none, or several.
  std::optional<ObjectClassHandle> object_class(std::string_view name) const;
  std::optional<AttributeHandle> attribute(ObjectClassHandle object_class,
                                           std::string_view name) const;
  std::optional<InteractionClassHandle> interaction_class(std::string_view name) const;
  std::optional<ParameterHandle> parameter(InteractionClassHandle interaction_class,
                                           std::string_view name) const;
  std::optional<DimensionHandle> dimension(std::string_view name) const;

  /// The handle must name a class of this model.
  const ObjectClass& at(ObjectClassHandle handle) const {
    assert(handle.value < object_classes_.size());
    return object_classes_[handle.value];
  }
  const InteractionClass& at(InteractionClassHandle handle) const {
    assert(handle.value < interaction_classes_.size());
    return interaction_classes_[handle.value];
  }
  const Dimension& at(DimensionHandle handle) const {
    assert(handle.value < dimensions_.size());
    return dimensions_[handle.value];
  }
  /// The attribute of a class that is sent by baselines: the first of its attributes that are
  /// periodic and quantised throughout.
  std::optional<AttributeHandle> periodic_attribute(ObjectClassHandle handle) const;
  /// All attributes of a class.
  AttributeSet attributes(ObjectClassHandle handle) const;
  /// True if `handle` is `ancestor` or inherits from it.
  bool is_a(ObjectClassHandle handle, ObjectClassHandle ancestor) const;
  bool is_a(InteractionClassHandle handle, InteractionClassHandle ancestor) const;

  /// Bytes that the values of `set` take together, or nothing if one of them varies.
  std::optional<std::uint32_t> values_size(ObjectClassHandle handle, AttributeSet set) const;
  /// True if `values` are exactly one value for each attribute of `set`.
  bool values_fit(ObjectClassHandle handle, AttributeSet set, Bytes values) const;
  /// Where the value of `attribute` stands in `values` of `set` (its length word included if its
  /// size varies); values must fit.
  Bytes value(ObjectClassHandle handle, AttributeSet set, AttributeHandle attribute,
              Bytes values) const;

  /// The FNV-1a hash of what both ends must agree on: names, order, types, sizes, dimensions,
  /// codecs, switches; not comments, layout, semantics or the management object model, which is
  /// always the same.
  std::uint64_t hash() const { return hash_; }
  /// Asserts that classes come after those that they inherit from, begin with their members, and
  /// have no more attributes than a set has room for.
  void check() const;

 private:
  friend class FomReader;
  std::string name_;
  std::vector<ObjectClass> object_classes_;
  std::vector<InteractionClass> interaction_classes_;
  std::vector<Dimension> dimensions_;
  FomSwitches switches_;
  std::vector<std::string> warnings_;
  std::size_t own_object_classes_ = 0,
              own_interaction_classes_ = 0;  ///< those before the management object model's
  std::uint64_t hash_ = 0;
};

}  // namespace rink::rti
