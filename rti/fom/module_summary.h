// What one module of an object model contributes, in numbers, for those who check their files.
#pragma once

#include <cstddef>
#include <string>

#include "rti/fom/fom_module.h"

namespace rink::rti {

/// Elements that the module itself has, scaffolds and repetitions included.
struct ModuleSummary {
  std::string name;  ///< as its identification says
  std::size_t object_classes = 0, attributes = 0, interaction_classes = 0, parameters = 0,
              dimensions = 0, data_types = 0, enumerators = 0, transportations = 0, switches = 0,
              update_rates = 0;
  bool is_standard = false;  ///< the standard's management and initialization module
  /// "14 object classes with 41 attributes, 3 interaction classes with 8 parameters, …"; what there
  /// is none of is left out.
  std::string text() const;
};
/// Throws `FileError` if the text is no model at all. What depends on other modules is not checked.
ModuleSummary summarize(const FomModule& module);

}  // namespace rink::rti
