// Checks by which services refuse invalid arguments.
#pragma once

#include <string>
#include <string_view>

#include "rti/handles.h"
#include "rti/hla_error.h"
#include "rti/types.h"

namespace rink::rti {

/// The object's name in exceptions.
inline std::string name_of(ObjectHandle object) { return "object " + std::to_string(object.value); }

inline void require(bool is_met, HlaError error, ObjectHandle object, std::string_view expected) {
  if (!is_met) throw RtiException(error, name_of(object) + ": " + std::string(expected));
}

inline void require_text(std::string_view text, const char* what) {
  if (text.size() > text_max)
    throw RtiException(HlaError::illegal_name,
                       std::string(what) + " has " + std::to_string(text.size()) +
                           " bytes; allowed are at most " + std::to_string(text_max));
}

}  // namespace rink::rti
