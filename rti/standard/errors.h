// Rink's errors as the standard's exceptions.
#pragma once

#include <string_view>

#include "rti/hla_error.h"
#include "rti/standard/standard_headers.h"

namespace rink::standard {

/// Throws the standard's exception of that name ("AttributeNotOwned"), RTIinternalError if there is
/// none.
[[noreturn]] void throw_standard(std::string_view name, std::string_view text);
[[noreturn]] inline void throw_standard(rti::HlaError error, std::string_view text) {
  throw_standard(rti::to_string(error), text);
}

/// Calls a service of the core, and turns what it throws into the standard's exception.
template <class Call>
decltype(auto) translated(const Call& call) {
  try {
    return call();
  } catch (const rti::RtiException& error) {
    throw_standard(error.error(), error.what());
  }
}

}  // namespace rink::standard
