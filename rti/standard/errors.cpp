// The exceptions of the standard's C++ API.
#include "rti/standard/errors.h"

#include <ostream>

#include "rti/standard/exception_names.h"
#include "rti/standard/wide_text.h"

namespace rti1516e {

Exception::Exception() = default;
Exception::Exception(Exception const&) = default;
Exception& Exception::operator=(Exception const&) = default;
Exception::~Exception() = default;

std::wostream& operator<<(std::wostream& stream, Exception const& exception) {
  return stream << exception.what();
}

// A macro is the only way to define classes that are declared by one.
#define RINK_DEFINE_EXCEPTION(Name)                                   \
  Name::Name(std::wstring const& message) noexcept : _msg(message) {} \
  std::wstring Name::what() const noexcept { return _msg; }
RINK_STANDARD_EXCEPTIONS(RINK_DEFINE_EXCEPTION)
RINK_DEFINE_EXCEPTION(EncoderException)
#undef RINK_DEFINE_EXCEPTION

}  // namespace rti1516e

namespace rink::standard {

void throw_standard(std::string_view name, std::string_view text) {
#define RINK_THROW_BY_NAME(Name) \
  if (name == #Name) throw rti1516e::Name(to_wide(text));
  RINK_STANDARD_EXCEPTIONS(RINK_THROW_BY_NAME)
#undef RINK_THROW_BY_NAME
  throw rti1516e::RTIinternalError(to_wide(text));
}

}  // namespace rink::standard
