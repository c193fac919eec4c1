// The switches table of an object model (IEEE 1516.2-2010, 4.12): how a federation execution
// begins.
#pragma once

#include <string>

#include "rti/types.h"

namespace rink::rti {

class FomModules;

/// The values here are those of a model without a table of switches. The advisories are those of
/// each federate when it joins, which its own services switch from then on.
struct FomSwitches {
  bool auto_provide = false;  ///< owners are asked for values whenever an object is discovered
  bool attribute_scope_advisory = true, attribute_relevance_advisory = false,
       object_class_relevance_advisory = true, interaction_relevance_advisory = true;
  ResignAction automatic_resign_action = ResignAction::cancel_then_delete_then_divest;
  friend bool operator==(const FomSwitches&, const FomSwitches&) = default;
  /// The table as one text, for the hash; empty if nothing differs from the above.
  std::string text() const;
};

/// Throws `FileError`: a switch that is unknown or neither true nor false, or one that two modules
/// set differently. A switch that asks for what this RTI does not do is a warning.
FomSwitches read_switches(FomModules& modules);

}  // namespace rink::rti
