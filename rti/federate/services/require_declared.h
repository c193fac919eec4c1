// Checks by which services refuse classes that are not defined or not published.
#pragma once

#include <string>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/books/declared_classes.h"

namespace rink::rti {

/// Throws ObjectClassNotDefined, AttributeNotDefined.
inline void require_class(const Fom& fom, ObjectClassHandle object_class, AttributeSet attributes) {
  if (object_class.value >= fom.object_classes().size())
    throw RtiException(HlaError::object_class_not_defined,
                       "class " + std::to_string(object_class.value));
  if (!fom.attributes(object_class).includes(attributes))
    throw RtiException(HlaError::attribute_not_defined, "of class " + fom.at(object_class).name);
}

/// Throws InteractionClassNotDefined.
inline void require_class(const Fom& fom, InteractionClassHandle interaction_class) {
  if (interaction_class.value >= fom.interaction_classes().size())
    throw RtiException(HlaError::interaction_class_not_defined,
                       "class " + std::to_string(interaction_class.value));
}

/// Throws FederateNotExecutionMember and InteractionClassNotPublished too.
inline void require_published(const AmbassadorBasis& basis, const DeclaredClasses& classes,
                              InteractionClassHandle interaction_class) {
  basis.phase.require_joined();
  require_class(basis.fom, interaction_class);
  if (!classes.is_published(interaction_class))
    throw RtiException(HlaError::interaction_class_not_published,
                       "class " + basis.fom.at(interaction_class).name);
}

}  // namespace rink::rti
