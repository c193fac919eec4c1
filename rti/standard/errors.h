// Rink's errors as the standard's exceptions.
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "rti/hla_error.h"
#include "rti/standard/standard_headers.h"
#include "rti/standard/wide_text.h"

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
  } catch (const std::exception& error) {
    throw_standard("RTIinternalError", error.what());
  }
}

/// What `call` throws, of any type; nothing if it returns.
template <class Call>
std::optional<std::string> fault_of(const Call& call) {
  try {
    call();
  } catch (const rti1516e::Exception& exception) {
    return to_utf8(exception.what());
  } catch (const std::exception& exception) {
    return exception.what();
  } catch (...) {
    return "what is no exception";
  }
  return std::nullopt;
}

}  // namespace rink::standard
