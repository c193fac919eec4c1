// Names and handles: the look-ups of IEEE 1516.1-2010, clause 10, that the object model alone
// answers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rti/fom/fom.h"

namespace rink::rti {

/// Look-ups by name throw NameNotFound; those by handle throw ObjectClassNotDefined,
/// AttributeNotDefined, InteractionClassNotDefined, InteractionParameterNotDefined,
/// InvalidDimensionHandle. A class name may be given unqualified where that is unambiguous; names
/// returned are qualified.
class FomLookup {
 public:
  /// Must outlive it.
  explicit FomLookup(const Fom& fom) : fom_(fom) {}
  const Fom& fom() const { return fom_; }

  ObjectClassHandle get_object_class_handle(std::string_view name) const;
  std::string get_object_class_name(ObjectClassHandle object_class) const;
  AttributeHandle get_attribute_handle(ObjectClassHandle object_class, std::string_view name) const;
  const std::string& get_attribute_name(ObjectClassHandle object_class,
                                        AttributeHandle attribute) const;
  InteractionClassHandle get_interaction_class_handle(std::string_view name) const;
  std::string get_interaction_class_name(InteractionClassHandle interaction_class) const;
  ParameterHandle get_parameter_handle(InteractionClassHandle interaction_class,
                                       std::string_view name) const;
  const std::string& get_parameter_name(InteractionClassHandle interaction_class,
                                        ParameterHandle parameter) const;
  /// "HLAreliable" and "HLAbestEffort".
  static Transportation get_transportation_type(std::string_view name);
  static std::string_view get_transportation_type_name(Transportation transportation);
  /// "Receive" and "TimeStamp".
  static Order get_order_type(std::string_view name);
  static std::string_view get_order_name(Order order);
  DimensionHandle get_dimension_handle(std::string_view name) const;
  const std::string& get_dimension_name(DimensionHandle dimension) const;
  std::optional<std::uint32_t> get_dimension_upper_bound(DimensionHandle dimension) const;
  DimensionSet get_available_dimensions_for_class_attribute(ObjectClassHandle object_class,
                                                            AttributeHandle attribute) const;
  DimensionSet get_available_dimensions_for_interaction_class(
      InteractionClassHandle interaction_class) const;

 private:
  void check(DimensionHandle dimension) const;

  const Fom& fom_;
};

}  // namespace rink::rti
